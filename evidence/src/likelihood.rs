//! The likelihood of an active set over a Gram matrix, the gain of one more family, and the posterior.

use std::sync::Arc;

use faer::Mat;
use rayon::prelude::*;

use crate::algebra::{
    cholesky, column, column_mut, dot, half_log_det, products, solve_lower, solve_upper, spectrum,
};
use crate::families::{Driver, Where};
use crate::gram::Gram;
use crate::policy::{Policy, SCALES};

/// The active families, in the order in which they came, each with its variance over the noise.
pub(crate) type Active = Vec<(usize, f64)>;

/// A family as the likelihood sees it: columns and their standard deviations at unit variance.
#[derive(Debug, Clone)]
pub(crate) struct Scaled {
    /// Numbers of the columns in [y J Z].
    pub columns: Vec<usize>,
    /// Standard deviation of each coefficient.
    pub deviations: Vec<f64>,
    /// Log price, nats.
    pub price: f64,
    /// Where it acts and what drives it.
    pub site: (Where, Driver),
    /// Whether it belongs to the noise.
    pub is_noise: bool,
}

/// A Gram matrix with the families over it.
#[derive(Clone)]
pub(crate) struct View<'a> {
    pub gram: Arc<Gram>,
    pub families: &'a [Scaled],
    pub policy: &'a Policy,
    /// Columns of the declared errors.
    pub declared: usize,
    /// Measured values less estimable combinations.
    pub freedom: f64,
    /// What heavy tails multiply variances by.
    pub inflation: f64,
}

/// A solved active set.
pub(crate) struct Solved {
    /// Numbers of the columns: declared errors, then each family's.
    pub columns: Vec<usize>,
    /// Standard deviation of each coefficient in units of the noise; one for declared errors.
    deviations: Vec<f64>,
    /// Cholesky factor of scaled products plus prior.
    factor: Mat<f64>,
    /// L⁻¹ X′y.
    forward: Vec<f64>,
    /// y′y − y′X K⁻¹ X′y.
    pub rest: f64,
    /// ½ log|K| − ½ Σ log D.
    half_log_det: f64,
}

impl Solved {
    fn mean(&self) -> Vec<f64> {
        let mut mean = self.forward.clone();
        solve_upper(&self.factor, &mut mean);
        mean.iter_mut().zip(&self.deviations).for_each(|(mean, deviation)| *mean *= deviation);
        mean
    }
}

/// Mean and covariance of all coefficients.
pub(crate) struct Posterior {
    /// Numbers of the columns in [y J Z].
    pub columns: Vec<usize>,
    /// Mean of each coefficient.
    pub mean: Vec<f64>,
    /// K⁻¹ in the coefficients' units.
    pub shape: Mat<f64>,
    /// Variance of the noise with the inflation of heavy tails: the factor of `shape`.
    pub variance: f64,
}

/// A family behind an active set.
struct Axes {
    /// Its energy along each axis.
    values: Vec<f64>,
    /// Square of the residual's product with each axis.
    squares: Vec<f64>,
    /// The largest energy; none where the active set absorbs the family.
    largest: Option<f64>,
    /// Its energy before anything is taken out.
    total: f64,
}

/// What a family gains beside an active set, and at which variance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gain {
    /// Gain of log evidence, nats. Minus infinity where the declared errors or the active families absorb it.
    pub nats: f64,
    /// Variance over the noise.
    pub variance: f64,
}

const ABSORBED: Gain = Gain { nats: f64::NEG_INFINITY, variance: 0.0 };

