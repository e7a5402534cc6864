//! How large the declared errors may be: by where they stand, a tilt, a length, a placement or an index.

use model_core::algebra::Poly;
use model_core::{Chain, ObservableId, Passed, Role, SymbolId, SymbolKind, TransformKind};
use nalgebra::Vector3;
use serde::Serialize;

use super::estimated;
use super::policy::{
    BEYOND, LENGTH_SHARE, MOST_LENGTH_SHARE, MOST_RESIDUAL_SHARE, MOST_TILT_RAD, TILT_RAD, TOOL_SHARE,
};
use super::size::of_objects;
use fit::FitResult;
use observe::{Observations, SiUnit};
use study::Plan;

/// What an error is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// An axis against where the declaration puts it.
    Tilt,
    /// A length between joints.
    Length,
    /// A shift behind the last joint.
    Tool,
    /// Where a joint is zero, where the instrument stands, how it is turned, or what multiplies something: any size is plausible.
    Free,
}

/// The scale of each estimated error; errors without one may be of any size.
pub(super) struct Priors {
    scales: Vec<Scaled>,
}

struct Scaled {
    error: SymbolId,
    scale: f64,
    /// Beyond it a value is no finding.
    limit: f64,
}

impl Priors {
    pub fn of(plan: &Plan, observations: &Observations) -> Self {
        let reach_m = reach_m(&plan.chain, observations);
        let scale = |error: SymbolId| {
            let (scale, limit) = match part(&plan.chain, observations, error) {
                Part::Tilt => (TILT_RAD, MOST_TILT_RAD),
                Part::Length => (LENGTH_SHARE * reach_m, MOST_LENGTH_SHARE * reach_m),
                Part::Tool => (TOOL_SHARE * reach_m, f64::INFINITY),
                Part::Free => return None,
            };
            // A study that takes larger values for plausible expects larger ones.
            let own = plan.plausible.iter().find(|(limited, _)| *limited == error).map(|(_, own)| *own);
            let (own, raised) = own.map_or((limit, 1.0), |own| (own, (own / limit).max(1.0)));
            Some(Scaled { error, scale: scale * raised, limit: own })
        };
        Self { scales: estimated(plan).filter_map(scale).collect() }
    }

    /// What errors of this size cost, nats: a t distribution with three degrees of freedom, against its value at zero; and as much again as
    /// rules a reading out where one is surely beyond its limit, or where stations are nowhere near.
    pub fn penalty(&self, fit: &FitResult, has_strayed: bool) -> f64 {
        let value = |own: &Scaled| fit.values[own.error.index()];
        let cost = |own: &Scaled| 2.0 * ((value(own) / own.scale).powi(2) / 3.0).ln_1p();
        let is_surely_beyond = |own: &Scaled| is_surely(fit, own.error, value(own).abs() - own.limit);
        let is_beyond = has_strayed || self.scales.iter().any(is_surely_beyond);
        let beyond = if is_beyond { BEYOND } else { 0.0 };
        self.scales.iter().map(cost).sum::<f64>() + beyond
    }

    /// Whether an error is too large to be one.
    pub fn is_beyond(&self, values: &[f64]) -> bool {
        self.beyond(values).is_some()
    }

    /// The error that is most times its limit, with that limit; `None` where none is beyond its own.
    pub fn beyond(&self, values: &[f64]) -> Option<(SymbolId, f64)> {
        let times = |own: &Scaled| values[own.error.index()].abs() / own.limit;
        let most = self.scales.iter().max_by(|one, other| times(one).total_cmp(&times(other)))?;
        (times(most) > 1.0).then_some((most.error, most.limit))
    }
}

/// A value that no small error has.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Implausible {
    /// An error is beyond its limit.
    Error {
        /// Its name.
        name: String,
        /// Its value, SI.
        value: f64,
        /// The limit, SI.
        limit: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// What is left is a large part of what was measured.
    Residual {
        /// RMS of the residual, SI.
        rms: f64,
        /// The size of what was measured, SI: a radian of directions, the usual distance from their middle of points and of unknown objects.
        size: f64,
        /// Their unit.
        unit: SiUnit,
    },
}

