//! Familywise p by min-P over sign flips.
//!
//! Under no effect, the residuals of independent groups are as likely as their negatives. Flipping the sign of
//! whole groups at random therefore shows how small the smallest p of all candidates gets by chance, with the
//! candidates' dependence, uneven noise and heavy tails as these data have them.
//!
//! Source: Hemerik, Goeman and Finos, "Robust testing in generalized linear models by sign flipping score
//! contributions", Journal of the Royal Statistical Society B 82 (2020); Westfall and Young, "Resampling-Based
//! Multiple Testing" (1993) for min-P.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use rayon::prelude::*;

use super::signs::Signs;
use super::standardised::{Standardised, is_needed};
use super::sweep::Sweep;
use super::tail::Tails;

/// One family of tests under sign flips: blocks of columns, tested for what they explain of a residual after the
/// columns that are swept.
pub struct Family<'a> {
    /// Columns as `sweep` numbers them; the last is the residual.
    pub columns: MatRef<'a, f64>,
    /// The rows of them that are tested.
    pub rows: &'a [usize],
    /// The Gram matrix of those rows with the declared columns and the accepted effects swept.
    pub sweep: &'a Sweep,
    /// The swept columns.
    pub base: &'a [usize],
    /// The blocks under test.
    pub blocks: &'a [Vec<usize>],
    /// Tail tables for the blocks' ranks.
    pub tails: &'a Tails,
}

impl Family<'_> {
    /// Some columns, over the rows that are tested.
    fn picked(&self, columns: &[usize]) -> Mat<f64> {
        Mat::from_fn(self.rows.len(), columns.len(), |i, j| self.columns[(self.rows[i], columns[j])])
    }

    /// What the regression on the swept columns leaves of the residual, row by row, and each row's leverage: the share of
    /// its own noise that the fit took.
    fn left(&self) -> (Vec<f64>, Vec<f64>) {
        let last = self.columns.ncols() - 1;
        let mut left: Vec<f64> = self.rows.iter().map(|&row| self.columns[(row, last)]).collect();
        let mut leverage = vec![0.0; left.len()];
        let p = self.base.len();
        let inverse = Mat::from_fn(p, p, |i, j| -self.sweep.entry(self.base[i], self.base[j]));
        let basis = self.picked(self.base);
        let spread = &basis * &inverse;
        for (j, &column) in self.base.iter().enumerate() {
            let coefficient = self.sweep.entry(column, last);
            let (b, s) = (basis.col_as_slice(j), spread.col_as_slice(j));
            for i in 0..left.len() {
                left[i] -= coefficient * b[i];
                leverage[i] += b[i] * s[i];
            }
        }
        (left, leverage)
    }

    /// The smallest ln p over all blocks, for each flip.
    #[must_use]
    pub fn smallest(&self, signs: &Signs) -> Vec<f64> {
        let (left, leverage) = self.left();
        if is_needed(signs.with_sign(), self.base.len()) {
            return self.smallest_standardised(signs, &signs.flipped_as_is(&left, &leverage));
        }
        let left = signs.flipped(&left, &leverage);
        let total: f64 = left.iter().map(|e| e * e).sum();
        let scores = signs.scores_at(self.columns, |at| self.rows[at], &left);
        let whiteners: Vec<Mat<f64>> = self.blocks.iter().map(|block| self.sweep.whitener(block)).collect();
        let ranks: Vec<usize> = whiteners.iter().map(Mat::ncols).collect();
        let p = self.base.len();
        let mut effective = Mat::zeros(signs.buckets(), p + ranks.iter().sum::<usize>());

        // The swept columns: whitened by the inverse of their Gram matrix, for the flipped residual's own fit.
        let inverse = Mat::from_fn(p, p, |i, j| -self.sweep.entry(self.base[i], self.base[j]));
        let root = lower_root(&inverse);
        let base_scores = Mat::from_fn(signs.buckets(), p, |g, j| scores[(g, self.base[j])]);
        matmul(effective.subcols_mut(0, p), Accum::Replace, &base_scores, &root, 1.0, Par::Seq);
        let mut at = p;
        for (block, whitener) in self.blocks.iter().zip(&whiteners) {
            let own = self.effective(&scores, &base_scores, block, whitener);
            effective.subcols_mut(at, own.ncols()).copy_from(&own);
            at += own.ncols();
        }

        let sums = signs.flip(effective.as_ref());
        let mut rss = vec![total; signs.flips()];
        for j in 0..p {
            rss.iter_mut().zip(sums.col_as_slice(j)).for_each(|(r, &s)| *r -= s * s);
        }
        let mut chance = Chance::new(signs.flips());
        let mut at = p;
        for &rank in &ranks {
            chance.add(sums.as_ref().subcols(at, rank));
            at += rank;
        }
        chance.smallest(&rss, self.tails)
    }

    /// The same, each flip at its own variance.
    fn smallest_standardised(&self, signs: &Signs, left: &[f64]) -> Vec<f64> {
        let p = self.base.len();
        let inverse = Mat::from_fn(p, p, |i, j| -self.sweep.entry(self.base[i], self.base[j]));
        let own = self.picked(self.base);
        let basis = &own * lower_root(&inverse);
        let flipped = Standardised::new(signs, basis.as_ref(), left);
        let chance = self.blocks.par_iter().map(|block| {
            let mut columns = self.picked(block);
            let coefficients = Mat::from_fn(p, block.len(), |j, c| self.sweep.entry(self.base[j], block[c]));
            matmul(&mut columns, Accum::Add, &own, &coefficients, -1.0, Par::Seq);
            let orthonormal = columns * self.sweep.whitener(block);
            let mut chance = Chance::new(signs.flips());
            chance.add_gains(orthonormal.ncols(), &flipped.gains(orthonormal.as_ref()));
            chance
        });
        let chance = chance.reduce(|| Chance::new(signs.flips()), Chance::merge);
        let total: f64 = left.iter().map(|e| e * e).sum();
        chance.smallest(&vec![total; signs.flips()], self.tails)
    }

    /// The scores of a block in each bucket, after the swept columns and orthonormal.
    fn effective(
        &self,
        scores: &Mat<f64>,
        base_scores: &Mat<f64>,
        block: &[usize],
        whitener: &Mat<f64>,
    ) -> Mat<f64> {
        let mut own = Mat::from_fn(scores.nrows(), block.len(), |g, c| scores[(g, block[c])]);
        let coefficients =
            Mat::from_fn(self.base.len(), block.len(), |j, c| self.sweep.entry(self.base[j], block[c]));
        matmul(&mut own, Accum::Add, base_scores, &coefficients, -1.0, Par::Seq);
        own * whitener
    }
}

