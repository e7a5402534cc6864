//! Sums along the order, from which the evidence of any set of cuts follows without the rows.

use std::ops::Range;

use faer::Mat;
use statrs::function::gamma::ln_gamma;

use crate::algebra::{cholesky, dot, half_log_det, solve_lower, solve_upper};
use crate::policy::Policy;

/// Variances of a stretch's tilts over the noise that the first cuts try, and those that judge a set of cuts.
const FIRST: [f64; 4] = [1.0, 4.0, 16.0, 64.0];
const JUDGED: [f64; 3] = [2.0, 16.0, 64.0];
/// Nodes along the order that the first cuts may take, and places at which one more cut is tried.
const NODES: usize = 250;
const TRIED: usize = 66;
/// The rows at which stretches begin, without the first.
pub(crate) type Cuts = Vec<usize>;

/// Sums along the order from which every stretch's products follow.
pub(crate) struct Sums {
    pub rows: usize,
    /// Tilt columns with tilt columns: 3 sums (xx, xy, yy).
    pub tilts: Vec<[f64; 3]>,
    /// Tilt columns with the residual behind the declared errors.
    pub residual: Vec<[f64; 2]>,
    /// Tilt columns with orthonormal declared columns, two for each.
    pub declared: Vec<Vec<f64>>,
    /// Energy of the residual behind the declared errors.
    pub energy: f64,
    pub freedom: f64,
}

/// Log price of so many stretches of so many rows, nats.
pub(crate) fn price(rows: usize, stretches: usize, policy: &Policy) -> f64 {
    let (n, k) = (rows as f64, stretches as f64);
    let places = ln_gamma(n) - ln_gamma(k) - ln_gamma(n - k + 1.0);
    places - policy.cut_slack * (k - 1.0) + k.ln()
}

impl Sums {
    /// The best cuts with the declared errors held where they are, by dynamic programming over the order, and the
    /// variance of a stretch's tilts that suits them. None where there are too many.
    ///
    /// Source: Bellman (1961), On the approximation of curves by line segments using dynamic programming.
    pub fn first(&self, residual: &[[f64; 2]], variance: f64, policy: &Policy) -> Option<(f64, Cuts)> {
        let (step, shortest) = (self.rows.div_ceil(NODES), policy.rows_of_setup as usize);
        let mut nodes: Vec<usize> = (0..self.rows).step_by(step).collect();
        nodes.push(self.rows);
        let change = (self.rows as f64).ln();
        let mut best: Option<(f64, f64, Cuts)> = None;
        for ratio in FIRST {
            let mut reached = vec![(f64::NEG_INFINITY, 0); nodes.len()];
            reached[0].0 = change;
            for end in 1..nodes.len() {
                for start in 0..end {
                    if nodes[end] - nodes[start] < shortest || !reached[start].0.is_finite() {
                        continue;
                    }
                    let score = reached[start].0 - change
                        + self.stretch(residual, nodes[start]..nodes[end], ratio, variance);
                    if score > reached[end].0 {
                        reached[end] = (score, start);
                    }
                }
            }
            let score = reached[nodes.len() - 1].0;
            if score.is_finite() && best.as_ref().is_none_or(|(most, ..)| score > *most) {
                let (mut cuts, mut at) = (Vec::new(), nodes.len() - 1);
                while at > 0 {
                    at = reached[at].1;
                    if at > 0 {
                        cuts.push(nodes[at]);
                    }
                }
                cuts.reverse();
                best = Some((score, ratio, cuts));
            }
        }
        let (_, ratio, cuts) = best?;
        ((cuts.len() as f64) < policy.most_setups).then_some((ratio, cuts))
    }

    /// Log evidence of one stretch's tilts.
    fn stretch(&self, residual: &[[f64; 2]], rows: Range<usize>, ratio: f64, variance: f64) -> f64 {
        let product = |at: usize| self.tilts[rows.end][at] - self.tilts[rows.start][at];
        let along = |at: usize| residual[rows.end][at] - residual[rows.start][at];
        let (xx, xy, yy) = (product(0) + 1.0 / ratio, product(1), product(2) + 1.0 / ratio);
        let (x, y) = (along(0), along(1));
        let determinant = xx * yy - xy * xy;
        let explained = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant / variance;
        0.5 * (explained - determinant.ln() - 2.0 * ratio.ln())
    }

    /// Cuts with one more, one less or one moved, until nothing helps; the declared errors are marginal throughout.
    pub fn improved(&self, mut cuts: Cuts, policy: &Policy) -> Cuts {
        let mut score = self.score(&cuts, policy);
        // Each round gains; the bound is only for the time it takes.
        for _ in 0..2 * policy.most_setups as usize {
            let mut best = (score + policy.move_cut, None);
            for moved in self.moves(&cuts, policy) {
                let tried = self.score(&moved, policy);
                if tried > best.0 && (moved.len() as f64) < policy.most_setups {
                    best = (tried, Some(moved));
                }
            }
            let (Some(moved), reached) = (best.1, best.0) else { break };
            (cuts, score) = (moved, reached);
        }
        cuts
    }

