//! Rows that were set aside and share a stretch of a reading are heard once more: a defect of a few degrees lies far from
//! what all other rows say, and to a robust fit it is nothing but outliers.
//!
//! Every row at its full weight, functions outside the catalogue compete for what those rows have in common. What they find
//! is fitted robustly again, and stays if fewer rows are set aside then and the model is the likelier one.

use std::cell::OnceCell;

use super::functions::{MOST, Settled, settled};
use super::outliers::{explains, trusting};
use super::rounds::rounds;
use crate::search::aside::shared;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{Request, SearchError};
use study::Plan;

/// Where the studies live that these loops read.
#[derive(Default)]
pub(super) struct Places {
    trusting: OnceCell<Plan>,
    of_functions: [OnceCell<Plan>; MOST],
    robust: OnceCell<Plan>,
    of_more: [OnceCell<Plan>; MOST],
}

/// Whether there are rows to be heard.
pub(super) fn are_any(last: &Settled<'_>) -> bool {
    let (whole, fit) = (&last.whole, &last.round.fitted.fit);
    let plan = whole.request.plan;
    let aside: Vec<usize> = fit.set_aside.iter().map(|aside| aside.row).collect();
    let poses = &whole.request.observations.poses;
    plan.fit.robust && plan.search.only.is_empty() && shared(poses, &aside, whole.options.seed).is_some()
}

/// What the library has settled on, or what at most so many of its functions make of the rows that were set aside.
pub(super) fn heard<'a>(
    last: Settled<'a>,
    places: &'a Places,
    most: usize,
) -> Result<Settled<'a>, SearchError> {
    if !are_any(&last) {
        return Ok(last);
    }
    let whole = &last.whole;
    let plan = whole.request.plan;
    let every = places.trusting.get_or_init(|| trusting(plan));
    let every = Context { request: Request { plan: every, ..whole.request }, ..whole.clone() };
    let first = Fitted::with(&every, last.round.fitted.found.clone(), &last.round.fitted)?;
    if !first.fit.outcome.is_usable() {
        return Ok(last);
    }
    let found = settled(&every, &places.of_functions[..most], rounds(&every, Round::at(&every, first)?)?)?;
    let robust = places.robust.get_or_init(|| {
        let mut robust = found.whole.request.plan.clone();
        robust.fit.robust = true;
        robust.fit.noise.variance = plan.fit.noise.variance;
        robust
    });
    let again = Context { request: Request { plan: robust, ..whole.request }, ..found.whole.clone() };
    let other = Fitted::with(&again, found.round.fitted.found.clone(), &found.round.fitted)?;
    if !other.fit.outcome.is_usable() {
        return Ok(last);
    }
    let other = rounds(&again, Round::at(&again, other)?)?;
    let explains = explains((&again, &other), (whole, &last.round));
    if explains { settled(&again, &places.of_more[..most], other) } else { Ok(last) }
}
