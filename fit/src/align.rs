//! Where a base stands that nobody measured: the rigid motion that lays the points which the chain predicts over those
//! that were measured, in closed form, so that a fit starts near however the base is turned. Orientations alone turn a base and
//! do not shift it.
//!
//! A base is unknown when the way from the ground to an observed point begins with shifts along and turns about all three
//! axes by constants that are estimated and start at zero; of an observed orientation the turns are enough. Only starting
//! values come from here; the fit has the last word.

use model_core::algebra::Poly;
use model_core::{Axis, Chain, Factor, ObservableId, SymbolId, TransformKind};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::model::Model;
use super::sweep::residuals;
use super::{FitError, FitOptions, robust};
use crate::noise::Layout;
use observe::kinds::BaseShown;
use observe::{Observations, Series};

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// How often distances are weighed anew: outliers must not turn the base.
const ROUNDS: usize = 30;

/// The first factors of a path: a pose that is estimated.
#[derive(Debug, Clone, PartialEq)]
struct BasePose {
    /// The constant of the shift along x, y, z, with its sign.
    shifts: [(SymbolId, f64); 3],
    turns: BaseTurn,
}

/// Turns about all three axes in their order, that are estimated.
#[derive(Debug, Clone, PartialEq)]
struct BaseTurn {
    /// Axis and constant of each turn, with its sign.
    about: [(Axis, SymbolId, f64); 3],
}

/// The starting values of a fit: those of the options, and where they leave a base unknown its pose by alignment.
pub fn starting_values(
    chain: &Chain,
    observations: &Observations,
    options: &FitOptions,
) -> Result<Vec<f64>, FitError> {
    let is_point = |series: &&Series| series.measure.kind().base == BaseShown::Pose;
    let mut points = observations.poses.series.iter().filter(is_point);
    let pose = points.next().and_then(|series| BasePose::of(chain, series.observable, options));
    let Some(pose) = pose else { return turned_start(chain, observations, options) };
    let plain = Model::without_columns(chain, &observations.poses);
    let residual = residuals(&plain, observations, &options.start)?;
    let layout = Layout::of(observations);
    let (mut predicted, mut measured) = (Vec::new(), Vec::new());
    for series in observations.poses.series.iter().filter(is_point) {
        if BasePose::of(chain, series.observable, options).as_ref() != Some(&pose) {
            continue;
        }
        for row in series.rows.clone() {
            let Some(&point) = observations.measured[row].vector() else {
                unreachable!("what shows a pose measures points")
            };
            let first = layout.first(row);
            let difference = Vector3::new(residual[first], residual[first + 1], residual[first + 2]);
            measured.push(point);
            predicted.push(point - difference);
        }
    }
    let mut start = options.start.clone();
    if let Some((turn, shift)) = align_robustly(&predicted, &measured) {
        pose.set(&turn, &shift, &mut start);
    }
    Ok(start)
}

/// The same where orientations alone say how the base is turned.
fn turned_start(
    chain: &Chain,
    observations: &Observations,
    options: &FitOptions,
) -> Result<Vec<f64>, FitError> {
    let is_orientation = |series: &&Series| series.measure.kind().base == BaseShown::Turn;
    let orientations = || observations.poses.series.iter().filter(is_orientation);
    let of = |series: &Series| BaseTurn::of(chain, series.observable, options);
    let mut start = options.start.clone();
    let Some(base) = orientations().next().and_then(of) else { return Ok(start) };
    let plain = Model::without_columns(chain, &observations.poses);
    let residual = residuals(&plain, observations, &options.start)?;
    let layout = Layout::of(observations);
    let (mut from, mut to) = (Vec::new(), Vec::new());
    for row in
        orientations().filter(|series| of(series).as_ref() == Some(&base)).flat_map(|own| own.rows.clone())
    {
        // From a base that is not turned, what is left of a row is the turn of the base.
        let first = layout.first(row);
        let turn = Rotation3::new(Vector3::new(residual[first], residual[first + 1], residual[first + 2]));
        for axis in 0..3 {
            // Both ends of each axis, so that nothing is shifted.
            let end: Vector3<f64> = Vector3::ith(axis, 1.0);
            from.extend([end, -end]);
            to.extend([turn * end, turn * -end]);
        }
    }
    if let Some((turn, _)) = align_robustly(&from, &to) {
        base.set(&turn, &mut start);
    }
    Ok(start)
}

