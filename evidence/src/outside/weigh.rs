//! Weights, vetoes and widths outside, from what each rung did on the regions left out.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::regions::{Region, Side, nearest, quantile, regions, spreads};
use super::{Predicted, Rungs};
use crate::error::Error;
use crate::policy::Policy;

/// Poses at which the rungs are compared in a set outside.
const POSES: usize = 300;
/// Seed of those poses: a fixed one, so that an answer is the same every time.
const SEED: u64 = 20_261_127;

/// An end of a joint's range, or none for gaps, and from where to where poses are taken there.
type End = (Option<(usize, Side)>, (f64, f64));

/// Why a rung does not act in a set.
#[derive(Debug, Clone, PartialEq)]
pub struct Struck {
    /// The rung.
    pub rung: usize,
    /// RMS of its departure from the declared chain in the set.
    pub departs: f64,
    /// The largest departure it was tried with on a region, carried to the set's distance.
    pub tried: f64,
}

/// A set of poses outside: beyond the data at one end of a joint, or in a gap between them.
#[derive(Debug, Clone, PartialEq)]
pub struct OutsideSet {
    /// The joint and the end; none for gaps within the range of every joint.
    pub end: Option<(usize, Side)>,
    /// From where to where, for an end.
    pub range: (f64, f64),
    /// Weight of each rung.
    pub weights: Vec<f64>,
    /// The rungs that do not act here.
    pub struck: Vec<Struck>,
    /// Half width of an interval of 95 % over the root of the mixture's variance.
    pub factor: f64,
}

/// What acts outside, fixed at calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Stack {
    /// Names of the rungs.
    pub names: Vec<String>,
    /// The regions left out.
    pub regions: Vec<Region>,
    /// Mean squared length of each rung's error (outer) on each region (inner).
    pub squares: Vec<Vec<f64>>,
    /// Part of the values of the regions within their intervals.
    pub coverage: f64,
    /// Distance to the nearest row beyond which a pose is outside.
    pub edge: f64,
    /// The sets, two a joint and one for gaps.
    pub sets: Vec<OutsideSet>,
    poses: Vec<Vec<f64>>,
    spread: Vec<f64>,
    ranges: Vec<(f64, f64)>,
    all: Vec<f64>,
}

/// The answer for one pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Whether the pose is inside the measured region: then the full mixture answers with its own uncertainty.
    pub inside: bool,
    /// Weight of each rung.
    pub weights: Vec<f64>,
    /// Mean of each component.
    pub mean: Vec<f64>,
    /// Half width of an interval of 95 % for a reading; none inside.
    pub half_width: Option<Vec<f64>>,
}

/// A rung on one region: its errors and their variances, value by value.
struct Tried {
    errors: Vec<f64>,
    departs: Vec<f64>,
    uncertainty: Vec<f64>,
    noise: Vec<f64>,
}

pub(super) fn stack(rungs: &dyn Rungs, policy: &Policy) -> Result<Stack, Error> {
    let (names, poses, m) = (rungs.names(), rungs.poses(), rungs.components());
    let found = regions(poses, policy);
    let spread = spreads(poses);
    let mut tried: Vec<Vec<Tried>> = Vec::new();
    let mut near = Vec::new();
    for region in &found {
        let kept: Vec<usize> =
            (0..poses.len()).filter(|row| region.rows.binary_search(row).is_err()).collect();
        let predicted = checked(rungs.refitted(&kept, &region.rows), names.len(), region.rows.len() * m)?;
        let measured = rungs.measured(&region.rows);
        tried.push(predicted.iter().map(|rung| Tried::of(rung, &predicted[0], &measured)).collect());
        let distances: Vec<f64> = region
            .rows
            .iter()
            .map(|&row| nearest(&poses[row], poses, kept.iter().copied(), &spread))
            .collect();
        near.push(quantile(&distances, policy.far_quantile));
    }
    let own: Vec<f64> = (0..poses.len())
        .map(|row| nearest(&poses[row], poses, (0..poses.len()).filter(|&other| other != row), &spread))
        .collect();
    let ranges: Vec<(f64, f64)> = (0..spread.len())
        .map(|joint| {
            let values = || poses.iter().map(|pose| pose[joint]);
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
        })
        .collect();
    let squares: Vec<Vec<f64>> = (0..names.len())
        .map(|rung| tried.iter().map(|region| mean_square(&region[rung].errors) * m as f64).collect())
        .collect();
    let all = weights(&squares, m, &[], None);
    let mut stack = Stack {
        coverage: coverage(&tried, &squares, m),
        edge: quantile(&own, policy.outside_quantile),
        regions: found,
        sets: Vec::new(),
        poses: poses.to_vec(),
        names,
        squares,
        spread,
        ranges,
        all,
    };
    let median_near = quantile(&near, 0.5).max(f64::MIN_POSITIVE);
    for (end, range) in stack.ends(&rungs.limits(), policy) {
        let set = stack.set(rungs, (end, range), &tried, median_near, policy)?;
        stack.sets.push(set);
    }
    Ok(stack)
}

