//! A variance that depends on the joints: log-linear in cos q, sin q, cos 2q, sin 2q of each joint and in the
//! logarithm of measured ranges; of angles, of lengths and of what lies across a beam each its own.
//!
//! The functions are made anew block by block whenever they are asked for: of many rows they would need more memory than the rows.
//!
//! Ranges and joints have to earn their functions apart.
//!
//! Source: A. C. Harvey, Estimating Regression Models with Multiplicative Heteroscedasticity, Econometrica 44 (1976):
//! maximum likelihood by Fisher scoring.

use std::ops::Range;

use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, Par};
use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use rayon::prelude::*;

use super::{Layout, VarianceModel, VarianceTerm};
use crate::cluster::ALONE;
use crate::partial::{Partial, Rows};
use observe::waves::waves;
use observe::{NoiseOf, Observations};

/// Components per coefficient below which no variance model is looked for.
const COMPONENTS_PER_TERM: usize = 15;

/// So many components tell a standard deviation to an eighth.
const COMPONENTS_KNOWN: f64 = 30.0;

/// Rows whose functions are made at a time.
const BLOCK: usize = 4096;

/// What is left of a function by those before it, as a share of its length, below which it gets no coefficient.
const DEPENDENT: f64 = 1e-7;

/// The logarithm of a variance stays this near to that of the level: a factor of 1e9 is beyond any instrument, and this keeps
/// the exponential finite.
const REACH: f64 = 20.0;

/// The models that the data bear out, each with its factor on the standard deviation, per row. A residual has so much of its
/// noise `left`: one share for all, or each its own.
pub fn fit(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    scaled: &[f64],
    weight: &[f64],
    left: &[f64],
) -> Vec<(VarianceModel, Vec<f64>)> {
    let of_kinds = observations.noise_of_kinds();
    let mut all = of_kinds.clone();
    all.sort_unstable();
    all.dedup();
    let sources = sources(chain, observations);
    let own = |of: NoiseOf| {
        let own = |row: usize| {
            let components = if weight[row] > 0.0 { layout.of_rows(row..row + 1) } else { 0..0 };
            let kinds = &of_kinds[layout.kind(components.start)..];
            let own = components.zip(kinds).filter(move |(_, kind)| **kind == of);
            own.map(|(at, _)| (left[at % left.len()], scaled[at]))
        };
        of_components(of, &sources, layout.rows(), own)
    };
    all.into_iter().filter_map(own).collect()
}