/// The constant that alone makes the amount of a factor, and nothing else, if it is estimated from zero.
fn free(
    chain: &Chain,
    observable: ObservableId,
    options: &FitOptions,
    factors: &[&Factor],
    factor: &Factor,
) -> Option<(SymbolId, f64)> {
    let [id] = factor.amount.symbols()[..] else { return None };
    let sign = if factor.amount == Poly::symbol(id) {
        1.0
    } else if factor.amount == -&Poly::symbol(id) {
        -1.0
    } else {
        return None;
    };
    let uses = factors.iter().filter(|other| other.amount.symbols().contains(&id)).count();
    let unknown = options.estimate.contains(&id) && options.start.get(id.index()) == Some(&0.0);
    let once =
        uses == 1 && !chain.observable(observable).components.iter().any(|own| own.symbols().contains(&id));
    (unknown && once).then_some((id, sign))
}

impl BaseTurn {
    /// The unknown turns that the path to an observable begins with, whatever its shifts, if it does.
    fn of(chain: &Chain, observable: ObservableId, options: &FitOptions) -> Option<Self> {
        let way: Vec<_> = chain.way(observable).into_iter().map(|passed| passed.factor).collect();
        let factors: Vec<&Factor> = way.iter().map(AsRef::as_ref).collect();
        let turns = factors.iter().filter(|factor| factor.kind == TransformKind::Rotation).take(3);
        let turns: Vec<&Factor> = turns.copied().collect();
        Self::of_factors(&turns, |factor| free(chain, observable, options, &factors, factor))
    }

    fn of_factors(turns: &[&Factor], free: impl Fn(&Factor) -> Option<(SymbolId, f64)>) -> Option<Self> {
        let turn = |factor: &Factor| {
            let (id, sign) = free(factor).filter(|_| factor.kind == TransformKind::Rotation)?;
            Some((factor.axis, id, sign))
        };
        let &[first, second, third] = turns else { return None };
        let about = [turn(first)?, turn(second)?, turn(third)?];
        AXES.iter().all(|axis| about.iter().any(|(own, ..)| own == axis)).then_some(Self { about })
    }

    /// Sets the constants so that the factors make this turn.
    ///
    /// Source: for R = R_i(a) R_j(b) R_k(c) with three different axes and e = ±1 the sign of their order,
    /// R_ik = e sin b, R_jk = −e sin a cos b, R_kk = cos a cos b, R_ij = −e cos b sin c, R_ii = cos b cos c.
    fn set(&self, turn: &Matrix3<f64>, values: &mut [f64]) {
        let [i, j, k] = self.about.map(|(axis, ..)| axis.index());
        let order = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
        let angles = [
            (-order * turn[(j, k)]).atan2(turn[(k, k)]),
            (order * turn[(i, k)]).clamp(-1.0, 1.0).asin(),
            (-order * turn[(i, j)]).atan2(turn[(i, i)]),
        ];
        for ((_, id, sign), angle) in self.about.iter().zip(angles) {
            values[id.index()] = sign * angle;
        }
    }
}

impl BasePose {
    /// The unknown pose that the path to an observable begins with, if it does.
    fn of(chain: &Chain, observable: ObservableId, options: &FitOptions) -> Option<Self> {
        let way: Vec<_> = chain.way(observable).into_iter().map(|passed| passed.factor).collect();
        let factors: Vec<&Factor> = way.iter().map(AsRef::as_ref).collect();
        let (first, _) = factors.split_at_checked(6)?;
        let (shifts, turns) = first.split_at(3);
        let free = |factor: &Factor| free(chain, observable, options, &factors, factor);
        let shift = |axis| {
            let own = shifts.iter().find(|factor| factor.axis == axis)?;
            free(own).filter(|_| own.kind == TransformKind::Translation)
        };
        let shifts = [shift(Axis::X)?, shift(Axis::Y)?, shift(Axis::Z)?];
        Some(Self { shifts, turns: BaseTurn::of_factors(turns, free)? })
    }

    /// Sets the constants so that the factors make this turn and shift.
    fn set(&self, turn: &Matrix3<f64>, shift: &Vector3<f64>, values: &mut [f64]) {
        for ((id, sign), amount) in self.shifts.iter().zip(shift) {
            values[id.index()] = sign * amount;
        }
        self.turns.set(turn, values);
    }
}

