//! Waves of fine periods that the residual behind everything else shows become effects of the catalogue, and the search is made anew.

use std::cell::OnceCell;

use super::choice::{Chosen, NAMED, NO_WORSE};
use super::functions::{add_function, numbered};
use crate::diagnose::Rms;
use crate::diagnose::rms::share;
use crate::search::SearchError;
use crate::search::context::{Context, Found, Request};
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
    // A contest of everything is worth its time where a wave stands out beside what was found.
    let found = numbered(judged.round.fitted.found.iter(), &chosen.whole, &whole);
    let beside = Round::at(&whole, Fitted::with(&whole, found, &judged.round.fitted)?)?;
    if !beside.search(&whole).iter().any(|found| is_wave(&whole, found)) {
        return Ok(None);
    }
    let first = Fitted::first(&whole)?;
    Ok(Some((whole, first)))
}

/// Whether a wave is among the effects of a round.
pub(super) fn has_wave(whole: &Context<'_>, round: &Round<'_>) -> bool {
    round.fitted.found.iter().any(|found| is_wave(whole, found))
}

fn is_wave(whole: &Context<'_>, found: &Found) -> bool {
    whole.catalogue[found.effect].family == HIGH_HARMONIC
}

/// Whether a search that knew of more waves predicts better with one: in random folds, and no worse in regions that it did not see.
pub(super) fn has_won(told: &Chosen<'_>, with_waves: &Chosen<'_>) -> bool {
    let ratio = |of: fn(&Rms) -> Option<f64>| share(&with_waves.judged.rms, &told.judged.rms, of);
    let kept = match told.whole.request.second {
        None => ratio(|rms| rms.held_out_rms_kept),
        Some(_) => None,
    };
    with_waves.judged.left_out.is_empty()
        && has_wave(&with_waves.whole, &with_waves.judged.round)
        && kept.is_none_or(|ratio| ratio < 1.0)
        && ratio(|rms| rms.elsewhere_rms_kept).is_none_or(|ratio| ratio <= NO_WORSE)
}
