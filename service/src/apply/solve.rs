//! Joint readings that make an instrument show a wanted direction, point or pose: Newton's steps on the exact form, row by row.
//!
//! The step is the shortest that the derivatives ask for, so that joints beyond what the target needs move least.

use std::f64::consts::TAU;

use model_core::budget::spread;
use model_core::{Chain, ObservableId, ObservableKind, Quantity, SymbolId, SymbolKind};
use nalgebra::{DMatrix, DVector};
use observe::orientation::{AXES, axes_of};
use rayon::prelude::*;

use crate::errors_file::FoundOver;
use crate::evaluation::{Evaluator, Exactness, Quantity as Computed};
use crate::ranges::Range;
use crate::refusal::Refusal;

use super::step::{apart, step, turn};

/// Steps of one row at most.
const STEPS: usize = 60;
/// Poses from which a row without readings may start.
const STARTS: usize = 512;
/// Starts that a pose is tried from, beside the reading that it should be near to.
const TRIES: usize = 4;
/// Steps of the derivatives, rad or m.
const SMALL: f64 = 1e-5;
/// What is left of a unit vector, or of a point in units of its distance, is rounding below this.
const ROUNDING: f64 = 4e-16;
/// Below this share of the best moved direction the worst moved one counts as lost: the joints are in a singular place.
const SINGULAR: f64 = 1e-4;
/// What remains of a target is rounding below this, in rad, or in m.
pub const REACHED: f64 = 1e-9;

/// What is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Goal {
    Direction,
    Point,
    /// A point, then the axes of the body that it is fixed to.
    Pose,
}

impl Goal {
    /// Numbers that say it.
    fn width(self) -> usize {
        if self == Self::Pose { 12 } else { 3 }
    }

    /// How many joints it takes.
    fn freedoms(self) -> usize {
        match self {
            Self::Direction => 2,
            Self::Point => 3,
            Self::Pose => 6,
        }
    }
}

/// Finds joint readings for one observable.
pub struct Solver {
    evaluator: Evaluator,
    goal: Goal,
    /// The joints to set.
    pub joints: Vec<SymbolId>,
    /// Between which values each is, SI.
    limits: Vec<(f64, f64)>,
    /// Poses to start from.
    starts: Vec<Vec<f64>>,
    /// Whether each row brings its own joints to start from.
    has_starts: bool,
    /// Readings that the table brings: inputs, and joints to start from.
    pub given: Vec<SymbolId>,
}

/// Joints of some rows, with what remains.
pub struct Solved {
    /// One column a joint, SI.
    pub joints: Vec<Vec<f64>>,
    /// Angle or distance between what is wanted and what these readings show, rad or m; of a pose the distance of its point.
    pub remaining: Vec<f64>,
    /// Of a pose the angle that its body would have to be turned further, rad; else empty.
    pub turn: Vec<f64>,
    /// Whether the joints are in a singular place, where some change of the target takes readings without bound.
    pub is_singular: Vec<bool>,
    /// Whether a joint is at a limit.
    pub is_at_limit: Vec<bool>,
}

impl Solved {
    /// Whether a row is reached.
    #[must_use]
    pub fn is_reached(&self, row: usize) -> bool {
        self.remaining[row] <= REACHED && self.turn.get(row).is_none_or(|turn| *turn <= REACHED)
    }
}

/// What the joints of an observable are looked for with.
#[derive(Clone, Copy)]
pub struct Search<'a> {
    /// The value of every symbol, SI.
    pub values: &'a [f64],
    /// The ranges that the model was found over.
    pub found: &'a [FoundOver],
    /// Limits of joints.
    pub limits: &'a [Range],
    /// Whether the table brings the joints to start from.
    pub has_starts: bool,
}

impl Solver {
    /// For the direction or point of an observable.
    ///
    /// # Errors
    /// No joint moves the observable, or one that is no angle has no range to start from.
    pub fn new(chain: &Chain, observable: ObservableId, search: Search<'_>) -> Result<Self, Refusal> {
        let shown = chain.observable(observable);
        if shown.is_image() {
            let name = &shown.name;
            return Err(Refusal::Input(format!(
                "`{name}` shows pixels, for which no readings are solved: name a direction or point"
            )));
        }
        let goal = match shown.kind {
            ObservableKind::Direction => Goal::Direction,
            ObservableKind::Point => Goal::Point,
        };
        let evaluator =
            Evaluator::new(chain, vec![observable], Exactness::Exact, Computed::Value, search.values);
        Self::of(chain, &shown.name, evaluator, goal, search)
    }