/// The model of what a row has of its `own` and, per row, the factor on the standard deviation; `None` if the data do not bear one out.
fn of_components<I: Iterator<Item = (f64, f64)>>(
    of: NoiseOf,
    sources: &[Source<'_>],
    rows: usize,
    own: impl Fn(usize) -> I + Sync,
) -> Option<(VarianceModel, Vec<f64>)> {
    // Components of a row share its functions, so a row counts once, with how many it has and the sum of their squares.
    let add = |[count, sum]: [f64; 2], (left, value): (f64, f64)| [count + left, sum + value * value];
    let rows: Vec<[f64; 2]> = (0..rows).map(|row| own(row).fold([0.0; 2], add)).collect();
    let [count, squares] =
        rows.iter().fold([0.0; 2], |[count, sum], [own, square]| [count + own, sum + square]);
    if sources.is_empty() || count < COMPONENTS_PER_TERM as f64 || squares <= 0.0 {
        return None;
    }
    let level = (squares / count).ln();
    let model = Scoring { sources, rows: &rows, means: means(sources, rows.len()), level };
    // Heavy tails make variances look uneven: the likelihood ratio is scaled by what the fourth moment says.
    let excess = |coefficients: &[f64]| {
        let sum = model.sums(coefficients, 1, |block, fitted, sum| {
            for (row, fitted) in block.zip(fitted).filter(|&(row, _)| rows[row][0] > 0.0) {
                let variance = fitted.exp();
                let ratio =
                    |(left, value): (f64, f64)| (value * value / variance / left - 1.0).powi(2) * left;
                sum[0] += own(row).filter(|(left, _)| *left > ALONE).map(ratio).sum::<f64>();
            }
        })[0];
        (sum / count / 2.0).max(1.0)
    };
    let Chosen { sources: chosen, coefficients } = model.chosen(count, excess)?;
    let factor = |fitted: f64| ((fitted - coefficients[0]).clamp(-REACH, REACH) / 2.0).exp();
    let factors = parallel::each_of(blocks(rows.len()), |block| {
        let fitted = model.fitted(&model.functions(&block), &coefficients);
        fitted.into_iter().map(factor).collect::<Vec<f64>>()
    });
    let mut factors = factors.concat();
    if chosen.iter().any(|&number| matches!(sources[number], Source::Range(..))) {
        let least = surest(&factors, &rows);
        factors.iter_mut().for_each(|factor| *factor = factor.max(least));
    }
    let of_source = |number: usize| {
        sources[number].terms().into_iter().zip(coefficients[model.of_source(number)].iter().copied())
    };
    Some((VarianceModel { of, terms: chosen.into_iter().flat_map(of_source).collect() }, factors))
}

/// The factor that no row goes below where noise grows with a range: that of the surest rows together whose residuals tell what their noise is. What a model says of
/// the few rows beyond is extrapolated; a target half a metre away would decide, and its noise would be taken for next to nothing.
fn surest(factors: &[f64], rows: &[[f64; 2]]) -> f64 {
    let counted = factors.iter().zip(rows).filter(|(_, [count, _])| *count > 0.0);
    let mut counted: Vec<(f64, f64)> = counted.map(|(factor, [count, _])| (*factor, *count)).collect();
    counted.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut told = 0.0;
    let known = counted.iter().find(|(_, count)| {
        told += count;
        told >= COMPONENTS_KNOWN
    });
    known.or(counted.last()).map_or(0.0, |(factor, _)| *factor)
}

/// Readings with the functions that are made of them.
enum Source<'a> {
    /// Cosine and sine, of once and twice the angle.
    Angle(SymbolId, &'a [f64]),
    /// The logarithm.
    Range(SymbolId, &'a [f64]),
}

impl Source<'_> {
    fn terms(&self) -> Vec<VarianceTerm> {
        match *self {
            Self::Angle(id, _) => {
                (1..=2).flat_map(|of| [VarianceTerm::Cos(id, of), VarianceTerm::Sin(id, of)]).collect()
            }
            Self::Range(id, _) => vec![VarianceTerm::LogRange(id)],
        }
    }

    /// How many there are of them.
    fn count(&self) -> usize {
        self.terms().len()
    }

    /// The functions over some rows.
    fn functions(&self, rows: Range<usize>) -> Vec<Vec<f64>> {
        match self {
            Self::Angle(_, readings) => {
                let [sine, cosine] = waves(&readings[rows], 1.0);
                let both = || sine.iter().zip(&cosine);
                let (double_sine, double_cosine) =
                    (both().map(|(s, c)| 2.0 * s * c), both().map(|(s, c)| (c - s) * (c + s)));
                let double = [double_cosine.collect(), double_sine.collect()];
                [cosine, sine].into_iter().chain(double).collect()
            }
            Self::Range(_, readings) => vec![readings[rows].iter().map(|range| range.ln()).collect()],
        }
    }
}

fn sources<'a>(chain: &Chain, observations: &'a Observations) -> Vec<Source<'a>> {
    let of = |(id, values): &'a (SymbolId, Vec<f64>)| {
        let symbol = chain.symbol(*id);
        match (symbol.kind, symbol.quantity) {
            (SymbolKind::Joint, Quantity::Angle) => Some(Source::Angle(*id, values)),
            (SymbolKind::Input, Quantity::Length) if values.iter().all(|&range| range > 0.0) => {
                Some(Source::Range(*id, values))
            }
            _ => None,
        }
    };
    observations.poses.columns.iter().filter_map(of).collect()
}