    /// Cuts with one more, one less, or one moved by a few rows.
    fn moves(&self, cuts: &Cuts, policy: &Policy) -> Vec<Cuts> {
        let mut moves = Vec::new();
        let (step, shortest) = ((self.rows / TRIED).max(1), policy.rows_of_setup as usize);
        let ends: Vec<usize> = std::iter::once(0).chain(cuts.iter().copied()).chain([self.rows]).collect();
        for pair in ends.windows(2) {
            for cut in (pair[0] + shortest..(pair[1] + 1).saturating_sub(shortest)).step_by(step) {
                let mut more = cuts.clone();
                more.push(cut);
                more.sort_unstable();
                moves.push(more);
            }
        }
        for (index, &cut) in cuts.iter().enumerate() {
            let mut fewer = cuts.clone();
            fewer.remove(index);
            moves.push(fewer);
            for shift in [-2, -1, 1, 2] {
                let Some(to) =
                    cut.checked_add_signed(shift).filter(|&to| to > ends[index] && to < ends[index + 2])
                else {
                    continue;
                };
                let mut moved = cuts.clone();
                moved[index] = to;
                moves.push(moved);
            }
        }
        moves
    }

    /// The residual's sums and the variance once the declared errors are fitted beside the stretches' tilts.
    pub fn refitted(&self, cuts: &Cuts, ratio: f64) -> Option<(Vec<[f64; 2]>, f64)> {
        let set = self.set(cuts);
        let (factor, mut tilts) = set.solved(ratio)?;
        solve_upper(&factor, &mut tilts);
        let size = tilts.len();
        let shift: Vec<f64> = (0..set.beside.nrows())
            .map(|a| (0..size).map(|at| set.beside[(a, at)] * tilts[at]).sum())
            .collect();
        let moved = |row: usize, side: usize| {
            let own: f64 =
                shift.iter().enumerate().map(|(a, shift)| shift * self.declared[row][2 * a + side]).sum();
            self.residual[row][side] + own
        };
        let residual = (0..=self.rows).map(|row| [moved(row, 0), moved(row, 1)]).collect();
        let mut left = self.energy - 2.0 * dot(&set.along, &tilts);
        for i in 0..size {
            left += (0..size).map(|j| tilts[i] * set.reduced[(i, j)] * tilts[j]).sum::<f64>();
        }
        let variance = left / (self.freedom - size as f64).max(1.0);
        Some((residual, variance.min(self.energy / self.freedom).max(f64::MIN_POSITIVE)))
    }

    /// Products of the stretches' tilts behind the declared errors.
    fn set(&self, cuts: &Cuts) -> Set {
        let ends: Vec<usize> = std::iter::once(0).chain(cuts.iter().copied()).chain([self.rows]).collect();
        let size = 2 * (ends.len() - 1);
        let beside = Mat::from_fn(self.declared[0].len() / 2, size, |a, at| {
            let (which, side) = (at / 2, at % 2);
            self.declared[ends[which + 1]][2 * a + side] - self.declared[ends[which]][2 * a + side]
        });
        let absorbed = beside.transpose() * &beside;
        let reduced = Mat::from_fn(size, size, |i, j| {
            let own = if i / 2 == j / 2 {
                self.tilts[ends[i / 2 + 1]][i % 2 + j % 2] - self.tilts[ends[i / 2]][i % 2 + j % 2]
            } else {
                0.0
            };
            own - absorbed[(i, j)]
        });
        let along = (0..size)
            .map(|at| self.residual[ends[at / 2 + 1]][at % 2] - self.residual[ends[at / 2]][at % 2])
            .collect();
        Set { beside, reduced, along }
    }

    /// Log evidence of a set of cuts less its price, at the best of a few variances.
    pub fn score(&self, cuts: &Cuts, policy: &Policy) -> f64 {
        let set = self.set(cuts);
        let evidence = |ratio: f64| {
            let Some((factor, forward)) = set.solved(ratio) else { return f64::NEG_INFINITY };
            let rest = (self.energy - dot(&forward, &forward)).max(1e-9 * self.energy);
            -self.freedom / 2.0 * rest.ln() - half_log_det(&factor) - forward.len() as f64 / 2.0 * ratio.ln()
        };
        let best = JUDGED.map(evidence).into_iter().fold(f64::NEG_INFINITY, f64::max);
        best - price(self.rows, cuts.len() + 1, policy)
    }
}

/// Products of the tilts of all stretches of a set of cuts.
struct Set {
    /// With the orthonormal declared columns.
    beside: Mat<f64>,
    /// With each other, less what the declared errors absorb.
    reduced: Mat<f64>,
    /// With the residual.
    along: Vec<f64>,
}

impl Set {
    /// Cholesky factor at a variance of the tilts over the noise, and L⁻¹ times the products with the residual.
    fn solved(&self, ratio: f64) -> Option<(Mat<f64>, Vec<f64>)> {
        let size = self.along.len();
        let matrix =
            Mat::from_fn(size, size, |i, j| self.reduced[(i, j)] + if i == j { 1.0 / ratio } else { 0.0 });
        let factor = cholesky(&matrix)?;
        let mut forward = Mat::from_fn(size, 1, |row, _| self.along[row]);
        solve_lower(factor.as_ref(), forward.as_mut());
        Some((factor, (0..size).map(|row| forward[(row, 0)]).collect()))
    }
}
