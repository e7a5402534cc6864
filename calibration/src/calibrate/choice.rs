//! Whether a function of the library becomes an effect: it has to predict better what it was not fitted to.
//!
//! A table follows anything where the data are dense, and is worth nothing where they are not: on several instruments it
//! took the place of a physical effect, and was worse in regions that nobody had measured.

use std::cell::OnceCell;

use super::confirm::{Judged, judged};
use super::functions::{MOST, Settled, Winner, settled};
use super::heard::{Places, are_any, heard};
use super::whole_objects::are_cut_across;
use crate::contest::Hypothesis;
use crate::diagnose::Rms;
use crate::diagnose::rms::share;
use crate::search::SearchError;
use crate::search::context::Context;
use crate::search::library::AsGood;
use crate::search::round::Round;
use fit::FitResult;
use study::Plan;

/// By how much a function has to gain where it was not fitted: its thresholds, not its coefficients, saw every row.
const GAINS: f64 = 0.95;

/// So many squares of the noise are taken by chance by thresholds that are chosen among some ten thousand: twice its logarithm. Of few
/// rows they are no small part, and held-out rows do not tell, since the thresholds saw them.
const BY_THRESHOLDS: f64 = 20.0;

/// What counts as no worse: figures of a few hundred rows scatter by more.
pub(super) const NO_WORSE: f64 = 1.01;

/// What a function may leave at most of the rows that it was fitted to for the time that the trial takes.
const WORTH_TRYING: f64 = 0.98;

/// Effects that one function takes the place of are its parts: harmonics follow any step, so many at a time. Then it has to predict
/// no worse than they do.
const SEVERAL: usize = 3;

/// Effects beyond which the catalogue has named nothing: it follows the data with whatever it has, and a function more is one of
/// many.
pub(super) const NAMED: usize = 10;

/// Functions that are tried at most where the study does not ask for them: each costs as much time as the search before it.
const TRIED: usize = 2;

/// Where the studies live that these loops read.
#[derive(Default)]
pub(super) struct Studies {
    plans: [OnceCell<Plan>; MOST],
    places: Places,
}

/// The round that the report is about, and what judged it.
pub(super) struct Chosen<'a> {
    pub whole: Context<'a>,
    pub judged: Judged<'a>,
    /// Functions that explain the data about as well as accepted effects.
    pub as_good: Vec<AsGood>,
    /// Who competed, where a contest was held.
    pub contest: Vec<Hypothesis>,
}

impl<'a> Chosen<'a> {
    /// Where no function competes.
    pub fn of(whole: Context<'a>, judged: Judged<'a>) -> Self {
        Self { whole, judged, as_good: Vec::new(), contest: Vec::new() }
    }
}

/// Lets the library compete, and takes up what wins as the study says; by default if it is confirmed.
pub(super) fn chosen<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    round: Round<'a>,
    studies: &'a Studies,
) -> Result<Chosen<'a>, SearchError> {
    let functions = whole.request.plan.search.functions;
    let with_functions =
        |round, most: usize| heard(settled(whole, &studies.plans[..most], round)?, &studies.places, most);
    if functions == Some(true) {
        return judge(with_functions(round, MOST)?, before);
    }
    let told = settled(whole, &[], round)?;
    let is_worth_it = |winner: Winner| winner.leaves < WORTH_TRYING || winner.stands_for >= SEVERAL;
    let may_gain = || told.winner.is_some_and(is_worth_it) || are_any(&told);
    // Objects that are left out saw the same drift as the others: of stretches they confirm nothing.
    let confirms_nothing = are_cut_across(whole.request.observations);
    if functions == Some(false) || confirms_nothing || told.round.fitted.found.len() > NAMED || !may_gain() {
        return judge(told, before);
    }
    let fitted = told.round.fitted.clone();
    let told = judge(told, before)?;
    let taken_up = judge(with_functions(Round::at(whole, fitted)?, TRIED)?, before)?;
    Ok(if is_confirmed(whole, &told.judged, &taken_up.judged) { taken_up } else { told })
}

fn judge<'a>(settled: Settled<'a>, before: &FitResult) -> Result<Chosen<'a>, SearchError> {
    let Settled { whole, round, as_good, .. } = settled;
    let judged = judged(&whole, before, round)?;
    let as_good = if judged.left_out.is_empty() { as_good } else { Vec::new() };
    Ok(Chosen { as_good, ..Chosen::of(whole, judged) })
}

/// Whether the model with functions predicts better: in random folds by a margin, and no worse in regions that its search did
/// not see; or no worse at all where it says with one function what took several effects. A second file of the study judges and
/// does not choose; regions alone choose then, by the margin.
///
/// Which rows are kept is for each model to say: one that explains rows which the other sets aside keeps more, and gains over
/// every row.
fn is_confirmed(whole: &Context<'_>, told: &Judged<'_>, taken_up: &Judged<'_>) -> bool {
    let ratio = |of: fn(&Rms) -> Option<f64>| share(&taken_up.rms, &told.rms, of);
    let elsewhere = ratio(|rms| rms.elsewhere_rms_kept);
    let (kept, every) = match whole.request.second {
        None => (ratio(|rms| rms.held_out_rms_kept), ratio(|rms| rms.held_out_rms)),
        Some(_) => (elsewhere, None),
    };
    let by_chance = BY_THRESHOLDS / told.round.fitted.fit.degrees_of_freedom;
    let most = GAINS.min((1.0 - by_chance).max(0.0).sqrt());
    let gains = |ratio: Option<f64>| ratio.is_some_and(|ratio| ratio < most);
    let no_worse = |ratio: Option<f64>| ratio.is_none_or(|ratio| ratio <= NO_WORSE);
    let effects = |judged: &Judged<'_>| judged.round.fitted.found.len();
    // The function itself is one of those.
    let is_simpler = effects(taken_up) + SEVERAL <= effects(told) + 1;
    taken_up.left_out.is_empty()
        && (is_simpler || gains(kept) || gains(every))
        && [kept, every, elsewhere].into_iter().all(no_worse)
}