/// All rows, block by block.
fn blocks(rows: usize) -> Vec<Range<usize>> {
    (0..rows).step_by(BLOCK).map(|start| start..(start + BLOCK).min(rows)).collect()
}

/// The mean of each function over all rows.
fn means(sources: &[Source<'_>], rows: usize) -> Vec<f64> {
    let of_block = |block: Range<usize>| -> Vec<f64> {
        let functions = sources.iter().flat_map(|source| source.functions(block.clone()));
        functions.map(|values| values.iter().sum()).collect()
    };
    let sums = added(parallel::each_of(blocks(rows), of_block));
    sums.into_iter().map(|sum| sum / rows as f64).collect()
}

/// Sums of blocks added up in their order, so that the number of processors changes no bit.
fn added(parts: Vec<Vec<f64>>) -> Vec<f64> {
    let add = |mut whole: Vec<f64>, part: Vec<f64>| {
        whole.iter_mut().zip(part).for_each(|(whole, part)| *whole += part);
        whole
    };
    parts.into_iter().reduce(add).unwrap_or_default()
}

/// The readings that a variance depends on, and the coefficients of all functions, zero for those of others.
struct Chosen {
    /// By their numbers, ranges first.
    sources: Vec<usize>,
    coefficients: Vec<f64>,
}

/// Fisher scoring of one set of residuals.
struct Scoring<'a> {
    sources: &'a [Source<'a>],
    /// Of each row how many components count, each by what it has left, and the sum of their squares.
    rows: &'a [[f64; 2]],
    means: Vec<f64>,
    /// The logarithm of the mean square.
    level: f64,
}

