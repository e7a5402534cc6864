//! What a calibration means, as data: the verdict and everything that decides it, without a sentence.
//!
//! English is made of it in the crate `report`; `report.json` is this data itself.

mod at_zero;
mod basis;
mod budget;
mod by_cause;
mod caution;
pub(crate) mod detectability;
mod effects;
mod ended;
mod errors;
mod every_row;
pub mod few;
mod foretold;
mod frozen;
mod function;
mod goal;
mod harmonics;
mod instrument;
mod ladder;
mod lengths;
mod misplaced;
mod misread;
mod moved;
mod next;
mod noise;
mod noisy;
mod of_data;
mod precision;
mod reach;
pub(crate) mod remaining;
mod rivals;
pub(crate) mod rms;
mod scale_or_places;
pub(crate) mod shown;
pub(crate) mod trace;
mod two_places;
mod uneven;
mod units;
mod used;
mod verdict;

use model_core::SymbolId;
use serde::Serialize;

pub use crate::contest::Hypothesis;
use crate::design::discrimination::separation;
use crate::design::{PlaceProposal, Proposal, Separation};
use crate::search::HeldOut;
use crate::search::aside::{Shared, shared};
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::library::AsGood;
use crate::search::round::Round;
use crate::search::{SearchError, Stage};
use ::effects::candidate::EffectId;
use by_cause::ByCause;
use effects::Others;
use fit::FitResult;
use misread::misread;
use next::{Next, next};
use noisy::Noisy;
use observe::SiUnit;
use rms::BeforeAfter;
use scale_or_places::scale_or_places;
use verdict::Evidence;

pub use at_zero::{AtZero, BesideFunction};
pub use budget::{Budget, BudgetPart};
pub use caution::Caution;
pub use detectability::NotShown;
pub use effects::{Cause, EffectFound, Relation, Side};
pub use ended::Ended;
pub use errors::{ErrorFound, Estimable, Part};
pub use every_row::{EveryRow, Foretold, SharedByFiles};
pub use frozen::{FrozenModel, OtherTerm, TermFitted};
pub use function::Form;
pub use goal::Goal;
pub use harmonics::Harmonics;
pub use instrument::{
    BodyShown, ErrorShown, ErrorState, Instrument, JointShown, ObservedShown, ReadingShown,
};
pub use ladder::{Ladder, LeftOut, Rung, RungName, WhyNot};
pub use lengths::LengthsOff;
pub(crate) use misread::Unsearched;
pub use moved::Moved;
pub(crate) use noise::expected_rms;
pub use noise::{NoiseFound, SerialFound, SeriesNoise, UncertainReading, VarianceFound};
pub use observe::kinds::MeasuredLengths;
pub use of_data::{of_data, rounding};
pub use precision::{Determined, NotSeparable, Precision, precision};
pub(crate) use reach::largest_plausible;
pub use remaining::{Looked, Remaining, Where};
pub use rms::{Beside, Rms};
pub use shown::Shown;
pub use trace::Trace;
pub use two_places::TwoPlaces;
use uneven::Scatter;
pub use uneven::Uneven;
pub use used::{SetAsideRow, Used};
pub use verdict::Verdict;