/// The turn and shift that make the sum of the distances between two sets of points small, whatever the outliers; `None` for
/// points that are no numbers.
pub fn align_robustly(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let mut weight = vec![1.0; from.len()];
    let mut best = align(from, to, &weight)?;
    for _ in 0..ROUNDS {
        let (turn, shift) = best;
        let distances: Vec<f64> =
            from.iter().zip(to).map(|(from, to)| (to - turn * from - shift).norm()).collect();
        let typical = robust::median(distances.clone());
        if typical == 0.0 {
            break;
        }
        weight =
            distances.iter().map(|distance| (typical / distance.max(f64::MIN_POSITIVE)).min(1.0)).collect();
        best = align(from, to, &weight)?;
    }
    Some(best)
}

/// The turn R and shift t that make the weighted sum of |to − R from − t|² least.
///
/// Source: S. Umeyama, Least-squares estimation of transformation parameters between two point patterns, IEEE Transactions
/// on Pattern Analysis and Machine Intelligence 13 (1991) 376-380, equations (40) to (42) without the scale.
fn align(from: &[Vector3<f64>], to: &[Vector3<f64>], weight: &[f64]) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let sum: f64 = weight.iter().sum();
    let mean = |points: &[Vector3<f64>]| {
        points.iter().zip(weight).map(|(point, weight)| point * *weight).sum::<Vector3<f64>>() / sum
    };
    let (from_mean, to_mean) = (mean(from), mean(to));
    let product = from.iter().zip(to).zip(weight);
    let covariance: Matrix3<f64> =
        product.map(|((from, to), weight)| (to - to_mean) * (from - from_mean).transpose() * *weight).sum();
    // Without rows the means are no numbers.
    if !covariance.iter().chain(&from_mean).chain(&to_mean).all(|value| value.is_finite()) {
        return None;
    }
    let svd = covariance.svd(true, true);
    let (u, v) = (svd.u?, svd.v_t?);
    // A reflection is no motion: the direction that says least is turned round.
    let mut signs = Vector3::repeat(1.0);
    signs[svd.singular_values.imin()] = (u.determinant() * v.determinant()).signum();
    let turn = u * Matrix3::from_diagonal(&signs) * v;
    Some((turn, to_mean - turn * from_mean))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Unit;

    fn points(seed: f64) -> Vec<Vector3<f64>> {
        (0..20)
            .map(|at| f64::from(at) * seed)
            .map(|x| Vector3::new(x.sin(), (1.7 * x).cos(), (2.3 * x).sin()))
            .collect()
    }

    proptest::proptest! {
        #[test]
        fn any_motion_is_found_again(axis in proptest::array::uniform3(-1.0f64..1.0), angle in -3.1f64..3.1, shift in proptest::array::uniform3(-5.0f64..5.0)) {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis) + Vector3::new(0.0, 0.0, 1e-3)), angle);
            let from = points(0.37);
            let mut to: Vec<_> = from.iter().map(|point| turn * point + Vector3::from(shift)).collect();
            // A third of them elsewhere.
            to.iter_mut().step_by(3).for_each(|point| *point += Vector3::new(3.0, -2.0, 1.0));
            let (found, moved) = align_robustly(&from, &to).expect("finite points");
            assert_relative_eq!(found, *turn.matrix(), epsilon = 1e-3);
            assert_relative_eq!(moved, Vector3::from(shift), epsilon = 5e-3);
        }
    }

    #[test]
    fn turns_in_every_order_are_taken_apart() {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        for order in orders {
            let axes = order.map(|at| AXES[at]);
            let pose = BasePose {
                shifts: [0u16, 1, 2].map(|at| (SymbolId(at), 1.0)),
                turns: BaseTurn { about: [0, 1, 2].map(|at| (axes[at], SymbolId(3 + at as u16), -1.0)) },
            };
            let angles = [0.4, -1.1, 2.5];
            let about = |at: usize| {
                let mut axis = Vector3::zeros();
                axis[axes[at].index()] = 1.0;
                Rotation3::from_axis_angle(&Unit::new_unchecked(axis), angles[at])
            };
            let turn = about(0) * about(1) * about(2);
            let mut values = vec![0.0; 6];
            pose.set(turn.matrix(), &Vector3::new(1.0, 2.0, 3.0), &mut values);
            for (found, expected) in values.iter().zip([1.0, 2.0, 3.0, -0.4, 1.1, -2.5]) {
                assert_relative_eq!(*found, expected, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn points_that_say_nothing_are_no_trouble() {
        for from in [vec![], vec![Vector3::x()], vec![Vector3::x(); 5], vec![Vector3::repeat(f64::NAN); 4]] {
            if let Some((turn, shift)) = align_robustly(&from, &from) {
                assert!(turn.iter().chain(&shift).all(|value| value.is_finite()));
            }
        }
    }
}
