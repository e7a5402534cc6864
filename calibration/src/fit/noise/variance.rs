//! A variance that depends on the joints: log-linear in cos q, sin q, cos 2q, sin 2q of each joint and in the
//! logarithm of measured ranges.
//!
//! Source: A. C. Harvey, Estimating Regression Models with Multiplicative Heteroscedasticity, Econometrica 44 (1976):
//! maximum likelihood by Fisher scoring.

use model_core::{Chain, Quantity, SymbolKind};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{Layout, VarianceModel, VarianceTerm};
use crate::data::Observations;

/// Components per coefficient below which no variance model is looked for.
const COMPONENTS_PER_TERM: usize = 15;

/// Rows summed up at a time.
const CHUNK: usize = 4096;

/// A combination of functions counts as none where its sum of squares is this share of the largest's, each function scaled to
/// length one.
const NOTHING: f64 = 1e-13;

/// The model and, per row, the factor on the standard deviation; `None` if the data do not bear one out.
pub fn fit(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    scaled: &[f64],
    weight: &[f64],
) -> Option<(VarianceModel, Vec<f64>)> {
    let terms = terms(chain, observations);
    let kept: Vec<usize> = (0..layout.rows()).filter(|&row| weight[row] > 0.0).collect();
    let components = |row: usize| layout.first[row]..layout.first[row + 1];
    let count: usize = kept.iter().map(|&row| components(row).len()).sum();
    if terms.is_empty() || count < COMPONENTS_PER_TERM * terms.len() {
        return None;
    }
    let columns: Vec<Vec<f64>> = terms.par_iter().map(|term| column(*term, observations)).collect();
    let squares = |row: usize| scaled[components(row)].iter().map(|value| value * value).sum::<f64>();
    let level = kept.iter().map(|&row| squares(row)).sum::<f64>() / count as f64;
    if level <= 0.0 {
        return None;
    }
    let design = Design { columns: &columns, kept: &kept };
    let solver = Solver::of(&design.gram(|row| components(row).len() as f64));
    let mut coefficients = DVector::zeros(terms.len() + 1);
    coefficients[0] = level.ln();
    // A factor of 1e9 between variances is beyond any instrument, and keeps the exponential finite.
    let log_variance = |coefficients: &DVector<f64>, row: usize| {
        let fitted =
            columns.iter().zip(coefficients.iter().skip(1)).map(|(column, value)| column[row] * value);
        (coefficients[0] + fitted.sum::<f64>()).clamp(level.ln() - 20.0, level.ln() + 20.0)
    };
    for _ in 0..30 {
        let score = design.scored(|row| {
            squares(row) / log_variance(&coefficients, row).exp() - components(row).len() as f64
        });
        let step = solver.solve(&score);
        coefficients += &step;
        if step.amax() < 1e-6 {
            break;
        }
    }
    // By how much uneven noise is likelier than even noise, and how much more its squares vary than those of normal noise.
    let [gain, excess] = design.summed(|row| {
        let (fitted, own) = (log_variance(&coefficients, row), components(row));
        let variance = fitted.exp();
        let gain = own.len() as f64 * (level.ln() - fitted) + squares(row) * (1.0 / level - 1.0 / variance);
        let ratios = scaled[own].iter().map(|value| value * value / variance);
        [gain, ratios.map(|ratio| (ratio - 1.0).powi(2)).sum()]
    });
    // Heavy tails make variances look uneven: the likelihood ratio is scaled by what the fourth moment says.
    let excess = excess / count as f64 / 2.0;
    if gain / excess.max(1.0) < terms.len() as f64 * (count as f64).ln() {
        return None;
    }
    let factor = (0..observations.rows())
        .map(|row| {
            let log: f64 = (0..terms.len()).map(|term| coefficients[term + 1] * columns[term][row]).sum();
            (log.clamp(-20.0, 20.0) / 2.0).exp()
        })
        .collect();
    let terms = terms.into_iter().enumerate().map(|(at, term)| (term, coefficients[at + 1])).collect();
    Some((VarianceModel { terms }, factor))
}

/// A constant and the functions, at the rows that count.
struct Design<'a> {
    columns: &'a [Vec<f64>],
    kept: &'a [usize],
}

