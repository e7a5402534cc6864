//! Joint readings that make an instrument show a wanted direction or point: Newton's steps on the exact form, row by row.
//!
//! The step is the shortest that the derivatives ask for, so that joints beyond what the target needs move least.

use std::f64::consts::TAU;

use model_core::budget::spread;
use model_core::{Chain, ObservableId, ObservableKind, Quantity, SymbolId, SymbolKind};
use nalgebra::{DMatrix, DVector};

use crate::errors_file::FoundOver;
use crate::evaluation::{Evaluator, Exactness, Quantity as Computed};
use crate::refusal::Refusal;

/// Steps of one row at most.
const STEPS: usize = 60;
/// Poses from which a row without readings may start.
const STARTS: usize = 512;
/// Steps of the derivatives, rad or m.
const SMALL: f64 = 1e-5;
/// What is left of a unit vector, or of a point in units of its distance, is rounding below this.
const ROUNDING: f64 = 4e-16;
/// Directions that the joints hardly move, against the one that they move most.
const WEAK: f64 = 1e-9;

/// Finds joint readings for one observable.
pub struct Solver {
    evaluator: Evaluator,
    kind: ObservableKind,
    /// The joints to set.
    pub joints: Vec<SymbolId>,
    /// Poses to start from, with what is shown there; empty where the rows bring their own.
    starts: Vec<Vec<f64>>,
    /// Readings that the table brings: inputs, and joints to start from.
    pub given: Vec<SymbolId>,
}

/// Joints of some rows, with what remains.
pub struct Solved {
    /// One column a joint, SI.
    pub joints: Vec<Vec<f64>>,
    /// Angle or distance between what is wanted and what these readings show, rad or m.
    pub remaining: Vec<f64>,
}

