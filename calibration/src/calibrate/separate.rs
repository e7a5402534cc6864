//! Poses that would tell an accepted effect from the others that explain these data as well: greedy T-optimal design.
//!
//! If the accepted effect is the true one, how much would each other one leave of it, everything declared refitted? The
//! poses are chosen one by one so that this difference grows for all of them.
//!
//! Source: A. C. Atkinson and V. V. Fedorov, "The design of experiments for discriminating between two rival models",
//! Biometrika 62 (1975).

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::round::Round;
use super::{Loop, declared};
use crate::columns::{Columns, places};
use crate::effects::Effect;
use crate::poses::{joints, spread};
use crate::report::{Separation, Told};

/// Poses that are proposed where the study does not say how many.
const POSES: usize = 12;

/// Others that poses are chosen for at most, the best explanations first.
const MOST: usize = 12;

/// Squared differences in σ² that even all poses together would not reach: those that cannot be told apart.
const NEVER: f64 = 4.0;

/// The accepted effect as another one sees it.
struct Other {
    effect: usize,
    /// Inverse of the normal matrix of what is refitted.
    spread: DMatrix<f64>,
    /// What is refitted, at its best against the accepted effect's prediction.
    fitted: DVector<f64>,
    /// Σ squared difference, σ².
    difference: f64,
    before: f64,
    /// The columns of what is refitted at each pose that could be measured.
    rows: Vec<DMatrix<f64>>,
}

/// Poses for the accepted effect number `at`, against the effects `others`.
pub(super) fn separation(
    whole: &Loop<'_>,
    last: &Round<'_>,
    at: usize,
    others: &[usize],
) -> Option<Separation> {
    let plan = whole.request.plan;
    let own = last.fitted.found.get(at)?.effect;
    let others: Vec<usize> = others
        .iter()
        .copied()
        .filter(|&other| !last.posed.rows.effects[other].is_empty())
        .take(MOST)
        .collect();
    if others.is_empty() {
        return None;
    }
    let ranges = plan.next.as_ref().map_or(&[][..], |next| &next.ranges);
    let count = plan.next.as_ref().map_or(POSES, |next| next.count);
    let poses = spread(&last.fitted.chain, whole.request.observations, ranges);

    // Everything at the poses that could be measured, in units of the noise.
    let kept: Vec<usize> = (0..last.fitted.found.len())
        .filter(|&other| other != at)
        .map(|i| last.fitted.found[i].effect)
        .collect();
    let involved: Vec<usize> = [own].into_iter().chain(kept).chain(others).collect();
    let effects: Vec<Effect> = involved.iter().map(|&effect| whole.catalogue[effect].clone()).collect();
    let values = &last.fitted.fit.values;
    let columns = Columns::at(&last.fitted.chain, &poses, declared(whole), values, &places(&effects)).ok()?;
    let there = columns.of_effects(&last.fitted.chain, &effects, &poses, values);
    let m = poses.series.first()?.measure.components();
    let sigma: Vec<f64> =
        last.fitted.fit.noise.floor.iter().take(m).map(|f| f.max(f64::MIN_POSITIVE)).collect();
    let combined = &columns.declared * &last.fitted.combinations;
    let amplitude: Vec<f64> = last.fitted.errors.get(at)?.iter().map(|id| values[id.index()]).collect();

    let nuisances = last.fitted.found.len() - 1;
    let known = &involved[1..=nuisances];
    let portion = &last.posed.rows;
    // A row of a sample stands for as many as there are for each.
    let weight = last.posed.share().sqrt();
    let whiten = |column: &[f64]| -> Vec<f64> {
        portion.whiten(column).into_iter().map(|value| weight * value).collect()
    };
    let declared_here =
        (0..portion.columns.declared.ncols()).map(|j| portion.columns.declared.col_as_slice(j));
    let known_here = known.iter().flat_map(|&effect| &portion.effects[effect]).map(Vec::as_slice);
    let here: Vec<Vec<f64>> = declared_here.chain(known_here).map(whiten).collect();
    let prediction = |columns: &[Vec<f64>]| -> Vec<f64> {
        let n = columns.first().map_or(0, Vec::len);
        (0..n).map(|i| columns.iter().zip(&amplitude).map(|(column, a)| a * column[i]).sum()).collect()
    };
    let measured = whiten(&prediction(&portion.effects[own]));
    let target = prediction(&there[0]);
    if target.is_empty() {
        return None;
    }
    let target: Vec<DVector<f64>> =
        (0..poses.rows()).map(|row| DVector::from_fn(m, |c, _| target[row * m + c] / sigma[c])).collect();
    let (mut apart, mut never) = (Vec::new(), Vec::new());
    for (number, &effect) in involved.iter().enumerate().skip(1 + nuisances) {
        let mut mine = here.clone();
        mine.extend(portion.effects[effect].iter().map(|column| whiten(column)));
        let refitted: Vec<&[f64]> = (0..combined.ncols())
            .map(|j| combined.col_as_slice(j))
            .chain(there[1..=nuisances].iter().flatten().map(Vec::as_slice))
            .chain(there[number].iter().map(Vec::as_slice))
            .collect();
        if refitted.len() != mine.len() {
            continue;
        }
        let rows = (0..poses.rows())
            .map(|row| DMatrix::from_fn(m, refitted.len(), |c, j| refitted[j][row * m + c] / sigma[c]))
            .collect();
        let Some(other) = Other::new(effect, &mine, &measured, rows) else { continue };
        let all =
            target.iter().enumerate().fold(other.clone_state(), |state, (row, t)| other.with(state, row, t));
        if all.2 - other.before < NEVER { never.push(other) } else { apart.push(other) }
    }
    let mut chosen = Vec::new();
    while chosen.len() < count && !apart.is_empty() {
        let Some(best) = best(&apart, &target) else { break };
        for other in &mut apart {
            let (spread, fitted, difference) = other.with(other.clone_state(), best, &target[best]);
            (other.spread, other.fitted, other.difference) = (spread, fitted, difference);
        }
        chosen.push(best);
    }
    let name = |effect: usize| whole.catalogue[effect].name.clone();
    let joints = joints(&last.fitted.chain, &poses);
    let readings: Vec<&[f64]> = joints.iter().filter_map(|id| poses.column(*id)).collect();
    Some(Separation {
        effect: name(own),
        poses: chosen.iter().map(|&row| readings.iter().map(|column| column[row]).collect()).collect(),
        joints: joints.iter().map(|id| last.fitted.chain.symbol(*id).name.clone()).collect(),
        apart: apart
            .iter()
            .map(|other| Told { name: name(other.effect), now: other.before, then: other.difference })
            .collect(),
        never: never.iter().map(|other| name(other.effect)).collect(),
    })
}