/// What chance explains: for each rank, the largest sum of squares that any block of that rank takes up, flip by flip.
/// Within a rank p falls as that sum grows, so one look at the tail a rank and flip is enough.
pub(super) struct Chance {
    flips: usize,
    largest: Vec<Vec<f64>>,
}

impl Chance {
    pub(super) fn new(flips: usize) -> Self {
        Self { flips, largest: Vec::new() }
    }

    /// Takes in a block by its orthonormal scores under each flip, flips × rank.
    pub(super) fn add(&mut self, scores: MatRef<'_, f64>) {
        let mut gain = vec![0.0; self.flips];
        for column in scores.col_iter() {
            gain.iter_mut().zip(column.iter()).for_each(|(g, s)| *g += s * s);
        }
        self.add_gains(scores.ncols(), &gain);
    }

    /// Takes in a block of some rank by what it explains of each flip.
    pub(super) fn add_gains(&mut self, rank: usize, gain: &[f64]) {
        self.largest.resize_with(self.largest.len().max(rank + 1), Vec::new);
        let largest = &mut self.largest[rank];
        largest.resize(self.flips, 0.0);
        largest.iter_mut().zip(gain).for_each(|(l, g)| *l = l.max(*g));
    }

    /// The larger of two, flip by flip.
    pub(super) fn merge(mut self, other: Self) -> Self {
        self.largest.resize_with(self.largest.len().max(other.largest.len()), Vec::new);
        for (own, other) in self.largest.iter_mut().zip(other.largest) {
            own.resize(other.len().max(own.len()), 0.0);
            own.iter_mut().zip(other).for_each(|(l, o)| *l = l.max(o));
        }
        self
    }

    /// The smallest ln p of each flip, where the swept columns leave `rss` of it.
    pub(super) fn smallest(&self, rss: &[f64], tails: &Tails) -> Vec<f64> {
        let mut smallest = vec![0.0_f64; self.flips];
        for (rank, largest) in self.largest.iter().enumerate() {
            for ((best, gain), rss) in smallest.iter_mut().zip(largest).zip(rss) {
                *best = best.min(tails.ln_p(rank, *gain, *rss));
            }
        }
        smallest
    }
}

/// L with LLᵀ the matrix given (symmetric, positive).
fn lower_root(matrix: &Mat<f64>) -> Mat<f64> {
    matrix.llt(faer::Side::Lower).map_or_else(
        |_| {
            Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
                if i == j { matrix[(i, i)].max(0.0).sqrt() } else { 0.0 }
            })
        },
        |factor| factor.L().to_owned(),
    )
}

/// Rounding by which a flip that changes nothing may differ from the data, as a share of ln p.
const TIED: f64 = 1e-9;

/// Familywise p of a block whose own ln p is given: how often chance does as well, the data themselves counted. Of few groups many
/// flips leave the data as they are, and do exactly as well.
#[must_use]
pub fn familywise(ln_p: f64, smallest: &[f64]) -> f64 {
    let as_good = smallest.iter().filter(|&&s| s <= ln_p + TIED * ln_p.abs()).count();
    (1 + as_good) as f64 / (1 + smallest.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a flip that changes nothing comes to differs from the data's own by rounding alone, to either side.
    #[test]
    fn ties_count() {
        for rounded in [1.0, 1.0 + 1e-13, 1.0 - 1e-13] {
            assert!((familywise(-30.0, &[-30.0 * rounded; 9]) - 1.0).abs() < 1e-12);
        }
        assert!((familywise(-30.0, &[-29.9; 9]) - 0.1).abs() < 1e-12);
        assert!((familywise(0.0, &[0.0; 9]) - 1.0).abs() < 1e-12);
    }
}
