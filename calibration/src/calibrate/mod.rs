//! The whole loop: fit, search, reconsider outliers, confirm, diagnose, amend.
//!
//! Rows that come back to one place and share an error there are grouped first (`places`). One round (`round` of [`crate::search`]) fits the declaration with the effects accepted so far and searches from there.
//! Rounds go on until one changes nothing (`rounds`). Then rows that were set aside together are reconsidered (`outliers`),
//! a memory of the noise competes with the effects (`memory`), shapes of the library compete with them (`functions`), the
//! search is repeated without each fold (`held_out`), effects that do not help there are left out (`confirm`), and shapes are taken
//! up where they help (`choice`). Where rows beside unknown objects that follow each other are off alike even so, all of it is done
//! once more: stretches of rows are then the groups (`stretches`), and whole objects are held out (`whole_objects`). Where a simpler model of the
//! `ladder` predicts held-out rows clearly better than all declared errors, all of it is done once more with that one (`simpler`).
//! [`crate::diagnose`] says what it means; the crate `report` says it in words.

mod amendment;
mod choice;
mod confirm;
mod every_row;
mod frozen;
mod functions;
mod heard;
pub(crate) mod held_out;
mod ladder;
mod memory;
mod orders;
mod outliers;
mod places;
mod rounds;
mod simpler;
mod stretches;
mod trials;
mod weighed;
mod whole_objects;
mod without;

use std::cell::OnceCell;

use model_core::{Chain, Mistakes};

use crate::amend::{AmendError, amend, with_quantities_of};
use crate::contest::Hypothesis;
use crate::diagnose::shown::{DRAWN, Shown};
use crate::diagnose::{
    Caution, Confirmed, Diagnosis, FrozenModel, Trace, Unsearched, diagnose, rounding, trace,
};
use crate::misread::{Judgement, Misread, implausible, judged as columns_judged};
use crate::search::SearchError;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use choice::{Chosen, chosen};
use confirm::{Judged, judged};
use fit::{FitResult, Outcome};
use network::{Placed, StartError, check_scale_of_ranges, placed};
use rounds::rounds;
use study::{Loaded, Open, Plan, Study};
use tables::formats::DataError;
use tables::units::BareColumn;
use weighed::Decided;

pub use crate::search::{Request, Stage};
pub use every_row::OfEveryRow;

/// Numbers that a matrix of the search holds at most (128 MB). Rows that need more are merged.
const HELD: usize = 1 << 24;

/// Everything that a calibration makes.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// What it comes to.
    pub diagnosis: Diagnosis,
    /// The user's text with lines added (the text itself if nothing was found); none where no usable model came out.
    pub amended: Option<String>,
    /// The rows that pictures draw: all, or a part of many.
    pub drawn: Vec<usize>,
    /// Each accepted effect over those rows, in the order of the diagnosis.
    pub traces: Vec<Trace>,
    /// The chain with the effects that were found; what each of its symbols measures is as the amended text says.
    pub chain: Chain,
    /// The fit of the declaration as it was.
    pub before: FitResult,
    /// The fit of the amended chain.
    pub after: FitResult,
    /// Where objects and stations came out by it; none where rows observe none, or no usable model came out.
    pub places: Option<Placed>,
}