/// What a calibration comes to, and everything that it found: `report.json`, whose keys are a promise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// The conclusion.
    pub verdict: Verdict,
    /// What casts doubt on it.
    pub cautions: Vec<Caution>,
    /// How the fits ended.
    pub fit: Fits,
    /// What was used.
    pub observations: Used,
    /// What every row says, where the search read only some of them; errors and coefficients are then those of every row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every_row: Option<EveryRow>,
    /// The errors that the study wants first, in their order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub wanted: Vec<String>,
    /// The declared and the new errors: those that are wanted, then the others in their order.
    pub errors: Vec<ErrorFound>,
    /// What each input has part in of the uncertainties, where the study states those of the reference.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub budgets: Vec<Budget>,
    /// Combinations that these data determine of errors that they do not determine one by one.
    pub estimable: Vec<Estimable>,
    /// Errors that stand for zero of an input from which the data lie far.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_zero: Vec<AtZero>,
    /// Errors that stand for where a function is zero that was found at their place.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beside_functions: Vec<BesideFunction>,
    /// Errors that these data cannot tell apart: only combinations of those in one list are determined.
    pub not_separable: Vec<Vec<String>>,
    /// How well each error is determined, and which rows carry the fit.
    pub precision: Precision,
    /// The noise.
    pub noise: NoiseFound,
    /// Where to measure next, if the study asks: D-optimal, then A-optimal.
    pub next_poses: Vec<Proposal>,
    /// Where to put stations, walls, targets, sockets and wires next, where rows observe objects and the study asks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub next_places: Vec<PlaceProposal>,
    /// Where to measure next to tell accepted effects from others that explain these data as well.
    pub separating: Vec<Separation>,
    /// The effects that were accepted, in the order they came in.
    pub effects: Vec<EffectFound>,
    /// What the terms come to of a model that the study gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frozen: Option<FrozenModel>,
    /// Who competed to explain what the declaration leaves, where a contest was held.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contest: Vec<Hypothesis>,
    /// How the search was made; absent where none was, because the fit failed.
    pub search: Option<Searching>,
    /// What is left after the effects; absent where no search was made.
    pub remaining: Option<Remaining>,
    /// Harmonics of each joint in the residual, with what noise alone would make.
    pub harmonics: Vec<Harmonics>,
    /// What these data could not have shown.
    pub not_shown: Vec<NotShown>,
    /// Residuals of the declaration as it was.
    pub before: Rms,
    /// Residuals of the amended one.
    pub after: Rms,
    /// Unit of the residuals: `rad` or `m`.
    pub unit: SiUnit,
    /// Residuals in other units: of directions and orientations beside points.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<Beside>,
    /// The specification that the study states; absent where it states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goal: Option<Goal>,
    /// Models from the instrument as delivered to the one with effects, each judged on held-out rows; absent where nothing was held out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ladder: Option<Ladder>,
    /// The chain with the effects that were found.
    pub instrument: Instrument,
}

/// How the fits ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fits {
    /// That of the declaration as it was.
    pub declared: Ended,
    /// That of the amended one.
    pub amended: Ended,
    /// Combinations that the data determine, of how many parameters.
    pub rank: [usize; 2],
    /// Degrees of freedom of the residual.
    pub degrees_of_freedom: f64,
}

/// How a search was made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Searching {
    /// Candidate effects.
    pub candidates: usize,
    /// Confounded sets of them, which these data could tell apart.
    pub sets: usize,
    /// Folds that the search was repeated without.
    pub folds: usize,
    /// Sign flips behind a familywise p.
    pub flips: usize,
    /// Seed of folds and flips.
    pub seed: u64,
    /// The chance of any effect where there is none that was accepted.
    pub false_alarm: f64,
}

/// A search with what confirms it.
pub(crate) struct Confirmed<'a> {
    pub round: &'a Round<'a>,
    pub held_out: &'a HeldOut,
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    /// Functions that explain the data about as well as accepted effects.
    pub as_good: &'a [AsGood],
    /// Effects that were left out again, since few rows speak for them, or held-out rows against them.
    pub left_out: Vec<Caution>,
    /// Models from the instrument as delivered to the one of the round.
    pub ladder: Option<Ladder>,
}