/// The pose by which the differences grow most, the smallest counting most: −ln Σ exp(−difference/2), which is the log
/// of the odds against all others together.
fn best(others: &[Other], target: &[DVector<f64>]) -> Option<usize> {
    let odds = |row: usize| {
        let after: Vec<f64> = others.iter().map(|o| o.difference + o.gain(row, &target[row])).collect();
        let least = after.iter().copied().fold(f64::INFINITY, f64::min);
        least / 2.0 - after.iter().map(|d| ((least - d) / 2.0).exp()).sum::<f64>().ln()
    };
    let all: Vec<f64> = (0..target.len()).into_par_iter().map(odds).collect();
    all.iter()
        .enumerate()
        .filter(|(_, o)| o.is_finite())
        .max_by(|a, b| a.1.total_cmp(b.1))
        .map(|(row, _)| row)
}

/// Inverse of the normal matrix, coefficients, squared difference.
type State = (DMatrix<f64>, DVector<f64>, f64);

impl Other {
    /// Regresses the prediction on columns, both whitened.
    fn new(
        effect: usize,
        columns: &[Vec<f64>],
        prediction: &[f64],
        mut rows: Vec<DMatrix<f64>>,
    ) -> Option<Self> {
        let n = prediction.len();
        let lengths: Vec<f64> = columns
            .iter()
            .map(|column| column.iter().map(|v| v * v).sum::<f64>().sqrt())
            .map(|length| if length > 0.0 { length } else { 1.0 })
            .collect();
        let design = Mat::from_fn(n, columns.len(), |i, j| columns[j][i] / lengths[j]);
        let target = Mat::from_fn(n, 1, |i, _| prediction[i]);
        let (normal, right) = (design.transpose() * &design, design.transpose() * &target);
        let k = columns.len();
        // What nothing determines so far counts as just about unknown.
        let normal = DMatrix::from_fn(k, k, |i, j| normal[(i, j)] + if i == j { 1e-9 } else { 0.0 });
        let spread = normal.cholesky()?.inverse();
        let fitted = &spread * DVector::from_fn(k, |j, _| right[(j, 0)]);
        let left = |i: usize| prediction[i] - (0..k).map(|j| design[(i, j)] * fitted[j]).sum::<f64>();
        let difference = (0..n).map(|i| left(i).powi(2)).sum();
        for row in &mut rows {
            for (j, length) in lengths.iter().enumerate() {
                row.column_mut(j).scale_mut(1.0 / length);
            }
        }
        Some(Self { effect, spread, fitted, difference, before: difference, rows })
    }

    fn clone_state(&self) -> State {
        (self.spread.clone(), self.fitted.clone(), self.difference)
    }

    /// By how much a pose would raise the difference.
    fn gain(&self, row: usize, target: &DVector<f64>) -> f64 {
        let x = &self.rows[row];
        let left = target - x * &self.fitted;
        let own = DMatrix::identity(x.nrows(), x.nrows()) + x * &self.spread * x.transpose();
        own.cholesky().map_or(0.0, |factor| left.dot(&factor.solve(&left)))
    }

    /// A state with a pose measured as well.
    fn with(&self, (spread, fitted, difference): State, row: usize, target: &DVector<f64>) -> State {
        let x = &self.rows[row];
        let left = target - x * &fitted;
        let across = x * &spread;
        let own = DMatrix::identity(x.nrows(), x.nrows()) + &across * x.transpose();
        let Some(factor) = own.cholesky() else { return (spread, fitted, difference) };
        let solved = factor.solve(&left);
        let difference = difference + left.dot(&solved);
        let fitted = fitted + across.transpose() * solved;
        let spread = spread - across.transpose() * factor.solve(&across);
        (spread, fitted, difference)
    }
}
