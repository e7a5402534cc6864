//! Noise that remembers, where effects were accepted that explain no more: the rounds begin anew with that memory whitened
//! away, and what is found then is found beyond it. If even that is no better than the memory, nothing is accepted.

use std::cell::OnceCell;

use super::CalibrateError;
use super::rounds::rounds;
use crate::search::Request;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::memory::explains;
use crate::search::round::Round;
use fit::noise::NoiseOptions;
use study::Plan;

/// The last round, or that of a search in which rows may remember; `place` is where the study that says so lives.
pub(super) fn settled<'a>(
    whole: Context<'a>,
    place: &'a OnceCell<Plan>,
    round: Round<'a>,
) -> Result<(Context<'a>, Round<'a>), CalibrateError> {
    let plan = whole.request.plan;
    if !plan.fit.noise.serial || !explains(&round) {
        return Ok((whole, round));
    }
    let whole = remembering(whole, place);
    let first = Fitted::first(&whole)?;
    let mut round = rounds(&whole, Round::at(&whole, first)?)?;
    if explains(&round) {
        round = Round::at(&whole, Fitted::first(&whole)?)?;
    }
    Ok((whole, round))
}

/// The calibration in which rows may remember; `place` is where the study that says so lives.
pub(super) fn remembering<'a>(whole: Context<'a>, place: &'a OnceCell<Plan>) -> Context<'a> {
    let plan = place.get_or_init(|| {
        let mut remembering = whole.request.plan.clone();
        remembering.fit.noise = NoiseOptions { beside_effects: false, ..remembering.fit.noise };
        remembering
    });
    Context { request: Request { plan, ..whole.request }, ..whole }
}