/// What fits and search come to. Without a search the fit alone is told: it failed, or had too few observations.
pub(crate) fn diagnose(
    whole: &Context<'_>,
    before: &FitResult,
    last: &Fitted,
    confirmed: Result<Confirmed<'_>, Unsearched>,
) -> Result<Diagnosis, SearchError> {
    let request = whole.request;
    let (observations, fit) = (request.observations, &last.fit);
    let ended = Ended::from(&fit.outcome);
    let noise = noise::noise(&last.chain, observations, fit, request.plan.fit.noise.sigma);
    let precision = precision(&last.chain, observations, fit);
    let found = match &confirmed {
        Ok(confirmed) => Found::of(whole, confirmed)?,
        Err(_) => Found::default(),
    };
    let errors = errors::errors(whole, last, &found.by_cause);
    let rms = confirmed.as_ref().map_or_else(|own| own.rms.as_slice(), |confirmed| &confirmed.rms);
    let mut cautions = cautions(&found, whole, rms);
    cautions.extend(few::hardly_more(observations, fit));
    cautions.extend(foretold::badly(rms).filter(|_| rounding(observations, fit).is_none()));
    if let (Ended::NotConverged { steps }, true) = (Ended::from(&before.outcome), !found.effects.is_empty()) {
        cautions.push(Caution::DeclarationNotFitted { steps });
    }
    cautions.extend(confirmed.iter().flat_map(|confirmed| confirmed.left_out.clone()));
    let most = |unit| largest_plausible(request.second.unwrap_or(observations), unit);
    cautions = cautions.into_iter().map(|caution| caution.within(most)).collect();
    let ladder = confirmed.as_ref().ok().and_then(|own| own.ladder.clone());
    cautions.extend(ladder.as_ref().and_then(Caution::of_ladder));
    cautions.extend(caution::of_noise(&noise, fit.degrees_of_freedom));
    cautions.extend(caution::of_readings(&noise));
    cautions.extend(caution::of_memory(fit));
    cautions.extend(of_data(&last.chain, observations, fit));
    let misplaced = misplaced::misplaced(&last.chain, observations, fit);
    let aside: Vec<usize> = fit.set_aside.iter().map(|aside| aside.row).collect();
    // Of what stands elsewhere rows are off for that.
    let aside: Vec<usize> =
        aside.into_iter().filter(|row| !misplaced::explains(&misplaced, observations, *row)).collect();
    let of_aside = shared(&observations.poses, &aside, whole.options.seed);
    cautions.extend(of_aside.map(|Shared { reading, from, to, rows }| {
        let unit = units::of_reading(&whole.setting, &last.chain, reading);
        let reading = last.chain.symbol(reading).name.clone();
        Caution::SetAsideShare { reading, from, to, unit, rows }
    }));
    let scatters = uneven::uneven(observations, fit).into_iter();
    let scatters = scatters.filter(|one| !misplaced.iter().any(|own| own.is(one.what, &one.label)));
    cautions.extend(scatters.map(|Scatter { what, label, times }| Caution::Scatters { what, label, times }));
    let searched = confirmed.as_ref().ok().map(|own| own.round);
    cautions.extend(searched.into_iter().flat_map(|round| scale_or_places(whole, round, &misplaced)));
    let misplaced: Vec<Caution> = misplaced.into_iter().map(Caution::from).collect();
    // Places that pull leave residuals of all kinds.
    if let (Some(round), true) = (searched, misplaced.is_empty()) {
        cautions.extend(moved::moved(whole, round).map(Caution::Moved));
        cautions.extend(lengths::lengths_off(whole, round).map(Caution::LengthsOff));
    }
    cautions.extend(misplaced);
    let columns = confirmed.as_ref().err().and_then(|own| own.misread.as_ref());
    let mut cautions = misread(whole, last, &ended, cautions, columns);
    let remaining = found.remaining.as_ref();
    cautions.extend(noisy_readings(whole, last, &found)?);
    let alone = found
        .effects
        .iter()
        .all(|effect| effect.confounded_with.is_empty() && effect.competing_with.is_empty());
    let follows_order = cautions.iter().any(|caution| matches!(caution, Caution::FollowsOrder { .. }));
    let verdict = verdict::verdict(Evidence {
        ended: &ended,
        unnamed: !follows_order && remaining.is_some_and(|remaining| remaining.place.is_some())
            || effects::has_unnamed(whole, last),
        // Where rows hang together along their order, that is the structure.
        structure: !follows_order
            && remaining.is_some_and(|remaining| remaining.p_value <= whole.options.false_alarm),
        effects: !found.effects.is_empty(),
        alone,
        form_open: found.effects.iter().any(|effect| !effect.form_determined),
        cautions: &cautions,
    });
    let next = if verdict.is_usable() { next(whole, last) } else { Next::default() };
    cautions.extend(next.missing);
    Ok(Diagnosis {
        verdict,
        cautions,
        fit: Fits {
            declared: Ended::from(&before.outcome),
            amended: ended,
            rank: [fit.rank, fit.parameters.len()],
            degrees_of_freedom: fit.degrees_of_freedom,
        },
        observations: used::used(observations, fit),
        every_row: None,
        instrument: instrument::instrument(&whole.setting, &last.chain, observations, &errors),
        wanted: request.plan.asked.wanted.iter().map(|id| last.chain.symbol(*id).name.clone()).collect(),
        budgets: budget::budgets(&last.chain, observations, fit, &errors)?,
        errors,
        estimable: errors::estimable(whole, last, &found.by_cause),
        at_zero: at_zero::at_zero(&whole.setting, &last.chain, observations, fit)?,
        beside_functions: at_zero::beside_functions(whole, last),
        not_separable: precision.not_separable.iter().map(|set| set.names.clone()).collect(),
        next_poses: next.poses,
        next_places: next.places,
        separating: found.separating,
        precision,
        noise,
        goal: Goal::of(request.plan.asked.rms, rms, !found.effects.is_empty(), most),
        effects: found.effects,
        frozen: None,
        contest: Vec::new(),
        search: found.search,
        remaining: found.remaining,
        harmonics: harmonics::harmonics(&last.chain, observations, before, fit),
        not_shown: found.not_shown,
        before: rms.first().map_or_else(Rms::default, |own| own.before.within(most(own.unit))),
        after: rms.first().map_or_else(Rms::default, |own| own.after.within(most(own.unit))),
        unit: rms.first().map_or(SiUnit::RAD, |own| own.unit),
        beside: rms
            .iter()
            .skip(1)
            .map(|own| Beside::of(observations, &last.chain, own, most(own.unit)))
            .collect(),
        ladder,
    })
}