impl Design<'_> {
    fn width(&self) -> usize {
        self.columns.len() + 1
    }

    /// The constant and the functions at a row.
    fn at(&self, row: usize) -> impl Iterator<Item = f64> {
        std::iter::once(1.0).chain(self.columns.iter().map(move |column| column[row]))
    }

    /// Sums over rows, chunk by chunk and merged in order, so that the number of processors changes no bit.
    fn summed_up(&self, length: usize, add: impl Fn(&mut [f64], usize) + Sync) -> Vec<f64> {
        let chunks: Vec<Vec<f64>> = self
            .kept
            .par_chunks(CHUNK)
            .map(|rows| {
                let mut sums = vec![0.0; length];
                rows.iter().for_each(|&row| add(&mut sums, row));
                sums
            })
            .collect();
        chunks.into_iter().fold(vec![0.0; length], |mut whole, part| {
            whole.iter_mut().zip(part).for_each(|(whole, part)| *whole += part);
            whole
        })
    }

    /// Inner products, each row counted so many times.
    fn gram(&self, times: impl Fn(usize) -> f64 + Sync) -> DMatrix<f64> {
        let width = self.width();
        let sums = self.summed_up(width * width, |sums, row| {
            let times = times(row);
            for (line, own) in sums.chunks_exact_mut(width).zip(self.at(row)) {
                line.iter_mut().zip(self.at(row)).for_each(|(sum, other)| *sum += times * own * other);
            }
        });
        DMatrix::from_vec(width, width, sums)
    }

    /// Inner products with a column.
    fn scored(&self, column: impl Fn(usize) -> f64 + Sync) -> DVector<f64> {
        let sums = self.summed_up(self.width(), |sums, row| {
            let value = column(row);
            sums.iter_mut().zip(self.at(row)).for_each(|(sum, own)| *sum += value * own);
        });
        DVector::from_vec(sums)
    }

    fn summed<const N: usize>(&self, of: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
        let sums = self.summed_up(N, |sums, row| {
            sums.iter_mut().zip(of(row)).for_each(|(sum, value)| *sum += value);
        });
        std::array::from_fn(|at| sums[at])
    }
}

/// Solves normal equations; what the functions do not tell apart gets the smallest coefficients.
struct Solver {
    lengths: DVector<f64>,
    directions: DMatrix<f64>,
    squares: DVector<f64>,
}

impl Solver {
    fn of(gram: &DMatrix<f64>) -> Self {
        let lengths = gram.diagonal().map(|square| square.sqrt().max(f64::MIN_POSITIVE));
        let scaled =
            DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| gram[(i, j)] / lengths[i] / lengths[j]);
        let eigen = scaled.symmetric_eigen();
        Self { lengths, directions: eigen.eigenvectors, squares: eigen.eigenvalues }
    }

    fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        let mut along = self.directions.tr_mul(&right.component_div(&self.lengths));
        let least = NOTHING * self.squares.max();
        for (value, square) in along.iter_mut().zip(self.squares.iter()) {
            *value = if *square > least { *value / square } else { 0.0 };
        }
        (&self.directions * along).component_div(&self.lengths)
    }
}

fn terms(chain: &Chain, observations: &Observations) -> Vec<VarianceTerm> {
    let mut terms = Vec::new();
    for (id, values) in &observations.poses.columns {
        let symbol = chain.symbol(*id);
        match (symbol.kind, symbol.quantity) {
            (SymbolKind::Joint, Quantity::Angle) => {
                for multiple in 1..=2 {
                    terms.extend([VarianceTerm::Cos(*id, multiple), VarianceTerm::Sin(*id, multiple)]);
                }
            }
            (SymbolKind::Input, Quantity::Length) if values.iter().all(|&range| range > 0.0) => {
                terms.push(VarianceTerm::LogRange(*id));
            }
            _ => {}
        }
    }
    terms
}

/// The function at every row, less its mean.
fn column(term: VarianceTerm, observations: &Observations) -> Vec<f64> {
    let (id, function): (_, Box<dyn Fn(f64) -> f64>) = match term {
        VarianceTerm::Cos(id, multiple) => (id, Box::new(move |q: f64| (f64::from(multiple) * q).cos())),
        VarianceTerm::Sin(id, multiple) => (id, Box::new(move |q: f64| (f64::from(multiple) * q).sin())),
        VarianceTerm::LogRange(id) => (id, Box::new(f64::ln)),
    };
    let readings = observations
        .poses
        .column(id)
        .unwrap_or_else(|| unreachable!("a variance goes with what the observations have readings of"));
    let values: Vec<f64> = readings.iter().map(|&value| function(value)).collect();
    let mean = values.iter().sum::<f64>() / (values.len() as f64).max(1.0);
    values.into_iter().map(|value| value - mean).collect()
}