impl Scoring<'_> {
    /// The functions over a block of rows, each less its mean.
    fn functions(&self, block: &Range<usize>) -> Vec<Vec<f64>> {
        let functions = self.sources.iter().flat_map(|source| source.functions(block.clone()));
        let centred = functions.zip(&self.means).map(|(mut values, mean)| {
            values.iter_mut().for_each(|value| *value -= mean);
            values
        });
        centred.collect()
    }

    /// The logarithm of the variance that these coefficients give each row of a block.
    fn fitted(&self, functions: &[Vec<f64>], coefficients: &[f64]) -> Vec<f64> {
        let rows = functions.first().map_or(0, Vec::len);
        let mut fitted = vec![coefficients[0]; rows];
        for (values, coefficient) in functions.iter().zip(&coefficients[1..]) {
            fitted.iter_mut().zip(values).for_each(|(fitted, value)| *fitted += coefficient * value);
        }
        fitted.iter_mut().for_each(|value| *value = value.clamp(self.level - REACH, self.level + REACH));
        fitted
    }

    /// So many sums over all rows, of what is made of a block and its logarithms of the variance.
    fn sums(
        &self,
        coefficients: &[f64],
        count: usize,
        add: impl Fn(Range<usize>, Vec<f64>, &mut [f64]) + Sync,
    ) -> Vec<f64> {
        let of_block = |block: Range<usize>| {
            let fitted = self.fitted(&self.functions(&block), coefficients);
            let mut sums = vec![0.0; count];
            add(block, fitted, &mut sums);
            sums
        };
        added(parallel::each_of(blocks(self.rows.len()), of_block))
    }

    /// The readings that the data bear out: ranges, and then all joints if they gain enough beside them. A variance that grows with
    /// the range shall not take along whatever the joints do by chance, and few rows in which an effect is missing look as if theirs
    /// went by some joint. `None` if there are none.
    fn chosen(&self, count: f64, excess: impl Fn(&[f64]) -> f64) -> Option<Chosen> {
        let factor = self.factor();
        let mut chosen = Chosen { sources: Vec::new(), coefficients: Vec::new() };
        let mut gained = 0.0;
        for is_range in [true, false] {
            let is_own = |number: &usize| matches!(self.sources[*number], Source::Range(..)) == is_range;
            let own: Vec<usize> = (0..self.sources.len()).filter(is_own).collect();
            let terms: usize = own.iter().map(|&number| self.of_source(number).len()).sum();
            let sources = [chosen.sources.as_slice(), &own].concat();
            let columns = self.columns(&sources);
            if own.is_empty() || count < (COMPONENTS_PER_TERM * (columns.len() - 1)) as f64 {
                continue;
            }
            let coefficients = self.coefficients(&Independent::of(&factor, &columns));
            let gain = self.gain(&coefficients);
            // One term alone would be taken up by chance in one of forty residuals.
            if (gain - gained) / excess(&coefficients) >= terms.max(2) as f64 * count.ln() {
                (gained, chosen) = (gain, Chosen { sources, coefficients });
            }
        }
        (!chosen.sources.is_empty()).then_some(chosen)
    }

    /// Where the functions of a source stand among all, the constant first.
    fn of_source(&self, number: usize) -> Range<usize> {
        let before: usize = self.sources[..number].iter().map(Source::count).sum();
        1 + before..1 + before + self.sources[number].count()
    }

    /// The constant and the functions of some sources.
    fn columns(&self, sources: &[usize]) -> Vec<usize> {
        std::iter::once(0).chain(sources.iter().flat_map(|&number| self.of_source(number))).collect()
    }

    /// The constant and the coefficient of each function at the maximum of the likelihood; zero for functions that are none of these.
    fn coefficients(&self, independent: &Independent) -> Vec<f64> {
        let mut coefficients = vec![0.0; independent.width];
        coefficients[0] = self.level;
        for _ in 0..30 {
            let step = independent.solved(&self.score(&coefficients));
            coefficients.iter_mut().zip(&step).for_each(|(own, step)| *own += step);
            if step.iter().all(|step| step.abs() < 1e-6) {
                break;
            }
        }
        coefficients
    }

    /// The triangular factor of the constant and the functions, over all components that count.
    fn factor(&self) -> Mat<f64> {
        let width = 1 + self.means.len();
        let of_block = |block: Range<usize>| {
            let root: Vec<f64> = self.rows[block.clone()].iter().map(|[count, _]| count.sqrt()).collect();
            let functions = self.functions(&block);
            let mut rows = Rows::zeros(block.len(), width + 1);
            for (number, column) in rows.columns_mut().take(width).enumerate() {
                match number.checked_sub(1) {
                    None => column.copy_from_slice(&root),
                    Some(at) => (column.iter_mut().zip(&root).zip(&functions[at]))
                        .for_each(|((to, root), value)| *to = root * value),
                }
            }
            Partial::new(width).with(rows)
        };
        let parts = parallel::each_of(blocks(self.rows.len()), of_block);
        let whole = parts.into_iter().fold(Partial::new(width), |whole, part| {
            let Ok(merged) = whole.merge(&part) else { unreachable!("the parts have the same columns") };
            merged
        });
        whole.factor().submatrix(0, 0, width, width).to_owned()
    }

    /// The derivative of twice the log-likelihood by each coefficient.
    fn score(&self, coefficients: &[f64]) -> Vec<f64> {
        let of_block = |block: Range<usize>| {
            let functions = self.functions(&block);
            let fitted = self.fitted(&functions, coefficients);
            let excess = self.rows[block].iter().zip(fitted);
            let excess: Vec<f64> =
                excess.map(|([count, squares], fitted)| squares / fitted.exp() - count).collect();
            let product = |values: &Vec<f64>| values.iter().zip(&excess).map(|(a, b)| a * b).sum();
            std::iter::once(excess.iter().sum()).chain(functions.iter().map(product)).collect()
        };
        added(parallel::each_of(blocks(self.rows.len()), of_block))
    }

    /// Twice the log-likelihood that the functions gain over one variance for all.
    fn gain(&self, coefficients: &[f64]) -> f64 {
        let deviance = |log_variance: f64, [count, squares]: [f64; 2]| {
            count * log_variance + squares / log_variance.exp()
        };
        let gain = self.sums(coefficients, 1, |block, fitted, sum| {
            let each = self.rows[block].iter().zip(fitted);
            sum[0] = each.map(|(&row, fitted)| deviance(self.level, row) - deviance(fitted, row)).sum();
        });
        gain[0]
    }
}

