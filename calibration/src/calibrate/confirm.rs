//! Confirmation: effects that a handful of rows decide, and effects that do not help on rows which their search did not see, are
//! left out again.
//!
//! A search takes one effect by chance in about one of twenty residuals without any. Repeated without each fold, it takes
//! another one each time, or none, and predicts the rows left out worse than the declaration does. Where rows are few, the errors
//! that are fitted beside such an effect are as wrong as it is.

use super::held_out::{self, Judgement, Left};
use super::whole_objects;
use crate::diagnose::Caution;
use crate::diagnose::rms::{BeforeAfter, Worse, worse};
use crate::search::context::{Context, Found};
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::{HeldOut, SearchError};
use fit::FitResult;

/// Fewer observations than this are no evidence of an effect.
const FEW: f64 = 6.0;

/// The same where what is stated of stations shows it: how uncertain each is need not be told from the others, and one that is wrong is one.
const FEW_STATED: f64 = 3.0;

/// The round that the report is about, judged on held-out rows.
pub(super) struct Judged<'a> {
    pub round: Round<'a>,
    pub held_out: HeldOut,
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    /// What held-out rows leave.
    pub left: Option<Left<'a>>,
    /// The effects that were left out again.
    pub left_out: Vec<Caution>,
}

/// Repeats the search without each fold; if it predicts the rows left out worse with effects than without, the declaration
/// stands as it was. A second file of the study judges and does not choose.
pub(super) fn judged<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    round: Round<'a>,
) -> Result<Judged<'a>, SearchError> {
    let (round, mut left_out) = without_few(whole, round)?;
    if round.fitted.found.is_empty() && !left_out.is_empty() {
        return of_declaration(whole, before, round, left_out);
    }
    let held_out = round.held_out(whole);
    let Judgement { rms, left } = figures(whole, before, &round, &held_out)?;
    let Some(refused) =
        refused(whole, &round, &rms).filter(|_| !is_confirmed_by_places(whole, &round, &held_out))
    else {
        return Ok(Judged { round, held_out, rms, left, left_out });
    };
    left_out.push(refused);
    let round = Round::at(whole, Fitted::with(whole, Vec::new(), &round.fitted)?)?;
    of_declaration(whole, before, round, left_out)
}

/// The declaration as it was, judged: what was left out has no part in the figures either.
fn of_declaration<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    round: Round<'a>,
    left_out: Vec<Caution>,
) -> Result<Judged<'a>, SearchError> {
    let held_out = HeldOut::of_declared(&round.search.problem);
    let Judgement { rms, left } = figures(whole, before, &round, &held_out)?;
    Ok(Judged { round, held_out, rms, left, left_out })
}

/// Figures of rows left out: of whole objects where nothing else can be.
pub(super) fn figures<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    round: &Round<'_>,
    held_out: &HeldOut,
) -> Result<Judgement<'a>, SearchError> {
    match whole_objects::left_out(whole, before, round)? {
        Some(rms) => Ok(Judgement { rms, left: None }),
        None => held_out::rms(whole, before, round, held_out),
    }
}

/// The round without effects that hang on few observations, and what is told of them.
fn without_few<'a>(
    whole: &Context<'a>,
    mut round: Round<'a>,
) -> Result<(Round<'a>, Vec<Caution>), SearchError> {
    let mut left_out = Vec::new();
    loop {
        let behind = |found: &Found| round.observations_behind(found.effect);
        let least = |found: &Found| if round.is_shown_by_stations(found.effect) { FEW_STATED } else { FEW };
        let name = |found: &Found| whole.catalogue[found.effect].name.clone();
        let caution = |found: &Found| {
            if behind(found) < least(found) {
                return Some(Caution::FewBehindAnEffect { effect: name(found), observations: behind(found) });
            }
            let station = round.station_behind(found.effect)?;
            let unknowns = whole.request.observations.unknowns.as_ref()?;
            let station = unknowns.stations[station as usize].label.clone();
            Some(Caution::StationBehindAnEffect { effect: name(found), station })
        };
        let cautions: Vec<Option<Caution>> = round.fitted.found.iter().map(caution).collect();
        if cautions.iter().all(Option::is_none) {
            return Ok((round, left_out));
        }
        let kept = round.fitted.found.iter().zip(&cautions).filter(|(_, caution)| caution.is_none());
        let enough: Vec<Found> = kept.map(|(found, _)| found.clone()).collect();
        left_out.extend(cautions.into_iter().flatten());
        round = round.next(whole, Fitted::with(whole, enough, &round.fitted)?)?;
    }
}

/// Whether the places that are stated of objects and stations confirm what was found. An object that is left out is estimated anew, and follows
/// whatever its rows say as far as its uncertainty lets it: how far is in none of its residuals, but in their whitened sum. Of a station that
/// is left out it is in what is stated of it.
fn is_confirmed_by_places(whole: &Context<'_>, round: &Round<'_>, held_out: &HeldOut) -> bool {
    let unknowns = whole.request.observations.unknowns.as_ref();
    let of_objects = unknowns.is_some_and(|own| own.objects.iter().any(|object| object.freedom.is_within()));
    (of_objects || round.search.problem.stated() > 0) && {
        let (before, after) = held_out.sums_of_squares(&round.search.problem);
        after < before
    }
}

/// What is told of effects that the held-out rows speak against.
fn refused(whole: &Context<'_>, round: &Round<'_>, rms: &[BeforeAfter]) -> Option<Caution> {
    if round.fitted.found.is_empty() || whole.request.second.is_some() {
        return None;
    }
    // Gross outliers make a figure over every row a matter of chance.
    let Worse { unit, before, after } = worse(rms, |rms| rms.held_out_rms_kept)?;
    Some(Caution::NotConfirmed {
        effects: round.fitted.found.iter().map(|found| whole.catalogue[found.effect].name.clone()).collect(),
        p_value: round.fitted.found.iter().map(|found| found.p_value).fold(1.0, f64::min),
        before,
        after,
        unit,
    })
}