/// What no small error explains of a fit: errors beyond their limits, and a residual that is a large part of what was measured.
///
/// `limits` are the study's own, SI; an error with one is held to it alone. Errors that are not small by right have none: indices, homes,
/// placements, constants and what multiplies something.
#[must_use]
pub fn implausible(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    limits: &[(SymbolId, f64)],
) -> Vec<Implausible> {
    // Where rows observe unknown objects, an instrument reaches as far as these are apart.
    let room_m = of_objects(chain, observations, &fit.values).map(|own| own.usual_m);
    let reach_m = room_m.unwrap_or(0.0).max(reach_m(chain, observations));
    let mut found = Vec::new();
    for &id in &fit.parameters {
        let symbol = chain.symbol(id);
        let own = limits.iter().find(|(limited, _)| *limited == id).map(|(_, limit)| *limit);
        let limit = own.or_else(|| match part(chain, observations, id) {
            Part::Tilt => Some(MOST_TILT_RAD),
            Part::Length => Some(MOST_LENGTH_SHARE * reach_m),
            Part::Tool | Part::Free => None,
        });
        let value = fit.values[id.index()];
        let Some(limit) = limit.filter(|limit| value.abs() > *limit) else { continue };
        if is_surely(fit, id, value.abs() - limit) {
            let unit = symbol.quantity.into();
            found.push(Implausible::Error { name: symbol.name.clone(), value, limit, unit });
        }
    }
    if let Some(series) = observations.poses.series.first() {
        let unit = series.measure.unit();
        let size = match &observations.unknowns {
            Some(_) if unit == SiUnit::METRE => room_m.unwrap_or(0.0),
            _ => measured_size(observations),
        };
        let rms = fit.rms;
        let of_one_unit = observations.poses.series.iter().all(|own| own.measure.unit() == unit);
        if of_one_unit && size > 0.0 && rms > MOST_RESIDUAL_SHARE * size {
            found.push(Implausible::Residual { rms, size, unit });
        }
    }
    found
}

/// Whether the uncertainty of an error is less than what it is beyond a limit. A value that these data do not determine is no value.
fn is_surely(fit: &FitResult, error: SymbolId, beyond: f64) -> bool {
    let at = fit.parameters.iter().position(|id| *id == error);
    let is_determined = at.and_then(|at| fit.separable.get(at)).copied().unwrap_or(false);
    is_determined && fit.standard_uncertainty(error).is_some_and(|own| own < beyond)
}

/// The size of what was measured, SI: a radian of directions, the usual distance from their middle of points.
pub(super) fn measured_size(observations: &Observations) -> f64 {
    let unit = observations.poses.series.first().map(|series| series.measure.unit());
    if unit == Some(SiUnit::RAD) { 1.0 } else { spread_m(observations) }
}

/// What an error is of, by the factors that it stands in.
fn part(chain: &Chain, observations: &Observations, id: SymbolId) -> Part {
    if chain.symbol(id).kind != SymbolKind::Error {
        return Part::Free;
    }
    let observables = observations.poses.series.iter().map(|series| series.observable);
    observables
        .map(|observable| part_of_way(chain, observable, id))
        .max_by_key(|part| *part == Part::Free)
        .unwrap_or(Part::Free)
}

/// The same on the way to one observable.
fn part_of_way(chain: &Chain, observable: ObservableId, id: SymbolId) -> Part {
    let way = chain.way(observable);
    let moves = motions(chain, &way);
    let (Some(&first), Some(&last)) = (moves.first(), moves.last()) else { return Part::Free };
    let own: Vec<usize> =
        (0..way.len()).filter(|&at| way[at].factor.amount.symbols().contains(&id)).collect();
    let [at] = own[..] else { return Part::Free };
    let factor = &way[at].factor;
    // What multiplies a function, or is multiplied by a constant, is no size of its own.
    let is_alone =
        factor.amount.terms().all(|term| {
            term.powers.iter().all(|(symbol, _)| *symbol == id)
                || !term.powers.iter().any(|(symbol, _)| *symbol == id)
        }) && factor.amount.symbols().iter().all(|symbol| chain.symbol(*symbol).kind != SymbolKind::Joint);
    if !is_alone {
        return Part::Free;
    }
    let shows_direction = chain.observable(observable).is_vector() && factor.kind == TransformKind::Rotation;
    let is_index = moves.iter().any(|&motion| is_index_of(&way, at, motion));
    match factor.kind {
        _ if is_index => Part::Free,
        TransformKind::Rotation if at < first && !(shows_direction && is_direction(chain, observable)) => {
            Part::Free
        }
        TransformKind::Rotation => Part::Tilt,
        TransformKind::Translation if at < first => Part::Free,
        TransformKind::Translation if at > last && way[at].body != way[last].body => Part::Tool,
        TransformKind::Translation => Part::Length,
    }
}

