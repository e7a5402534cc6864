//! Waves of fine periods that the data seem to show become effects of the catalogue, beside those of the study.

use std::cell::OnceCell;

use super::functions::add_function;
use crate::search::context::{Context, Request};
use crate::search::fitted::Fitted;
use crate::search::library::Shape;
use crate::search::orders::peaks;
use crate::search::SearchError;
use study::Plan;

/// The first fit, with waves that were found blind in the catalogue; `own` is where the study lives then.
pub(super) fn offered<'a>(
    whole: Context<'a>,
    first: Fitted,
    own: &'a OnceCell<Plan>,
) -> Result<(Context<'a>, Fitted), SearchError> {
    let plan = whole.request.plan;
    // A study that allows certain effects alone allows no others.
    if !plan.search.only.is_empty() {
        return Ok((whole, first));
    }
    let peaks = peaks(&whole, &first)?;
    if peaks.is_empty() {
        return Ok((whole, first));
    }
    let plan = own.get_or_init(|| {
        let mut plan = plan.clone();
        for peak in peaks {
            // A chain that has no room for more takes no more.
            let _ = add_function(&mut plan, peak.at.place, peak.at.driver, &Shape::Harmonic { order: peak.order });
        }
        plan
    });
    let request = Request { plan, ..whole.request };
    let whole = Context { tell: whole.tell, ..Context::new(request, whole.setting.observables, whole.held)? };
    let first = Fitted::first(&whole)?;
    Ok((whole, first))
}