/// Columns of which none depends on those before it, with their triangular factor.
struct Independent {
    columns: Vec<usize>,
    factor: Mat<f64>,
    /// Of all columns.
    width: usize,
}

impl Independent {
    /// Of some columns, in their order, of all with their triangular factor.
    fn of(all: &Mat<f64>, wanted: &[usize]) -> Self {
        let width = all.ncols();
        let triangle = |columns: &[usize]| {
            let count = columns.len();
            let own = Mat::from_fn(width, count + 1, |i, j| columns.get(j).map_or(0.0, |&j| all[(i, j)]));
            let factor = Partial::new(count).with_rows(own.as_ref()).factor();
            factor.submatrix(0, 0, count, count).to_owned()
        };
        let of_wanted = triangle(wanted);
        let is_own =
            |&(at, _): &(usize, &usize)| of_wanted[(at, at)].abs() > DEPENDENT * of_wanted.col(at).norm_l2();
        let columns: Vec<usize> =
            wanted.iter().enumerate().filter(is_own).map(|(_, &column)| column).collect();
        Self { factor: triangle(&columns), columns, width }
    }

    /// The solution of RᵀRx = b, zero for the other columns.
    fn solved(&self, b: &[f64]) -> Vec<f64> {
        let mut x = Mat::from_fn(self.columns.len(), 1, |i, _| b[self.columns[i]]);
        solve_lower_triangular_in_place(self.factor.transpose(), x.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(self.factor.as_ref(), x.as_mut(), Par::Seq);
        let mut all = vec![0.0; self.width];
        self.columns.iter().zip(x.col_as_slice(0)).for_each(|(&column, &x)| all[column] = x);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two components a row: the fifteen surest rows that count tell the least factor, and rows without components tell nothing.
    #[test]
    fn no_row_is_surer_than_those_that_tell_their_noise() {
        let mut factors: Vec<f64> = (1..=40).rev().map(f64::from).collect();
        let mut rows = vec![[2.0, 1.0]; 40];
        assert_eq!(surest(&factors, &rows), 15.0);
        factors.extend([1e-9; 100]);
        rows.extend([[0.0, 0.0]; 100]);
        assert_eq!(surest(&factors, &rows), 15.0);
        // Rows that are fitted as they are tell nothing of noise: the next in order do.
        rows[39] = [0.1, 0.0];
        assert_eq!(surest(&factors, &rows), 16.0);
        assert_eq!(surest(&factors[..5], &rows[..5]), 40.0);
    }

    #[test]
    fn columns_that_depend_on_others_get_nothing_and_the_rest_is_least_squares() {
        let mut rows = Mat::from_fn(40, 5, |i, j| ((i * (2 * j + 3)) as f64 * 0.7).sin());
        for i in 0..40 {
            rows[(i, 1)] = 0.0;
            rows[(i, 2)] = 3.0 * rows[(i, 0)];
        }
        let factor = Partial::new(4).with_rows(rows.as_ref()).factor();
        let independent = Independent::of(&factor.submatrix(0, 0, 4, 4).to_owned(), &[0, 1, 2, 3]);
        let products = rows.transpose() * &rows;
        let b: Vec<f64> = (0..4).map(|j| products[(j, 4)]).collect();
        let x = independent.solved(&b);
        assert_eq!((x[1], x[2]), (0.0, 0.0));
        for i in [0, 3] {
            let left = products[(i, 0)] * x[0] + products[(i, 3)] * x[3] - b[i];
            assert!(left.abs() < 1e-12 * products[(i, i)], "{left}");
        }
    }
}
