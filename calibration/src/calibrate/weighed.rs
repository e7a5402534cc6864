//! What the contest says: which causes there are, where the catalogue's explain all that there is; and whether there is any, weighed
//! against what hangs together along the rows.

use std::cell::OnceCell;
use std::sync::Arc;

use super::memory::remembering;
use super::rounds::{names, taken_up};
use crate::contest::{Contest, Hypothesis, Repeated, Told, is_asked};
use crate::diagnose::Caution;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{SearchError, Stage};
use study::Plan;

/// Fits with the contest's causes at which it is asked again, at most.
const POINTS: usize = 3;

/// What the contest leaves of a search: the calibration, its last round, and what is said of effects that were left out again.
type Left<'a> = (Context<'a>, Round<'a>, Option<Caution>);

/// What the contest tells of the declaration's own fit; `None` where none is asked.
pub(super) fn weighed(whole: &Context<'_>, first: &Round<'_>) -> Result<Option<Told>, SearchError> {
    // Too few rows tell nothing.
    if !is_asked(whole) || !first.tells_structure() {
        return Ok(None);
    }
    (whole.tell)(Stage::Weigh);
    Ok(Contest::at(whole, &first.fitted)?.told(whole))
}

/// The round with the contest's causes in the exact chain, where they explain all that there is. With them the contest is asked again: what
/// is left by large effects to first order is no other cause. `None` where it finds no end.
pub(super) fn explained<'a>(
    whole: &Context<'a>,
    first: &Round<'a>,
    told: &Told,
) -> Result<Option<(Round<'a>, Vec<Hypothesis>)>, SearchError> {
    let search = &whole.request.plan.search;
    let mut told = told.clone();
    let mut last = None;
    for _ in 0..POINTS {
        let asks_for_more = search.functions == Some(true) || told.causes.len() > search.most;
        if !told.explains() || asks_for_more {
            return Ok(None);
        }
        let from = last.as_ref().unwrap_or(first);
        let Some(mut next) = taken_up(whole, told.causes.clone(), from)? else { return Ok(None) };
        let contest = Contest::at(whole, &next.fitted)?;
        let Some(again) = contest.told(whole) else { return Ok(None) };
        if names(&again.causes) == names(&next.fitted.found) {
            if !again.explains() {
                return Ok(None);
            }
            for found in &mut next.fitted.found {
                let as_told = again.causes.iter().find(|told| told.effect == found.effect);
                as_told.into_iter().for_each(|told| found.clone_from(told));
            }
            let Some(among) = again.again else { return Ok(None) };
            let repeated = Repeated { contest, among };
            return Ok(Some((next.explained_by(Arc::new(repeated)), again.contest)));
        }
        told = again;
        last = Some(next);
    }
    Ok(None)
}

/// The last round as the contest leaves it: without effects where it tells none, with its causes where the search found none.
pub(super) fn settled<'a>(
    whole: Context<'a>,
    place: &'a OnceCell<Plan>,
    round: Round<'a>,
    told: &Told,
) -> Result<Left<'a>, SearchError> {
    let found = &round.fitted.found;
    // Groups that somebody declared say what hangs together, and the search knows of them.
    if !whole.request.observations.rows_are_alone() {
        return Ok((whole, round, None));
    }
    if found.is_empty() && !told.is_open {
        let next = taken_up(&whole, told.causes.clone(), &round)?;
        return Ok((whole, next.unwrap_or(round), None));
    }
    if found.is_empty() || !told.is_nothing() || !told.hangs_together() {
        return Ok((whole, round, None));
    }
    let names = found.iter().map(|found| whole.catalogue[found.effect].name.clone()).collect();
    let Told { remembers, setups, ref column, .. } = *told;
    let left_out = Some(Caution::FollowsOrder { effects: names, remembers, setups, column: column.clone() });
    let may_remember = told.remembers && whole.request.plan.fit.noise.serial;
    let whole = if may_remember { remembering(whole, place) } else { whole };
    let round = Round::at(&whole, Fitted::with(&whole, Vec::new(), &round.fitted)?)?;
    Ok((whole, round, left_out))
}