/// Noise in the readings that what was found hangs on, where it would look like that.
fn noisy_readings(whole: &Context<'_>, last: &Fitted, found: &Found) -> Result<Vec<Caution>, SearchError> {
    let (chain, observations) = (&last.chain, whole.request.observations);
    let place = found.remaining.iter().filter_map(|remaining| remaining.place.as_ref());
    let drivers = place.map(|place| &place.driver).chain(found.effects.iter().map(|effect| &effect.driver));
    let mut readings: Vec<SymbolId> = drivers.filter_map(|name| chain.find_symbol(name)).collect();
    readings.sort_unstable();
    readings.dedup();
    // What looks like an effect is in the residual without it.
    let mut values = last.fit.values.clone();
    last.errors.iter().flatten().for_each(|error| values[error.index()] = 0.0);
    let noisy = readings.into_iter().map(|id| noisy::noisy(chain, observations, &last.fit, &values, id));
    let noisy: Vec<Option<Noisy>> = noisy.collect::<Result<_, _>>()?;
    let caution = |Noisy { reading, sigma, unit }| Caution::NoisyReadings { reading, sigma, unit };
    Ok(noisy.into_iter().flatten().map(caution).collect())
}

/// What a search found.
#[derive(Default)]
struct Found {
    effects: Vec<EffectFound>,
    separating: Vec<Separation>,
    remaining: Option<Remaining>,
    not_shown: Vec<NotShown>,
    search: Option<Searching>,
    by_cause: ByCause,
}

impl Found {
    fn of(whole: &Context<'_>, confirmed: &Confirmed<'_>) -> Result<Self, SearchError> {
        let last = confirmed.round;
        let others = effects::others(last);
        let mut effects = effects::effects(whole, last, confirmed, &others);
        for other in confirmed.as_good {
            let name = other.name(&last.fitted.chain);
            for &number in &other.instead_of {
                effects[number].competing_with.push(vec![name.clone()]);
                effects[number].form_determined &= !other.differs;
            }
        }
        let separating = |(at, others): (usize, &Others)| {
            let firsts = others.competing.iter().map(|members| &members[0]);
            let all: Vec<EffectId> = others.alike.iter().chain(firsts).copied().collect();
            separation(whole, last, at, &all, &others.behind)
        };
        (whole.tell)(Stage::Remaining);
        Ok(Self {
            separating: match whole.request.observations.unknowns {
                Some(_) => Vec::new(),
                None => others.iter().enumerate().filter_map(separating).collect(),
            },
            by_cause: ByCause::of(whole, last, &others),
            effects,
            remaining: Some(remaining::remaining(whole, last)?),
            not_shown: detectability::not_shown(whole, last, &confirmed.rms)?,
            search: Some(Searching {
                candidates: whole.catalogue.len(),
                sets: last.sets.len(),
                folds: confirmed.held_out.chosen.len(),
                flips: whole.options.flips,
                seed: whole.options.seed,
                false_alarm: whole.options.false_alarm,
            }),
        })
    }
}

/// What was found that casts doubt on itself.
fn cautions(found: &Found, whole: &Context<'_>, rms: &[BeforeAfter]) -> Vec<Caution> {
    let mut cautions = Vec::new();
    if !found.effects.is_empty() {
        cautions.extend(foretold::of_rms(rms));
    }
    if found.effects.len() >= whole.options.most && whole.request.plan.frozen.is_none() {
        cautions.push(Caution::LimitOfEffects { effects: found.effects.len() });
    }
    cautions
}