impl Tried {
    fn of(rung: &Predicted, alone: &Predicted, measured: &[f64]) -> Self {
        Self {
            errors: measured.iter().zip(&rung.mean).map(|(y, mean)| y - mean).collect(),
            departs: rung.mean.iter().zip(&alone.mean).map(|(a, b)| a - b).collect(),
            uncertainty: rung.uncertainty.clone(),
            noise: rung.noise.clone(),
        }
    }
}

impl Stack {
    /// The answer for one pose, from what each rung predicts there. It depends on no other pose.
    #[must_use]
    pub fn at(&self, pose: &[f64], rungs: &[Predicted]) -> Answer {
        let inside = nearest(pose, &self.poses, 0..self.poses.len(), &self.spread) <= self.edge;
        let full = rungs.len() - 1;
        if inside || self.sets.is_empty() {
            let mut weights = vec![0.0; rungs.len()];
            weights[full] = 1.0;
            return Answer { inside, weights, mean: rungs[full].mean.clone(), half_width: None };
        }
        let sets: Vec<&OutsideSet> = self.sets.iter().filter(|set| self.is_in(set, pose)).collect();
        // In a corner a rung acts only if it does at both ends; the declared chain always does.
        let acts = |rung: usize| sets.iter().all(|set| set.weights[rung] > 0.0);
        let left: Vec<f64> =
            (0..rungs.len()).map(|rung| if acts(rung) { self.all[rung] } else { 0.0 }).collect();
        let sum: f64 = left.iter().sum();
        let weights: Vec<f64> = left.iter().map(|weight| weight / sum).collect();
        let factor = sets.iter().map(|set| set.factor).fold(1.0, f64::max);
        let parts: Vec<Tried> =
            rungs.iter().map(|rung| Tried::of(rung, &rungs[0], &vec![0.0; rung.mean.len()])).collect();
        let (errors, variance) = mixture(&parts, &weights);
        Answer {
            inside,
            weights,
            mean: errors.iter().map(|error| -error).collect(),
            half_width: Some(variance.iter().map(|variance| factor * variance.sqrt()).collect()),
        }
    }

    /// Both ends of each joint, to its limit or half a range on, and the gaps.
    fn ends(&self, limits: &[Option<(f64, f64)>], policy: &Policy) -> Vec<End> {
        let mut ends = vec![(None, (0.0, 0.0))];
        for (joint, &(low, high)) in self.ranges.iter().enumerate() {
            let reach = policy.outside_range * (high - low);
            let (least, most) = limits.get(joint).copied().flatten().unwrap_or((low - reach, high + reach));
            if least < low {
                ends.push((Some((joint, Side::Low)), (least.max(low - reach), low)));
            }
            if most > high {
                ends.push((Some((joint, Side::High)), (high, most.min(high + reach))));
            }
        }
        ends
    }

    fn is_in(&self, set: &OutsideSet, pose: &[f64]) -> bool {
        let beyond = |joint: usize| pose[joint] < self.ranges[joint].0 || pose[joint] > self.ranges[joint].1;
        match set.end {
            Some((joint, Side::Low)) => pose[joint] < self.ranges[joint].0,
            Some((joint, Side::High)) => pose[joint] > self.ranges[joint].1,
            None => !(0..pose.len()).any(beyond),
        }
    }

    fn set(
        &self,
        rungs: &dyn Rungs,
        (end, range): End,
        tried: &[Vec<Tried>],
        near: f64,
        policy: &Policy,
    ) -> Result<OutsideSet, Error> {
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        let mut uniform =
            |(low, high): (f64, f64)| if high > low { random.random_range(low..high) } else { low };
        let poses: Vec<Vec<f64>> = (0..POSES)
            .map(|_| {
                let own = |(joint, &whole): (usize, &(f64, f64))| match end {
                    Some((moved, _)) if moved == joint => uniform(range),
                    _ => uniform(whole),
                };
                self.ranges.iter().enumerate().map(own).collect()
            })
            .collect();
        let distance = |pose: &Vec<f64>| nearest(pose, &self.poses, 0..self.poses.len(), &self.spread);
        let outside: Vec<Vec<f64>> = poses.into_iter().filter(|pose| distance(pose) > self.edge).collect();
        let values = outside.len() * rungs.components();
        let predicted = checked(rungs.predicted(&outside), self.names.len(), values)?;
        let distances: Vec<f64> = outside.iter().map(distance).collect();
        let far = (quantile(&distances, policy.far_quantile) / near).max(1.0);
        let root = |values: &[f64]| (mean_square(values) * rungs.components() as f64).sqrt();
        let mut struck = Vec::new();
        for rung in 1..self.names.len() {
            let departs: Vec<f64> =
                predicted[rung].mean.iter().zip(&predicted[0].mean).map(|(a, b)| a - b).collect();
            let most = tried.iter().map(|region| root(&region[rung].departs)).fold(0.0, f64::max);
            let (departs, tried) = (root(&departs), policy.veto * most * far);
            if departs > tried {
                struck.push(Struck { rung, departs, tried });
            }
        }
        let gone: Vec<usize> = struck.iter().map(|struck| struck.rung).collect();
        let m = rungs.components();
        let ratios: Vec<f64> =
            (0..tried.len()).map(|left| ratio(tried, &self.squares, m, &gone, left)).collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
        let quantile = StudentsT::new(0.0, 1.0, tried.len().max(1) as f64)
            .map_or(f64::INFINITY, |t| t.inverse_cdf(0.975));
        Ok(OutsideSet {
            end,
            range,
            weights: weights(&self.squares, m, &gone, None),
            struck,
            factor: quantile * mean.max(1.0).sqrt(),
        })
    }
}