impl Solver {
    /// For an observable with these errors. `has_starts` says whether the table brings the joints to start from.
    ///
    /// # Errors
    /// No joint moves the observable, or one that is no angle has no range to start from.
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        values: &[f64],
        found: &[FoundOver],
        has_starts: bool,
    ) -> Result<Self, Refusal> {
        let evaluator = Evaluator::new(chain, vec![observable], Exactness::Exact, Computed::Value, values);
        let shown = chain.observable(observable);
        let of_kind = |kind: SymbolKind| -> Vec<SymbolId> {
            evaluator.readings.iter().copied().filter(|&id| chain.symbol(id).kind == kind).collect()
        };
        let joints = of_kind(SymbolKind::Joint);
        if joints.is_empty() {
            return Err(Refusal::Input(format!("no joint moves `{}`, so that none can be set", shown.name)));
        }
        let mut given = of_kind(SymbolKind::Input);
        let mut starts = Vec::new();
        if has_starts {
            given.extend(&joints);
        } else {
            let mut bounds = Vec::new();
            for &joint in &joints {
                let symbol = chain.symbol(joint);
                match found.iter().find(|found| found.symbol == joint) {
                    Some(found) => bounds.push((found.low, found.high)),
                    None if symbol.quantity == Quantity::Angle => bounds.push((0.0, TAU)),
                    None => {
                        let name = &symbol.name;
                        return Err(Refusal::Input(format!(
                            "nothing says where to look for `{name}`: give a column `{name}` to start from"
                        )));
                    }
                }
            }
            starts = spread(&bounds, STARTS).collect();
        }
        given.sort_unstable();
        Ok(Self { evaluator, kind: shown.kind, joints, starts, given })
    }

    /// Solves some rows.
    ///
    /// # Errors
    /// A reading is missing.
    pub fn solve(&mut self, given: &[(SymbolId, Vec<f64>)], wanted: &[[f64; 3]]) -> Result<Solved, Refusal> {
        let rows = wanted.len();
        let mut at: Vec<Vec<f64>> = if self.starts.is_empty() {
            let of = |joint: &SymbolId| {
                let Some((_, column)) = given.iter().find(|(id, _)| id == joint) else {
                    unreachable!("the table was asked for the joints to start from")
                };
                column.clone()
            };
            self.joints.iter().map(of).collect()
        } else {
            self.nearest(given, wanted)?
        };
        let mut shown = self.shown(given, &at, rows)?;
        let mut is_done = vec![false; rows];
        let mut damping = vec![0.0_f64; rows];
        for _ in 0..STEPS {
            if is_done.iter().all(|done| *done) {
                break;
            }
            let mut slopes = Vec::with_capacity(self.joints.len());
            for joint in 0..self.joints.len() {
                let mut moved = |by: f64| {
                    at[joint].iter_mut().for_each(|value| *value += by);
                    let shown = self.shown(given, &at, rows);
                    at[joint].iter_mut().for_each(|value| *value -= by);
                    shown
                };
                let (above, below) = (moved(SMALL)?, moved(-SMALL)?);
                slopes.push((above, below));
            }
            let mut next = at.clone();
            for row in (0..rows).filter(|&row| !is_done[row]) {
                let slope = DMatrix::from_fn(3, self.joints.len(), |axis, joint| {
                    (slopes[joint].0[row][axis] - slopes[joint].1[row][axis]) / (2.0 * SMALL)
                });
                let left = DVector::from_fn(3, |axis, _| wanted[row][axis] - shown[row][axis]);
                for (joint, step) in step(slope, &left, damping[row]).into_iter().enumerate() {
                    next[joint][row] += step;
                }
            }
            let there = self.shown(given, &next, rows)?;
            for row in 0..rows {
                if is_done[row] {
                    continue;
                }
                let [before, after] = [&shown, &there].map(|shown| distance(&wanted[row], &shown[row]));
                if after < before {
                    for (at, next) in at.iter_mut().zip(&next) {
                        at[row] = next[row];
                    }
                    shown[row] = there[row];
                    damping[row] = if damping[row] < 1e-6 { 0.0 } else { damping[row] / 10.0 };
                    let far = wanted[row].iter().map(|part| part * part).sum::<f64>().sqrt();
                    is_done[row] = after <= ROUNDING * far.max(1.0);
                } else {
                    // Nothing is gained any more, or the step was too long.
                    damping[row] = (10.0 * damping[row]).max(1e-4);
                    is_done[row] = damping[row] > 1e6 || !before.is_finite();
                }
            }
        }
        let remaining = (0..rows).map(|row| self.remaining(&wanted[row], &shown[row])).collect();
        Ok(Solved { joints: at, remaining })
    }

    /// What is shown, row by row; a direction of length one.
    fn shown(
        &mut self,
        given: &[(SymbolId, Vec<f64>)],
        joints: &[Vec<f64>],
        rows: usize,
    ) -> Result<Vec<[f64; 3]>, Refusal> {
        let inputs = given.iter().filter(|(id, _)| !self.joints.contains(id));
        let inputs = inputs.map(|(id, column)| (*id, column.as_slice()));
        let moved = self.joints.iter().copied().zip(joints.iter().map(Vec::as_slice));
        let readings: Vec<(SymbolId, &[f64])> = inputs.chain(moved).collect();
        let columns = self.evaluator.columns(&readings, rows)?;
        let row = |row: usize| {
            let vector = [0, 1, 2].map(|axis: usize| columns[axis][row]);
            match self.kind {
                ObservableKind::Point => vector,
                ObservableKind::Direction => {
                    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
                    vector.map(|part| part / length)
                }
            }
        };
        Ok((0..rows).map(row).collect())
    }

    /// For each row the pose that shows what is nearest to the wanted.
    fn nearest(
        &mut self,
        given: &[(SymbolId, Vec<f64>)],
        wanted: &[[f64; 3]],
    ) -> Result<Vec<Vec<f64>>, Refusal> {
        let rows = wanted.len();
        let mut best: Vec<(f64, usize)> = vec![(f64::INFINITY, 0); rows];
        for start in 0..self.starts.len() {
            let joints: Vec<Vec<f64>> = self.starts[start].iter().map(|&value| vec![value; rows]).collect();
            let shown = self.shown(given, &joints, rows)?;
            for row in 0..rows {
                let far = distance(&wanted[row], &shown[row]);
                if far < best[row].0 {
                    best[row] = (far, start);
                }
            }
        }
        let joint = |joint: usize| best.iter().map(|&(_, start)| self.starts[start][joint]).collect();
        Ok((0..self.joints.len()).map(joint).collect())
    }

    fn remaining(&self, wanted: &[f64; 3], shown: &[f64; 3]) -> f64 {
        let chord = distance(wanted, shown);
        match self.kind {
            ObservableKind::Point => chord,
            ObservableKind::Direction => 2.0 * (chord / 2.0).min(1.0).asin(),
        }
    }
}

/// The distance of two points, m.
pub(crate) fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The shortest step that takes away what is left, damped; zero where the derivatives are no numbers.
fn step(slope: DMatrix<f64>, left: &DVector<f64>, damping: f64) -> Vec<f64> {
    let joints = slope.ncols();
    if slope.iter().chain(left.iter()).any(|value| !value.is_finite()) {
        return vec![0.0; joints];
    }
    let parts = slope.svd(true, true);
    let (Some(u), Some(v)) = (&parts.u, &parts.v_t) else { unreachable!("both factors were asked for") };
    let most = parts.singular_values.max();
    let mut step = vec![0.0; joints];
    for (at, &length) in parts.singular_values.iter().enumerate().filter(|(_, length)| **length > WEAK * most)
    {
        let along = u.column(at).dot(left) * length / (length * length + damping * most * most);
        step.iter_mut().zip(v.row(at).iter()).for_each(|(step, part)| *step += along * part);
    }
    step
}