/// Where joints move on a way.
fn motions(chain: &Chain, way: &[Passed<'_>]) -> Vec<usize> {
    let is_motion =
        |amount: &Poly| amount.symbols().iter().any(|symbol| chain.symbol(*symbol).kind == SymbolKind::Joint);
    (0..way.len())
        .filter(|&at| way[at].factor.role == Role::Motion && is_motion(&way[at].factor.amount))
        .collect()
}

/// Whether what stands at a place of a way says where a motion is zero: it turns or shifts as the motion does, and nothing stands between
/// them but small errors.
fn is_index_of(way: &[Passed<'_>], at: usize, motion: usize) -> bool {
    let is_alike = |other: usize| {
        let (one, other) = (&way[at].factor, &way[other].factor);
        one.axis == other.axis && one.kind == other.kind
    };
    let is_small = |other: usize| matches!(way[other].factor.role, Role::PositionError | Role::MotionError);
    let between = || motion.min(at) + 1..motion.max(at);
    let is_beside = between().all(|other| is_alike(other) || is_small(other));
    is_alike(motion) && (is_beside || way[motion].body == way[at].body)
}

/// The joints whose zero is an error that is estimated, each with that error.
pub(super) fn indexed(plan: &Plan, observations: &Observations) -> Vec<(SymbolId, SymbolId)> {
    let mut found = Vec::new();
    for series in &observations.poses.series {
        let way = plan.chain.way(series.observable);
        for motion in motions(&plan.chain, &way) {
            let joints = way[motion].factor.amount.symbols();
            for at in (0..way.len()).filter(|&at| is_index_of(&way, at, motion)) {
                let own = way[at].factor.amount.symbols();
                let errors = own.into_iter().filter(|id| estimated(plan).any(|other| other == *id));
                found.extend(errors.flat_map(|error| joints.iter().map(move |joint| (*joint, error))));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn is_direction(chain: &Chain, observable: ObservableId) -> bool {
    chain.observable(observable).kind == model_core::ObservableKind::Direction
}

/// How far the instrument reaches, m: its constant lengths on the way, how far the points lie apart where there are none, or one.
fn reach_m(chain: &Chain, observations: &Observations) -> f64 {
    let nominal = chain.nominal_values();
    let observables = observations.poses.series.iter().map(|series| series.observable);
    let of_way = |observable: ObservableId| -> f64 {
        let way = chain.way(observable);
        let lengths = way.iter().filter(|passed| {
            passed.factor.kind == TransformKind::Translation && passed.factor.role == Role::Position
        });
        lengths.map(|passed| passed.factor.amount.eval(&nominal).abs()).sum()
    };
    let reach = observables.map(of_way).fold(0.0, f64::max);
    // Directions alone say nothing of any length.
    [reach, spread_m(observations), 1.0].into_iter().find(|size| *size > 0.0).unwrap_or(1.0)
}

/// How far measured points usually lie from their middle, or how long ranges are, m.
fn spread_m(observations: &Observations) -> f64 {
    let points: Vec<Vector3<f64>> = observations
        .measured
        .iter()
        .filter_map(|measured| {
            let point = measured.point_m().copied();
            point.or_else(|| measured.range_m().map(|range_m| Vector3::x() * range_m))
        })
        .collect();
    if points.is_empty() {
        return 0.0;
    }
    let ranges = observations.measured.iter().all(|measured| measured.range_m().is_some());
    let middle =
        if ranges { Vector3::zeros() } else { points.iter().sum::<Vector3<f64>>() / points.len() as f64 };
    (points.iter().map(|point| (point - middle).norm_squared()).sum::<f64>() / points.len() as f64).sqrt()
}