/// Weights of the rungs: each region counts as one observation of m components. One region may be left aside.
fn weights(squares: &[Vec<f64>], m: usize, struck: &[usize], aside: Option<usize>) -> Vec<f64> {
    let log = |(rung, squares): (usize, &Vec<f64>)| {
        // Without a region left out nothing speaks for more than the declared chain.
        if struck.contains(&rung) || (squares.is_empty() && rung > 0) {
            return f64::NEG_INFINITY;
        }
        let kept = squares.iter().enumerate().filter(|(region, _)| Some(*region) != aside);
        kept.map(|(_, square)| -(m as f64) / 2.0 * square.max(f64::MIN_POSITIVE).ln()).sum()
    };
    let logs: Vec<f64> = squares.iter().enumerate().map(log).collect();
    let best = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = logs.iter().map(|log| (log - best).exp()).sum();
    logs.iter().map(|log| (log - best).exp() / sum).collect()
}

/// Error and variance of the mixture, value by value.
fn mixture(rungs: &[Tried], weights: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let values = rungs[0].errors.len();
    let over = |value: &dyn Fn(&Tried) -> f64| -> f64 {
        rungs
            .iter()
            .zip(weights)
            .filter(|(_, weight)| **weight > 0.0)
            .map(|(rung, weight)| weight * value(rung))
            .sum()
    };
    let errors: Vec<f64> = (0..values).map(|at| over(&|rung| rung.errors[at])).collect();
    let variance = (0..values)
        .map(|at| {
            over(&|rung| {
                rung.uncertainty[at].powi(2) + rung.noise[at].powi(2) + (rung.errors[at] - errors[at]).powi(2)
            })
        })
        .collect();
    (errors, variance)
}

/// Mean square of the errors on a region over the mixture's variance, with weights from the other regions.
fn ratio(tried: &[Vec<Tried>], squares: &[Vec<f64>], m: usize, struck: &[usize], left: usize) -> f64 {
    let (errors, variance) = mixture(&tried[left], &weights(squares, m, struck, Some(left)));
    let ratios =
        errors.iter().zip(&variance).map(|(error, variance)| error * error / variance.max(f64::MIN_POSITIVE));
    ratios.sum::<f64>() / errors.len().max(1) as f64
}

/// Part of the values of all regions within intervals whose width comes from the other regions.
fn coverage(tried: &[Vec<Tried>], squares: &[Vec<f64>], m: usize) -> f64 {
    let (mut within, mut count) = (0, 0);
    let ratios: Vec<f64> = (0..tried.len()).map(|left| ratio(tried, squares, m, &[], left)).collect();
    for left in 0..tried.len() {
        let others = (tried.len() - 1).max(1) as f64;
        let mean = (ratios.iter().sum::<f64>() - ratios[left]) / others;
        let quantile = StudentsT::new(0.0, 1.0, others).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975));
        let (errors, variance) = mixture(&tried[left], &weights(squares, m, &[], Some(left)));
        let half = |variance: f64| quantile * mean.max(1.0).sqrt() * variance.sqrt();
        within +=
            errors.iter().zip(&variance).filter(|(error, variance)| error.abs() <= half(**variance)).count();
        count += errors.len();
    }
    within as f64 / count.max(1) as f64
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64
}

fn checked(
    given: Result<Vec<Predicted>, String>,
    rungs: usize,
    values: usize,
) -> Result<Vec<Predicted>, Error> {
    let given = given.map_err(|reason| Error::Linearise { reason })?;
    if given.len() != rungs {
        return Err(Error::Length {
            what: "the rungs' predictions".into(),
            found: given.len(),
            wanted: rungs,
        });
    }
    for list in given.iter().flat_map(|rung| [&rung.mean, &rung.uncertainty, &rung.noise]) {
        if list.len() != values {
            return Err(Error::Length {
                what: "a rung's prediction".into(),
                found: list.len(),
                wanted: values,
            });
        }
        if let Some((at, &value)) = list.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(Error::NotFinite { what: "a rung's prediction".into(), at, value });
        }
    }
    Ok(given)
}
