//! The whole loop: fit, whiten, search, amend, fit again, judge on held-out data, report.
//!
//! One round (`round`) fits the declaration with the effects accepted so far (`fitted`), sets up the search at that fit
//! (`posed`, from rows as `portion` has them) and searches from there; rounds go on until one changes nothing. Then the search is repeated in every fold (`held_out`), and everything is put into
//! words (`words`).

pub(crate) mod fitted;
pub(crate) mod held_out;
mod outliers;
pub(crate) mod round;
mod stage;

use model_core::{Chain, ObservableId, SymbolId};

use crate::amend::{AmendError, amend};
use crate::candidate::{Effect, Setting};
use crate::catalogue::{Name, catalogue, chosen, known_names};
use crate::data::Observations;
use crate::diagnose;
use crate::fit::{FitError, FitResult, Outcome};
use crate::report::Report;
use crate::report::words;
use crate::search::{HeldOut, Options, ProblemError, nested};
use crate::study::Plan;
use fitted::Fitted;
use round::Round;

pub use stage::Stage;

/// Rounds of fit and search at most.
const ROUNDS: usize = 8;

/// Numbers that a matrix of the search holds at most (128 MB). Rows that need more are merged.
const HELD: usize = 1 << 24;

/// What to calibrate.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// The user's declaration as written.
    pub text: &'a str,
    /// The study, with every name resolved.
    pub plan: &'a Plan,
    /// The measured data.
    pub observations: &'a Observations,
    /// A second file that no stage sees, if the study names one.
    pub second: Option<&'a Observations>,
    /// The date that the amended declaration gives: `2026-11-21`.
    pub when: &'a str,
}

/// Everything that a calibration makes.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// The report.
    pub report: Report,
    /// The user's text with lines added; the text itself if nothing was found.
    pub amended: String,
    /// The chain with the effects that were found.
    pub chain: Chain,
    /// The fit of the declaration as it was.
    pub before: FitResult,
    /// The fit of the amended chain.
    pub after: FitResult,
}

/// Why there is no calibration.
#[derive(Debug, thiserror::Error)]
pub enum CalibrateError {
    /// The study asks for something that cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The data lead to numbers that cannot be searched.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The text is not that of the chain.
    #[error(transparent)]
    Amend(#[from] AmendError),
}

/// An accepted effect: its number in the catalogue, and the evidence for it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Found {
    pub effect: usize,
    pub p_value: f64,
    /// Its class when it was accepted, itself included.
    pub alike: Vec<usize>,
}

/// What all rounds share.
#[derive(Clone)]
pub(crate) struct Loop<'a> {
    pub request: Request<'a>,
    pub catalogue: Vec<Effect>,
    /// What other fields call each effect of the catalogue.
    pub names: Vec<Vec<Name>>,
    pub options: Options,
    pub setting: Setting<'a>,
    /// Numbers that a matrix of the search holds at most.
    pub held: usize,
    /// Is told of each stage.
    pub tell: &'a (dyn Fn(Stage) + Sync),
}

impl<'a> Loop<'a> {
    pub fn new(request: Request<'a>, observables: &'a [ObservableId], held: usize) -> Self {
        let plan = request.plan;
        let setting = plan.search.setting(&plan.chain, observables);
        let options =
            Options { false_alarm: plan.search.false_alarm, seed: plan.hold_out.seed, ..Options::default() };
        let catalogue = chosen(&setting, catalogue(&setting), &plan.search.only).unwrap_or_default();
        let names = known_names(&setting, &catalogue);
        Self { request, catalogue, names, options, setting, held, tell: &|_| () }
    }
}

/// Runs the loop.
///
/// # Errors
/// What the caller did wrong; whatever the data say is in the report.
pub fn calibrate(request: Request<'_>) -> Result<Calibration, CalibrateError> {
    calibrate_telling(request, &|_| ())
}

/// Runs the loop, and tells `tell` of each stage as it begins.
///
/// # Errors
/// As [`calibrate`].
pub fn calibrate_telling(
    request: Request<'_>,
    tell: &(dyn Fn(Stage) + Sync),
) -> Result<Calibration, CalibrateError> {
    let observables: Vec<_> = request.observations.series.iter().map(|series| series.observable).collect();
    let whole = Loop { tell, ..Loop::new(request, &observables, HELD) };

    let first = Round::at(&whole, Fitted::first(&whole)?)?;
    let before = first.fitted.fit.clone();
    let round = outliers::reconsidered(&whole, rounds(&whole, first)?)?;
    tell(Stage::HeldOut);
    let held_out: HeldOut = nested(&round.posed.problem, &round.classes, &whole.options);
    let rms = held_out::rms(&whole, &before, &round, &held_out)?;
    let additions = words::additions(&whole, &round, &held_out, rms);
    let inputs = words::new_inputs(&whole, &round);
    let amended = amend(request.text, &round.fitted.chain, &additions, &inputs)?;
    tell(Stage::Remaining);
    let remaining = diagnose::remaining::remaining(&whole, &round)?;
    let report = words::report(&whole, &round, &held_out, rms, remaining);
    Ok(Calibration { report, amended, chain: round.fitted.chain, before, after: round.fitted.fit })
}

/// Rounds of search and fit from a first one, until one changes nothing.
pub(crate) fn rounds<'a>(whole: &Loop<'a>, mut round: Round<'a>) -> Result<Round<'a>, CalibrateError> {
    let mut visited: Vec<Vec<usize>> = vec![names(&round.fitted.found)];
    for _ in 0..ROUNDS {
        (whole.tell)(Stage::Search);
        let found = round.search(whole);
        let names = names(&found);
        if visited.contains(&names) {
            break;
        }
        visited.push(names);
        let Some(next) = taken_up(whole, found, &round)? else { break };
        round = next;
    }
    Ok(round)
}

/// The numbers of some effects, sorted.
pub(crate) fn names(found: &[Found]) -> Vec<usize> {
    let mut names: Vec<usize> = found.iter().map(|found| found.effect).collect();
    names.sort_unstable();
    names
}

/// The next round; with the later half of the effects left out, again and again, while the exact form cannot hold what
/// the linear search likes. `None` if it can hold nothing new.
fn taken_up<'a>(
    whole: &Loop<'a>,
    mut found: Vec<Found>,
    last: &Round<'a>,
) -> Result<Option<Round<'a>>, CalibrateError> {
    while found.len() > last.fitted.found.len() {
        let next = Fitted::with(whole, found.clone(), &last.fitted)?;
        let failed = matches!(next.fit.outcome, Outcome::NotConverged { .. });
        if !failed || next.fit.rms < last.fitted.fit.rms {
            return Round::at(whole, next).map(Some);
        }
        found.truncate(found.len().div_ceil(2).min(found.len() - 1));
    }
    if found.is_empty() {
        return Ok(None);
    }
    Round::at(whole, Fitted::with(whole, found, &last.fitted)?).map(Some)
}

/// The symbols that the study estimates.
pub(crate) fn declared<'a>(whole: &Loop<'a>) -> &'a [SymbolId] {
    &whole.request.plan.fit.estimate
}