impl View<'_> {
    /// Solves an active set.
    pub fn solve(&self, active: &[(usize, f64)]) -> Option<Solved> {
        let mut columns: Vec<usize> = (1..=self.declared).collect();
        let mut deviations = vec![1.0; self.declared];
        for &(family, variance) in active {
            let family = &self.families[family];
            columns.extend(&family.columns);
            deviations.extend(family.deviations.iter().map(|deviation| deviation * variance.sqrt()));
        }
        let products = &self.gram.products;
        let count = columns.len();
        let mut scaled = Mat::zeros(count, count);
        for (at, (&own, deviation)) in columns.iter().zip(&deviations).enumerate() {
            let from = column(products, own);
            let into = &mut column_mut(&mut scaled, at)[at..];
            for ((into, &row), other) in into.iter_mut().zip(&columns[at..]).zip(&deviations[at..]) {
                *into = deviation * other * from[row];
            }
            into[0] += f64::from(at >= self.declared);
        }
        let factor = cholesky(&scaled)?;
        let with_residual = column(products, 0);
        let along: Vec<f64> =
            columns.iter().zip(&deviations).map(|(&own, deviation)| deviation * with_residual[own]).collect();
        let mut forward = Mat::from_fn(count, 1, |row, _| along[row]);
        solve_lower(factor.as_ref(), forward.as_mut());
        let forward = column(&forward, 0).to_vec();
        let total = with_residual[0];
        // Residuals of zero are rounding of the sum of squares.
        let rest = (total - dot(&forward, &forward)).max(1e-12 * total);
        let half_log_det = half_log_det(&factor);
        Some(Solved { columns, deviations, factor, forward, rest, half_log_det })
    }

    /// Log marginal likelihood of an active set, up to a constant of the problem.
    pub fn log_evidence(&self, active: &[(usize, f64)]) -> f64 {
        let Some(solved) = self.solve(active) else { return f64::NEG_INFINITY };
        -self.freedom / 2.0 * solved.rest.ln() - solved.half_log_det + self.gram.log_det
    }

    /// Sum of the prices of an active set.
    pub fn price(&self, active: &[(usize, f64)]) -> f64 {
        active.iter().map(|&(family, _)| self.families[family].price).sum()
    }

    /// What each of some families gains beside an active set; those active gain nothing.
    ///
    /// Under weights of t that an active set left, the gain is a lower bound: the weighted squares lie below the
    /// t-density and touch it there.
    pub fn scan(&self, active: &[(usize, f64)], wanted: &dyn Fn(usize) -> bool) -> Vec<Gain> {
        let mut gains = vec![ABSORBED; self.families.len()];
        let Some(solved) = self.solve(active) else { return gains };
        let projected = self.projected(&solved, 0..self.gram.products.ncols());
        let asked: Vec<usize> = (0..self.families.len())
            .filter(|&family| wanted(family) && active.iter().all(|&(other, _)| other != family))
            .collect();
        // Each family by itself: the answer does not hang on how many processors share them out.
        let found: Vec<(usize, Gain)> = asked
            .into_par_iter()
            .map(|family| {
                let columns = &self.families[family].columns;
                (family, self.gain(&solved, family, |at| column(&projected, columns[at])))
            })
            .collect();
        for (family, gain) in found {
            gains[family] = gain;
        }
        gains
    }

    /// L⁻¹ X′z of some columns z.
    fn projected(&self, solved: &Solved, of: impl ExactSizeIterator<Item = usize>) -> Mat<f64> {
        let mut projected = Mat::zeros(solved.columns.len(), of.len());
        for (at, own) in of.enumerate() {
            let from = column(&self.gram.products, own);
            let rows = column_mut(&mut projected, at).iter_mut().zip(&solved.columns);
            for ((into, &row), deviation) in rows.zip(&solved.deviations) {
                *into = deviation * from[row];
            }
        }
        solve_lower(solved.factor.as_ref(), projected.as_mut());
        projected
    }

    /// What one family gains beside an active set.
    pub fn one(&self, active: &[(usize, f64)], family: usize) -> Gain {
        let Some(solved) = self.solve(active) else { return ABSORBED };
        let columns = &self.families[family].columns;
        let projected = self.projected(&solved, columns.iter().copied());
        self.gain(&solved, family, |at| column(&projected, at))
    }

    /// What single columns gain beside an active set, from their products with [y J Z] and their energies.
    pub fn singles(&self, active: &[(usize, f64)], products: &Mat<f64>, energies: &[f64]) -> Vec<Gain> {
        let Some(solved) = self.solve(active) else { return vec![ABSORBED; energies.len()] };
        let mut projected = Mat::from_fn(solved.columns.len(), energies.len(), |row, at| {
            solved.deviations[row] * products[(solved.columns[row], at)]
        });
        solve_lower(solved.factor.as_ref(), projected.as_mut());
        let gain = |(at, &energy): (usize, &f64)| {
            let own = column(&projected, at);
            let left = energy - dot(own, own);
            if left <= self.policy.absorbed * energy || left.is_nan() {
                return ABSORBED;
            }
            let along = products[(0, at)] - dot(own, &solved.forward);
            best_variance(&[left], &[along * along], left, solved.rest, self.freedom)
        };
        energies.iter().enumerate().map(gain).collect()
    }

    /// Gain of a family from its columns projected by the active set (L⁻¹ X′z of each).
    fn gain<'b>(&self, solved: &Solved, family: usize, projected: impl Fn(usize) -> &'b [f64]) -> Gain {
        let axes = self.axes(solved, family, projected);
        match axes.largest {
            Some(largest) => best_variance(&axes.values, &axes.squares, largest, solved.rest, self.freedom),
            None => ABSORBED,
        }
    }

    /// What is left of a family behind an active set, in its own axes.
    fn axes<'b>(&self, solved: &Solved, family: usize, projected: impl Fn(usize) -> &'b [f64]) -> Axes {
        let Scaled { columns, deviations, .. } = &self.families[family];
        let products = &self.gram.products;
        let size = columns.len();
        let mut block = vec![0.0; size * size];
        let mut along = vec![0.0; size];
        let (mut energy, mut total): (f64, f64) = (0.0, 0.0);
        for i in 0..size {
            let (own, with) = (projected(i), column(products, columns[i]));
            along[i] = deviations[i] * (with[0] - dot(own, &solved.forward));
            let whole = with[columns[i]] * deviations[i] * deviations[i];
            (energy, total) = (energy.max(whole), total + whole);
            for j in 0..=i {
                let left = with[columns[j]] - dot(own, projected(j));
                let value = left * deviations[i] * deviations[j];
                (block[i * size + j], block[j * size + i]) = (value, value);
            }
        }
        let mut values = spectrum(&mut block, &mut along);
        let largest = values.iter().copied().fold(0.0, f64::max);
        for (value, along) in values.iter_mut().zip(&mut along) {
            *along = if *value > self.policy.rounding * energy { *along * *along } else { 0.0 };
            *value = value.max(0.0);
        }
        let largest = (largest > self.policy.absorbed * energy).then_some(largest);
        Axes { values, squares: along, largest, total }
    }

    /// Mean square of a family's effect at which its gain would be expected to reach so many nats beside an active
    /// set. None where the others absorb it.
    pub fn needed(&self, active: &[(usize, f64)], family: usize, nats: f64) -> Option<f64> {
        let solved = self.solve(active)?;
        let columns = &self.families[family].columns;
        let projected = self.projected(&solved, columns.iter().copied());
        let axes = self.axes(&solved, family, |at| column(&projected, at));
        let largest = axes.largest?;
        let expected = |variance: f64| {
            let signal: f64 = axes.values.iter().map(|value| variance * value).sum();
            let log_det: f64 = axes.values.iter().map(|value| (variance * value).ln_1p()).sum();
            self.freedom / 2.0 * (signal / self.freedom).ln_1p() - log_det / 2.0
        };
        let (from, to, step) = SCALES;
        let steps = ((to - from) / step).round() as usize;
        let variances = (0..=steps).map(|index| 10f64.powf(from + step * index as f64) / largest);
        let enough = variances.into_iter().find(|&variance| expected(variance) >= nats)?;
        Some(enough * axes.total / (self.freedom + self.declared as f64) * solved.rest / self.freedom)
    }

    /// Mean of all coefficients of an active set, with the numbers of their columns.
    pub fn mean(&self, active: &[(usize, f64)]) -> Option<(Vec<usize>, Vec<f64>)> {
        let solved = self.solve(active)?;
        let mean = solved.mean();
        Some((solved.columns, mean))
    }

    /// Mean and covariance of all coefficients of an active set.
    pub fn posterior(&self, active: &[(usize, f64)]) -> Option<Posterior> {
        let solved = self.solve(active)?;
        let count = solved.columns.len();
        let mean = solved.mean();
        let mut inverse = Mat::<f64>::identity(count, count);
        solve_lower(solved.factor.as_ref(), inverse.as_mut());
        let whole = products(&inverse);
        let shape =
            Mat::from_fn(count, count, |a, b| whole[(a, b)] * solved.deviations[a] * solved.deviations[b]);
        let variance = solved.rest / self.freedom * self.inflation;
        Some(Posterior { columns: solved.columns, mean, shape, variance })
    }
}