    /// For the pose of the body that an observable's point is fixed to.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn of_pose(chain: &Chain, point: ObservableId, search: Search<'_>) -> Result<Self, Refusal> {
        let (posed, observables) = with_axes(chain, point);
        let evaluator = Evaluator::new(&posed, observables, Exactness::Exact, Computed::Value, search.values);
        Self::of(chain, &chain.observable(point).name, evaluator, Goal::Pose, search)
    }

    fn of(
        chain: &Chain,
        name: &str,
        evaluator: Evaluator,
        goal: Goal,
        search: Search<'_>,
    ) -> Result<Self, Refusal> {
        let of_kind = |kind: SymbolKind| -> Vec<SymbolId> {
            evaluator.readings.iter().copied().filter(|&id| chain.symbol(id).kind == kind).collect()
        };
        let joints = of_kind(SymbolKind::Joint);
        if joints.is_empty() {
            return Err(Refusal::Input(format!("no joint moves `{name}`, so that none can be set")));
        }
        let mut given = of_kind(SymbolKind::Input);
        let limit = |joint: &SymbolId| search.limits.iter().find(|range| range.symbol == *joint);
        let limits: Vec<(f64, f64)> = joints
            .iter()
            .map(|joint| limit(joint).map_or((f64::NEG_INFINITY, f64::INFINITY), |own| (own.low, own.high)))
            .collect();
        if search.has_starts {
            given.extend(&joints);
        }
        let mut starts = Vec::new();
        if !search.has_starts || goal == Goal::Pose {
            let mut bounds = Vec::new();
            for &joint in &joints {
                let symbol = chain.symbol(joint);
                let found = search.found.iter().find(|found| found.symbol == joint);
                match (limit(&joint), found) {
                    (Some(own), _) => bounds.push((own.low, own.high)),
                    (None, Some(found)) => bounds.push((found.low, found.high)),
                    (None, None) if symbol.quantity == Quantity::Angle => bounds.push((0.0, TAU)),
                    (None, None) if search.has_starts => break,
                    (None, None) => {
                        let name = &symbol.name;
                        return Err(Refusal::Input(format!(
                            "nothing says where to look for `{name}`: give a column `{name}` to start from, or its limits with --range"
                        )));
                    }
                }
            }
            // A row whose own readings do not lead to its pose has no others where a joint has no range.
            if bounds.len() == joints.len() {
                if goal == Goal::Pose && !search.has_starts {
                    starts.push(bounds.iter().map(|(low, high)| (low + high) / 2.0).collect());
                }
                starts.extend(spread(&bounds, STARTS));
            }
        }
        given.sort_unstable();
        Ok(Self { evaluator, goal, joints, limits, starts, has_starts: search.has_starts, given })
    }

    /// Solves some rows; what is wanted stands row by row: a direction or point, or a point and three axes.
    ///
    /// # Errors
    /// A reading is missing.
    pub fn solve(&mut self, given: &[(SymbolId, Vec<f64>)], wanted: &[f64]) -> Result<Solved, Refusal> {
        let rows: Vec<usize> = (0..wanted.len() / self.goal.width()).collect();
        let start: Vec<Vec<f64>> = if self.has_starts {
            let of = |joint: &SymbolId| {
                let Some((_, column)) = given.iter().find(|(id, _)| id == joint) else {
                    unreachable!("the table was asked for the joints to start from")
                };
                column.clone()
            };
            self.joints.iter().map(of).collect()
        } else if self.goal == Goal::Pose {
            let middle = &self.starts[0];
            middle.iter().map(|&value| vec![value; rows.len()]).collect()
        } else {
            self.nearest(given, wanted, &rows, 0)?
        };
        let mut solved = self.from(given, wanted, &rows, start)?;
        if self.goal != Goal::Pose || self.starts.is_empty() {
            return Ok(solved);
        }
        // The reading that a pose should be near to may lead nowhere: at a singular place, or with another turn of the elbow.
        for nth in 0..TRIES {
            let missed: Vec<usize> = rows.iter().copied().filter(|&row| !solved.is_reached(row)).collect();
            if missed.is_empty() {
                break;
            }
            let start = self.nearest(given, wanted, &missed, nth)?;
            let again = self.from(given, wanted, &missed, start)?;
            for (at, &row) in missed.iter().enumerate() {
                let nearer = again.remaining[at] + again.turn[at] < solved.remaining[row] + solved.turn[row];
                if nearer || solved.remaining[row].is_nan() {
                    solved.take(row, &again, at);
                }
            }
        }
        Ok(solved)
    }

    /// Solves some of the rows, from so many joints.
    fn from(
        &self,
        given: &[(SymbolId, Vec<f64>)],
        wanted: &[f64],
        rows: &[usize],
        mut at: Vec<Vec<f64>>,
    ) -> Result<Solved, Refusal> {
        let width = self.goal.width();
        for (column, limits) in at.iter_mut().zip(&self.limits) {
            column.iter_mut().for_each(|value| *value = value.clamp(limits.0, limits.1));
        }
        let mut shown = self.shown(given, &at, rows)?;
        let target = |place: usize| &wanted[rows[place] * width..(rows[place] + 1) * width];
        let mut damping = vec![0.0_f64; rows.len()];
        let mut least = vec![1.0_f64; rows.len()];
        // The places of rows that are not done: only these are computed.
        let mut active: Vec<usize> = (0..rows.len()).collect();
        for _ in 0..STEPS {
            if active.is_empty() {
                break;
            }
            let own: Vec<usize> = active.iter().map(|&place| rows[place]).collect();
            let mut here: Vec<Vec<f64>> =
                at.iter().map(|column| active.iter().map(|&place| column[place]).collect()).collect();
            let mut slopes = Vec::with_capacity(self.joints.len());
            for joint in 0..self.joints.len() {
                let mut moved = |by: f64| {
                    here[joint].iter_mut().for_each(|value| *value += by);
                    let shown = self.shown(given, &here, &own);
                    here[joint].iter_mut().for_each(|value| *value -= by);
                    shown
                };
                slopes.push((moved(SMALL)?, moved(-SMALL)?));
            }
            let steps: Vec<(Vec<f64>, f64)> = active
                .par_iter()
                .enumerate()
                .map(|(number, &place)| {
                    let slope = DMatrix::from_fn(width, self.joints.len(), |axis, joint| {
                        let [above, below] =
                            [&slopes[joint].0, &slopes[joint].1].map(|own| own[number * width + axis]);
                        (above - below) / (2.0 * SMALL)
                    });
                    let shown = &shown[place * width..(place + 1) * width];
                    let left = DVector::from_fn(width, |axis, _| target(place)[axis] - shown[axis]);
                    let joints: Vec<f64> = here.iter().map(|column| column[number]).collect();
                    self.within(&joints, slope, &left, damping[place])
                })
                .collect();
            for (number, (step, share)) in steps.iter().enumerate() {
                least[active[number]] = *share;
                for ((column, step), limits) in here.iter_mut().zip(step).zip(&self.limits) {
                    column[number] = (column[number] + step).clamp(limits.0, limits.1);
                }
            }
            let there = self.shown(given, &here, &own)?;
            let mut going = Vec::with_capacity(active.len());
            for (number, &place) in active.iter().enumerate() {
                let now = place * width..(place + 1) * width;
                let next = &there[number * width..(number + 1) * width];
                let wanted = target(place);
                let [before, after] = [&shown[now.clone()], next].map(|shown| apart(wanted, shown));
                let is_done = if after < before {
                    at.iter_mut().zip(&here).for_each(|(at, here)| at[place] = here[number]);
                    shown[now].copy_from_slice(next);
                    damping[place] = if damping[place] < 1e-6 { 0.0 } else { damping[place] / 10.0 };
                    let far = wanted.iter().map(|part| part * part).sum::<f64>().sqrt();
                    after <= ROUNDING * far.max(1.0)
                } else {
                    // Nothing is gained any more, or the step was too long.
                    damping[place] = (10.0 * damping[place]).max(1e-4);
                    damping[place] > 1e6 || !before.is_finite()
                };
                if !is_done {
                    going.push(place);
                }
            }
            active = going;
        }
        let places: Vec<(&[f64], &[f64])> = (0..rows.len())
            .map(|place| (target(place), &shown[place * width..(place + 1) * width]))
            .collect();
        let is_at_limit = |place: usize| {
            let at = at.iter().map(|column| column[place]);
            at.zip(&self.limits).any(|(value, limits)| value <= limits.0 || value >= limits.1)
        };
        Ok(Solved {
            remaining: places.iter().map(|(wanted, shown)| self.remaining(wanted, shown)).collect(),
            turn: match self.goal {
                Goal::Pose => places.iter().map(|(wanted, shown)| turn(&wanted[3..], &shown[3..])).collect(),
                Goal::Direction | Goal::Point => Vec::new(),
            },
            is_singular: least.iter().map(|share| *share < SINGULAR).collect(),
            is_at_limit: (0..rows.len()).map(is_at_limit).collect(),
            joints: at,
        })
    }

    /// The step of one row, without the joints that it would carry beyond a limit that they are at; and how well the joints move the worst
    /// moved direction, against the best.
    fn within(
        &self,
        joints: &[f64],
        mut slope: DMatrix<f64>,
        left: &DVector<f64>,
        damping: f64,
    ) -> (Vec<f64>, f64) {
        let freedoms = self.goal.freedoms().min(joints.len());
        let (taken, share) = step(slope.clone(), left, damping, freedoms);
        let leaves = |at: usize, step: f64| {
            let (low, high) = self.limits[at];
            (joints[at] <= low && step < 0.0) || (joints[at] >= high && step > 0.0)
        };
        let stuck: Vec<usize> = (0..joints.len()).filter(|&at| leaves(at, taken[at])).collect();
        if stuck.is_empty() {
            return (taken, share);
        }
        stuck.iter().for_each(|&at| slope.column_mut(at).fill(0.0));
        (step(slope, left, damping, freedoms).0, share)
    }

    /// What is shown at some of the rows, one behind the other; a direction of length one.
    fn shown(
        &self,
        given: &[(SymbolId, Vec<f64>)],
        joints: &[Vec<f64>],
        rows: &[usize],
    ) -> Result<Vec<f64>, Refusal> {
        let inputs: Vec<(SymbolId, Vec<f64>)> = given
            .iter()
            .filter(|(id, _)| !self.joints.contains(id))
            .map(|(id, column)| (*id, rows.iter().map(|&row| column[row]).collect()))
            .collect();
        let inputs = inputs.iter().map(|(id, column)| (*id, column.as_slice()));
        let moved = self.joints.iter().copied().zip(joints.iter().map(Vec::as_slice));
        let readings: Vec<(SymbolId, &[f64])> = inputs.chain(moved).collect();
        let columns = self.evaluator.columns(&readings, rows.len())?;
        let mut all = Vec::with_capacity(rows.len() * self.goal.width());
        for row in 0..rows.len() {
            let start = all.len();
            all.extend(columns.iter().map(|column| column[row]));
            if self.goal == Goal::Direction {
                let length = all[start..].iter().map(|part| part * part).sum::<f64>().sqrt();
                all[start..].iter_mut().for_each(|part| *part /= length);
            }
        }
        Ok(all)
    }

    /// For some of the rows the pose that shows what is nearest to the wanted, or the nearest but so many.
    fn nearest(
        &self,
        given: &[(SymbolId, Vec<f64>)],
        wanted: &[f64],
        rows: &[usize],
        nth: usize,
    ) -> Result<Vec<Vec<f64>>, Refusal> {
        let width = self.goal.width();
        // The nearest so far, in order.
        let mut best: Vec<Vec<(f64, usize)>> = vec![vec![(f64::INFINITY, 0); nth + 1]; rows.len()];
        for (number, start) in self.starts.iter().enumerate() {
            let joints: Vec<Vec<f64>> = start.iter().map(|&value| vec![value; rows.len()]).collect();
            let shown = self.shown(given, &joints, rows)?;
            for (place, &row) in rows.iter().enumerate() {
                let far = apart(
                    &wanted[row * width..(row + 1) * width],
                    &shown[place * width..(place + 1) * width],
                );
                let own = &mut best[place];
                if far < own[nth].0 {
                    own[nth] = (far, number);
                    own.sort_by(|a, b| a.0.total_cmp(&b.0));
                }
            }
        }
        let joint = |joint: usize| best.iter().map(|own| self.starts[own[nth].1][joint]).collect();
        Ok((0..self.joints.len()).map(joint).collect())
    }

    fn remaining(&self, wanted: &[f64], shown: &[f64]) -> f64 {
        let chord = apart(&wanted[..3], &shown[..3]);
        match self.goal {
            Goal::Point | Goal::Pose => chord,
            Goal::Direction => 2.0 * (chord / 2.0).min(1.0).asin(),
        }
    }
}

impl Solved {
    /// Takes a row of another solution.
    fn take(&mut self, row: usize, other: &Self, at: usize) {
        self.joints.iter_mut().zip(&other.joints).for_each(|(own, other)| own[row] = other[at]);
        self.remaining[row] = other.remaining[at];
        self.turn[row] = other.turn[at];
        self.is_singular[row] = other.is_singular[at];
        self.is_at_limit[row] = other.is_at_limit[at];
    }
}

/// A chain that shows the axes of the body of an observable, then that observable's point; and these, the point first.
pub(crate) fn with_axes(chain: &Chain, point: ObservableId) -> (Chain, Vec<ObservableId>) {
    let mut posed = axes_of(chain, point);
    for axis in &mut posed.observables {
        axis.kind = ObservableKind::Direction;
    }
    posed.observables.push(chain.observable(point).clone());
    (posed, [ObservableId(3)].into_iter().chain(AXES).collect())
}
