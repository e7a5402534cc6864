//! Waves of fine periods that the residual behind everything else shows become effects of the catalogue, and the search is made anew.

use std::cell::OnceCell;

use super::choice::{Chosen, NAMED};
use super::functions::add_function;
use crate::search::SearchError;
use crate::search::context::{Context, Request};
use crate::search::fitted::Fitted;
use crate::search::library::Shape;
use crate::search::orders::peaks;
use crate::search::round::Round;
use effects::families::HIGH_HARMONIC;
use study::Plan;

/// The declaration's own fit with waves in the catalogue that the residual behind what was chosen shows; `None` where it shows none. `own`
/// is where the study lives then.
pub(super) fn offered<'a>(
    chosen: &Chosen<'a>,
    own: &'a OnceCell<Plan>,
) -> Result<Option<(Context<'a>, Fitted)>, SearchError> {
    let Chosen { whole, judged, .. } = chosen;
    let plan = whole.request.plan;
    // A study that allows certain effects alone, or no functions, allows no others.
    let is_allowed = plan.search.only.is_empty() && plan.search.functions != Some(false);
    if !is_allowed || judged.round.fitted.found.len() > NAMED {
        return Ok(None);
    }
    let peaks = peaks(whole, &judged.round.fitted)?;
    if peaks.is_empty() {
        return Ok(None);
    }
    let plan = own.get_or_init(|| {
        let mut plan = plan.clone();
        for peak in peaks {
            // A chain that has no room for more takes no more.
            let _ = add_function(
                &mut plan,
                peak.at.place,
                peak.at.driver,
                &Shape::Harmonic { order: peak.order },
            );
        }
        plan
    });
    let request = Request { plan, ..whole.request };
    let whole = Context { tell: whole.tell, ..Context::new(request, whole.setting.observables, whole.held)? };
    let first = Fitted::first(&whole)?;
    Ok(Some((whole, first)))
}

/// Whether a wave is among the effects of a round.
pub(super) fn has_wave(whole: &Context<'_>, round: &Round<'_>) -> bool {
    round.fitted.found.iter().any(|found| whole.catalogue[found.effect].family == HIGH_HARMONIC)
}
