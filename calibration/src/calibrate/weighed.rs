//! What was found, weighed against what hangs together along the rows: the contest says whether there is any cause.

use std::cell::OnceCell;

use super::memory::remembering;
use super::rounds::taken_up;
use crate::contest::{Told, is_asked, told};
use crate::diagnose::Caution;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{SearchError, Stage};
use study::Plan;

/// What the contest leaves of a search: the calibration, its last round, and what is said of effects that were left out again.
type Left<'a> = (Context<'a>, Round<'a>, Option<Caution>);

/// What the contest tells of the declaration's own fit; `None` where none is asked.
pub(super) fn weighed(whole: &Context<'_>, first: &Round<'_>) -> Result<Option<Told>, SearchError> {
    // Groups that somebody declared say what hangs together, and too few rows tell nothing.
    let groups = &whole.request.observations.groups;
    let are_single = groups.windows(2).all(|pair| pair[0] != pair[1]);
    if !is_asked(whole) || !are_single || !first.tells_structure() {
        return Ok(None);
    }
    (whole.tell)(Stage::Weigh);
    told(whole, &first.fitted)
}

/// The last round as the contest leaves it: without effects where it tells none, with its causes where the search found none.
pub(super) fn settled<'a>(
    whole: Context<'a>,
    place: &'a OnceCell<Plan>,
    round: Round<'a>,
    told: &Told,
) -> Result<Left<'a>, SearchError> {
    let found = &round.fitted.found;
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