/// Why there is no calibration.
#[derive(Debug, thiserror::Error)]
pub enum CalibrateError {
    /// The data cannot be fitted or searched as the study asks.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// Nothing holds the scale of what is to be estimated.
    #[error(transparent)]
    Scale(#[from] StartError),
    /// The amended text cannot be read, though the text can.
    #[error("internal error: the amended declaration cannot be read: {0}")]
    Amended(Mistakes),
    /// The text is not that of the chain.
    #[error(transparent)]
    Amend(#[from] AmendError),
}

/// Why a study has no calibration.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The declaration is wrong.
    #[error("the chain: {0}")]
    Chain(Mistakes),
    /// The study is wrong, or asks for what the chain does not have.
    #[error("the study: {0}")]
    Study(Mistakes),
    /// A data file is wrong.
    #[error(transparent)]
    Data(#[from] DataError),
    /// Nothing says the unit of a column, and its numbers are hardly in SI.
    #[error("{0}")]
    Doubtful(BareColumn),
    /// The data cannot be fitted as the study asks.
    #[error(transparent)]
    Calibrate(#[from] CalibrateError),
}

impl Calibration {
    /// Runs a study of a declaration: `open` gives the data files by their paths in the study, `when` is the date that the
    /// amended declaration gives (`2026-11-21`).
    ///
    /// # Errors
    /// What is wrong with the declaration, the study or the data; whatever the data say is in the diagnosis.
    pub fn of(text: &str, study: &Study, open: &mut Open<'_>, when: &str) -> Result<Self, StudyError> {
        let chain = Chain::from_text(text).map_err(StudyError::Chain)?;
        let plan = study.plan(&chain).map_err(StudyError::Study)?;
        let Loaded { observations, held_out, doubtful, sample, .. } = plan.load(open)?.without_repeats();
        if let Some(column) = doubtful.into_iter().next() {
            return Err(StudyError::Doubtful(column));
        }
        let second = held_out.as_ref();
        let sample = Some(&sample);
        Ok(calibrate(Request { text, plan: &plan, observations: &observations, sample, second, when })?)
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
    let Judgement { misread, start } =
        request.sample.map(|sample| columns_judged(request.plan, sample)).unwrap_or_default();
    let started = start.map(|start| {
        let mut plan = request.plan.clone();
        plan.fit.start = start;
        plan
    });
    let request = Request { plan: started.as_ref().unwrap_or(request.plan), ..request };
    let declared = of_request(request, misread, tell)?;
    let Some(plan) = simpler::plan(request.plan, &declared.diagnosis) else { return Ok(declared) };
    let simpler = of_request(Request { plan: &plan, ..request }, None, tell)?;
    Ok(simpler::told(declared, simpler))
}

/// The loop with the errors that a study asks for.
fn of_request(
    request: Request<'_>,
    misread: Option<Misread>,
    tell: &(dyn Fn(Stage) + Sync),
) -> Result<Calibration, CalibrateError> {
    let observables: Vec<_> =
        request.observations.poses.series.iter().map(|series| series.observable).collect();
    check_scale_of_ranges(&request.plan.chain, request.observations, &request.plan.fit)?;
    let loops = [Loop::default(), Loop::default(), Loop::default()];
    let (by_place, by_stretch, by_wave) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
    let whole = Context { tell, ..Context::new(request, &observables, HELD)? };

    let (whole, first) = places::grouped(whole, &by_place)?;
    let is_plausible = || {
        implausible(&request.plan.chain, request.observations, &first.fit, &request.plan.plausible).is_empty()
    };
    let has_converged = matches!(first.fit.outcome, Outcome::Converged { .. });
    if misread.is_some() || !has_converged || !is_plausible() {
        // What a failed fit leaves, or one of misread columns, is no residual to search.
        return unusable(&whole, first, misread);
    }
    if let Some(frozen) = &request.plan.frozen {
        let before = first.fit.clone();
        let fitted = frozen::fitted(&whole, frozen, &first)?;
        if !fitted.fit.outcome.is_usable() {
            return unusable(&whole, fitted, None);
        }
        let (judged, model) = frozen::judged(&whole, &before, frozen, fitted)?;
        return told(before, Chosen::of(whole.clone(), judged), Some(model));
    }
    let mut before = first.fit.clone();
    let round = Round::at(&whole, first)?;
    // What rounding leaves has a structure of its own; there is nothing to search in it.
    let is_rounding = rounding(request.observations, &before).is_some();
    let chosen = if is_rounding {
        Chosen::of(whole.clone(), judged(&whole, &before, round)?)
    } else {
        let found = searched(&whole, &before, round, &loops[0])?;
        let found = match stretches::grouped(whole, &found, &by_stretch)? {
            None => found,
            Some((whole, first)) => {
                before = first.fit.clone();
                searched(&whole, &before, Round::at(&whole, first)?, &loops[1])?
            }
        };
        with_waves(found, &before, &by_wave, &loops[2])?
    };
    told(before, chosen, None)
}

/// What a search, or a model that is given, comes to.
fn told(
    before: FitResult,
    chosen: Chosen<'_>,
    frozen: Option<FrozenModel>,
) -> Result<Calibration, CalibrateError> {
    let Chosen { whole, judged, as_good, contest } = chosen;
    let request = whole.request;
    // What rounding leaves separates no models.
    let ladder = match rounding(request.observations, &before) {
        Some(_) => None,
        None => ladder::ladder(&whole, &before, &judged)?,
    };
    let Judged { round, held_out, rms, left_out, .. } = judged;
    let confirmed =
        Confirmed { round: &round, held_out: &held_out, rms, as_good: &as_good, left_out, ladder };
    let diagnosis = Diagnosis { contest, frozen, ..diagnose(&whole, &before, &round.fitted, Ok(confirmed))? };
    let drawn = Shown::of(request.observations, &round.fitted.fit, DRAWN).rows;
    let traces = trace::traces(&whole, &round, &drawn)?;
    let mut chain = round.fitted.chain;
    let mut amended = None;
    if diagnosis.verdict.is_usable() {
        let additions =
            amendment::additions(&whole, &diagnosis, &chain, &round.fitted.found, &round.fitted.errors);
        let inputs = amendment::new_inputs(&whole, &chain, &round.fitted.found);
        let text = amend(request.text, &chain, &additions, &inputs)?;
        chain = with_quantities_of(chain, &text).map_err(CalibrateError::Amended)?;
        amended = Some(text);
    }
    let after = round.fitted.fit;
    let places = match amended {
        Some(_) => placed(&chain, request.observations, &after).map_err(SearchError::from)?,
        None => None,
    };
    Ok(Calibration { diagnosis, amended, drawn, traces, chain, before, after, places })
}

/// Where the studies live that one loop of searches makes for itself: with a memory of the noise, with functions of the library.
#[derive(Default)]
struct Loop {
    of_contest: weighed::Own,
    studies: choice::Studies,
}

/// What was chosen; or, where the residual behind it shows waves that no catalogue holds, what comes of a search that knows of them, if it
/// finds one and predicts better.
fn with_waves<'a>(
    found: Chosen<'a>,
    before: &FitResult,
    plan: &'a OnceCell<Plan>,
    own: &'a Loop,
) -> Result<Chosen<'a>, CalibrateError> {
    let Some((whole, first)) = orders::offered(&found, plan)? else { return Ok(found) };
    let last = last(&whole, Round::at(&whole, first)?, own)?;
    if !orders::has_wave(&last.whole, &last.round) {
        return Ok(found);
    }
    let with_waves = chosen_of(last, before, own)?;
    Ok(if orders::has_won(&found, &with_waves) { with_waves } else { found })
}

/// The last round of a search, before anything is left out to judge it.
struct Last<'a> {
    whole: Context<'a>,
    round: Round<'a>,
    /// Who competed, where a contest was held.
    contest: Vec<Hypothesis>,
    left_out: Vec<Caution>,
    /// Whether functions of the library may compete with what was found.
    is_open: bool,
}

/// From the first round to what the report is about.
fn searched<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    first: Round<'a>,
    own: &'a Loop,
) -> Result<Chosen<'a>, CalibrateError> {
    chosen_of(last(whole, first, own)?, before, own)
}

