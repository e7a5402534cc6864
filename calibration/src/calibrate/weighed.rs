//! What the contest says: that there is no cause, beside what hangs together along the rows, or which causes there are, where the
//! catalogue's explain all that there is.

use std::cell::OnceCell;
use std::sync::Arc;

use super::memory::remembering;
use super::rounds::{names, taken_up};
use crate::contest::{Contest, Hypothesis, Repeated, Told, is_asked};
use crate::diagnose::Caution;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{Request, SearchError, Stage};
use observe::Observations;
use study::Plan;

/// Fits with the contest's causes at which it is asked again, at most.
const POINTS: usize = 3;

/// Where the study and the observations live that a contest makes for itself: rows remember, or fall into set-ups.
#[derive(Default)]
pub(super) struct Own {
    pub remembering: OnceCell<Plan>,
    in_setups: OnceCell<Observations>,
}

/// What the contest decides.
pub(super) struct Decided<'a> {
    pub whole: Context<'a>,
    pub round: Round<'a>,
    pub contest: Vec<Hypothesis>,
    /// Set-ups that nobody declared.
    pub caution: Option<Caution>,
}

/// What the contest tells of the declaration's own fit; `None` where none is asked.
pub(super) fn weighed(whole: &Context<'_>, first: &Round<'_>) -> Result<Option<Told>, SearchError> {
    // Too few rows tell nothing.
    if !is_asked(whole) || !first.has_rows_to_weigh() {
        return Ok(None);
    }
    (whole.tell)(Stage::Weigh);
    Ok(Contest::at(whole, &first.fitted)?.told(whole))
}

/// The round with the contest's causes in the exact chain, or with none. With them the contest is asked again: what is left by large
/// effects to first order is no other cause. `None` where it does not decide, or finds no end.
pub(super) fn decided<'a>(
    whole: &Context<'a>,
    first: &Round<'a>,
    told: &Told,
    own: &'a Own,
) -> Result<Option<Decided<'a>>, SearchError> {
    if !told.decides() || whole.request.plan.search.functions == Some(true) {
        return Ok(None);
    }
    let (setups, column) = (told.setups, told.column.clone());
    let Some((whole, mut last, mut told)) = hanging_together(whole, first, told, own)? else {
        return Ok(None);
    };
    let mut contest = Contest::at(&whole, &last.fitted)?;
    let caution = (column.is_some() || setups > 1).then_some(Caution::FollowsOrder {
        effects: Vec::new(),
        remembers: false,
        setups,
        column,
    });
    for _ in 0..POINTS {
        if !told.decides() || told.causes.len() > whole.request.plan.search.most {
            return Ok(None);
        }
        if names(&told.causes) != names(&last.fitted.found) {
            let Some(next) = taken_up(&whole, told.causes.clone(), &last)? else { return Ok(None) };
            last = next;
            contest = Contest::at(&whole, &last.fitted)?;
            let Some(again) = contest.told(&whole) else { return Ok(None) };
            told = again;
            continue;
        }
        for found in &mut last.fitted.found {
            let as_told = told.causes.iter().find(|told| told.effect == found.effect);
            as_told.into_iter().for_each(|told| found.clone_from(told));
        }
        let Some(among) = told.again else { return Ok(None) };
        let round = last.explained_by(Arc::new(Repeated { contest, among }));
        return Ok(Some(Decided { whole, round, contest: told.contest, caution }));
    }
    Ok(None)
}

/// The first fit with what hangs together along the rows in its noise, and what the contest tells of it: rows that remember, or set-ups
/// that nobody declared, which count as groups.
fn hanging_together<'a>(
    whole: &Context<'a>,
    first: &Round<'a>,
    told: &Told,
    own: &'a Own,
) -> Result<Option<(Context<'a>, Round<'a>, Told)>, SearchError> {
    let is_alone = whole.request.observations.rows_are_alone();
    if let Some(labels) = told.labels.clone().filter(|_| is_alone) {
        let observations = own
            .in_setups
            .get_or_init(|| Observations { groups: labels, ..whole.request.observations.clone() });
        let whole = Context { request: Request { observations, ..whole.request }, ..whole.clone() };
        let first = Round::at(&whole, Fitted::first(&whole)?)?;
        let told = Contest::at(&whole, &first.fitted)?.told(&whole);
        return Ok(told.map(|told| (whole, first, told)));
    }
    let remembers = is_alone && told.remembers && whole.request.plan.fit.noise.serial;
    let whole = if remembers { remembering(whole.clone(), &own.remembering) } else { whole.clone() };
    let first = if remembers { Fitted::first(&whole)? } else { first.fitted.clone() };
    let first = Round::at(&whole, first)?;
    Ok(Some((whole, first, told.clone())))
}

/// What the contest leaves of a search: the calibration, its last round, and what is said of effects that were left out again.
type Left<'a> = (Context<'a>, Round<'a>, Option<Caution>);

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
