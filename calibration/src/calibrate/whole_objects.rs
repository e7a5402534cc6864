//! What is held out where stretches of rows count as one: whole objects, whatever stretches they were seen in.
//!
//! Stretches cut across objects, so that nothing is left to search without some of both. The errors and the effects that were found are
//! fitted to the other objects' rows alone, and each object that is left out is estimated anew from its own. Which effects
//! those are was found with all rows, and what drifts was the same for all objects: the figure takes nothing up.

use super::held_out;
use crate::diagnose::rms::BeforeAfter;
use crate::search::context::Context;
use crate::search::round::Round;
use crate::search::{HeldOut, Request, SearchError};
use fit::FitResult;
use observe::{Grouping, Observations};

/// Whether stretches that were found count as one each.
pub(super) fn are_cut_across(observations: &Observations) -> bool {
    matches!(observations.grouping, Grouping::Stretches { .. })
}

/// The figures of objects that are left out; none where rows have no stretches for groups, or observe one object alone.
pub(super) fn left_out(
    whole: &Context<'_>,
    before: &FitResult,
    round: &Round<'_>,
) -> Result<Option<Vec<BeforeAfter>>, SearchError> {
    let observations = whole.request.observations;
    if !are_cut_across(observations) || whole.request.second.is_some() {
        return Ok(None);
    }
    let by_row = Observations {
        groups: (0..observations.rows()).map(|row| row as u32).collect(),
        grouping: Grouping::default(),
        ..observations.clone()
    };
    let whole = Context { request: Request { observations: &by_row, ..whole.request }, ..whole.clone() };
    let round = Round::at(&whole, round.fitted.clone())?;
    let problem = &round.search.problem;
    if problem.folds() < 2 {
        return Ok(None);
    }
    let found = round.fitted.found.iter().flat_map(|found| problem.columns(found.effect));
    let held_out = HeldOut::of_columns(problem, &found.collect::<Vec<_>>());
    Ok(Some(held_out::rms(&whole, before, &round, &held_out)?.rms))
}