/// From the first round to the last one.
fn last<'a>(whole: &Context<'a>, first: Round<'a>, own: &'a Loop) -> Result<Last<'a>, CalibrateError> {
    let told = weighed::weighed(whole, &first)?;
    if let Some(told) = &told
        && let Some(Decided { whole, round, contest, caution }) =
            weighed::decided(whole, &first, told, &own.of_contest)?
    {
        let left_out = caution.into_iter().collect();
        return Ok(Last { whole, round, contest, left_out, is_open: false });
    }
    let round = outliers::reconsidered(whole, rounds(whole, first)?)?;
    let remembering = &own.of_contest.remembering;
    let (whole, round, left_out) = match &told {
        None => (whole.clone(), round, None),
        Some(told) => weighed::settled(whole.clone(), remembering, round, told)?,
    };
    let contest = told.map_or_else(Vec::new, |told| told.contest);
    if let Some(left_out) = left_out {
        return Ok(Last { whole, round, contest, left_out: vec![left_out], is_open: false });
    }
    let (whole, round) = memory::settled(whole, remembering, round)?;
    Ok(Last { whole, round, contest, left_out: Vec::new(), is_open: true })
}

/// What a last round comes to where parts of the data are left out.
fn chosen_of<'a>(last: Last<'a>, before: &FitResult, own: &'a Loop) -> Result<Chosen<'a>, CalibrateError> {
    let Last { whole, round, contest, left_out, is_open } = last;
    if is_open {
        return Ok(Chosen { contest, ..chosen(&whole, before, round, &own.studies)? });
    }
    let mut judged = judged(&whole, before, round)?;
    judged.left_out.extend(left_out);
    Ok(Chosen { contest, ..Chosen::of(whole, judged) })
}

/// What a first fit that cannot be gone on with comes to.
fn unusable(
    whole: &Context<'_>,
    first: Fitted,
    misread: Option<Misread>,
) -> Result<Calibration, CalibrateError> {
    let rms = held_out::of_fit(whole.request.observations, &first);
    let diagnosis = diagnose(whole, &first.fit, &first, Err(Unsearched { rms, misread }))?;
    let Fitted { chain, fit, .. } = first;
    let drawn = Shown::of(whole.request.observations, &fit, DRAWN).rows;
    Ok(Calibration {
        diagnosis,
        amended: None,
        drawn,
        traces: Vec::new(),
        chain,
        before: fit.clone(),
        after: fit,
        places: None,
    })
}