/// The variance on the grid at which a family gains most: coarse steps first, then the fine ones around the best.
fn best_variance(values: &[f64], squares: &[f64], largest: f64, rest: f64, freedom: f64) -> Gain {
    let at = |power: f64| {
        let variance = 10f64.powf(power) / largest;
        let (mut explained, mut log_det, mut product) = (0.0, 0.0, 1.0f64);
        for (value, square) in values.iter().zip(squares) {
            let grown = 1.0 + variance * value;
            explained += variance * square / grown;
            product *= grown;
            // The product of a few factors stays finite; its logarithm is taken before it does not.
            if product > 1e200 {
                log_det += product.ln();
                product = 1.0;
            }
        }
        log_det += product.ln();
        let left = (1.0 - explained / rest).max(1e-12);
        Gain { nats: -freedom / 2.0 * left.ln() - log_det / 2.0, variance }
    };
    let (from, to, step) = SCALES;
    let fine = ((to - from) / step).round() as usize;
    let coarse = 5;
    let power = |index: usize| from + step * index as f64;
    let mut best = (0, at(power(0)));
    let take = |index: usize, best: &mut (usize, Gain)| {
        let gain = at(power(index));
        if gain.nats > best.1.nats {
            *best = (index, gain);
        }
    };
    for index in (coarse..=fine).step_by(coarse) {
        take(index, &mut best);
    }
    let middle = best.0;
    for index in middle.saturating_sub(coarse - 1)..=(middle + coarse - 1).min(fine) {
        if index != middle {
            take(index, &mut best);
        }
    }
    best.1
}
