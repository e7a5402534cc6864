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
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::sweep::Sweep;
use super::tail::Tails;

/// Groups beyond this number are flipped together with their neighbours in the data: still a valid flip, and as
/// good a sample of chance, at a cost that does not grow with the data.
const MOST_FLIPPED: usize = 400;

/// Random signs: one row a flip, one column a bucket of groups.
#[derive(Debug, Clone)]
pub struct Signs {
    signs: Mat<f64>,
    bucket_of_row: Vec<usize>,
}

impl Signs {
    /// Signs for the rows whose groups are given.
    #[must_use]
    pub fn new(group_of_row: &[usize], flips: usize, seed: u64) -> Self {
        let mut numbers = std::collections::BTreeMap::new();
        for &group in group_of_row {
            let next = numbers.len();
            numbers.entry(group).or_insert(next);
        }
        let groups = numbers.len();
        let buckets = groups.min(MOST_FLIPPED);
        let bucket_of_row = group_of_row
            .iter()
            .map(|group| numbers.get(group).map_or(0, |&number| number * buckets / groups))
            .collect();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut bits = 0_u64;
        let mut left = 0;
        let signs = Mat::from_fn(flips, buckets, |_, _| {
            if left == 0 {
                bits = random.next_u64();
                left = 64;
            }
            let sign = if bits & 1 == 0 { 1.0 } else { -1.0 };
            bits >>= 1;
            left -= 1;
            sign
        });
        Self { signs, bucket_of_row }
    }

    /// How many flips.
    #[must_use]
    pub fn flips(&self) -> usize {
        self.signs.nrows()
    }

    /// The bucket that each row is flipped with.
    #[must_use]
    pub fn bucket_of_row(&self) -> &[usize] {
        &self.bucket_of_row
    }

    /// Sums within buckets, then their signed sums: flips × columns.
    #[must_use]
    pub fn flip(&self, bucket_scores: MatRef<'_, f64>) -> Mat<f64> {
        let mut sums = Mat::zeros(self.signs.nrows(), bucket_scores.ncols());
        matmul(&mut sums, Accum::Replace, &self.signs, bucket_scores, 1.0, Par::Seq);
        sums
    }

    /// How many buckets.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.signs.ncols()
    }
}

/// One family of tests under sign flips: blocks of columns, tested for what they explain of a residual after the
/// columns that are swept.
pub struct Family<'a> {
    /// The rows, in columns as `sweep` numbers them; the last is the residual.
    pub rows: MatRef<'a, f64>,
    /// The Gram matrix of `rows` with the declared columns and the accepted effects swept.
    pub sweep: &'a Sweep,
    /// The swept columns.
    pub base: &'a [usize],
    /// The blocks under test.
    pub blocks: &'a [Vec<usize>],
    /// Tail tables for the blocks' ranks.
    pub tails: &'a Tails,
}

impl Family<'_> {
    /// What the regression on the swept columns leaves of the residual, row by row, scaled to undo what the fit
    /// took of each row's own noise (its leverage).
    #[must_use]
    pub fn left(&self) -> Vec<f64> {
        let last = self.rows.ncols() - 1;
        let mut left = self.rows.col(last).iter().copied().collect::<Vec<f64>>();
        let mut leverage = vec![0.0; left.len()];
        let p = self.base.len();
        let inverse = Mat::from_fn(p, p, |i, j| -self.sweep.entry(self.base[i], self.base[j]));
        let basis = Mat::from_fn(left.len(), p, |i, j| self.rows[(i, self.base[j])]);
        let spread = &basis * &inverse;
        for (j, &column) in self.base.iter().enumerate() {
            let coefficient = self.sweep.entry(column, last);
            let (b, s) = (basis.col_as_slice(j), spread.col_as_slice(j));
            for i in 0..left.len() {
                left[i] -= coefficient * b[i];
                leverage[i] += b[i] * s[i];
            }
        }
        // A row that the fit follows entirely has nothing left to flip.
        for (value, h) in left.iter_mut().zip(leverage) {
            *value /= (1.0 - h).max(1e-3).sqrt();
        }
        left
    }

    /// The smallest ln p over all blocks, for each flip.
    #[must_use]
    pub fn smallest(&self, signs: &Signs) -> Vec<f64> {
        let left = self.left();
        let total: f64 = left.iter().map(|e| e * e).sum();
        let scores = self.bucket_scores(&left, signs);
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
            let mut own = Mat::from_fn(signs.buckets(), block.len(), |g, c| scores[(g, block[c])]);
            let coefficients = Mat::from_fn(p, block.len(), |j, c| self.sweep.entry(self.base[j], block[c]));
            matmul(&mut own, Accum::Add, &base_scores, &coefficients, -1.0, Par::Seq);
            matmul(
                effective.subcols_mut(at, whitener.ncols()),
                Accum::Replace,
                &own,
                whitener,
                1.0,
                Par::Seq,
            );
            at += whitener.ncols();
        }

        let sums = signs.flip(effective.as_ref());
        let mut rss = vec![total; signs.flips()];
        for j in 0..p {
            rss.iter_mut().zip(sums.col_as_slice(j)).for_each(|(r, &s)| *r -= s * s);
        }
        let mut smallest = vec![0.0_f64; signs.flips()];
        let mut at = p;
        for &rank in &ranks {
            for (flip, best) in smallest.iter_mut().enumerate() {
                let gain: f64 = (at..at + rank).map(|j| sums[(flip, j)] * sums[(flip, j)]).sum();
                *best = best.min(self.tails.ln_p(rank, gain, rss[flip]));
            }
            at += rank;
        }
        smallest
    }

    /// Σ column × residual within each bucket.
    fn bucket_scores(&self, left: &[f64], signs: &Signs) -> Mat<f64> {
        let mut scores = Mat::zeros(signs.buckets(), self.rows.ncols());
        for j in 0..self.rows.ncols() {
            let column = scores.col_as_slice_mut(j);
            for ((&bucket, &e), &z) in signs.bucket_of_row().iter().zip(left).zip(self.rows.col(j).iter()) {
                column[bucket] += z * e;
            }
        }
        scores
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

/// Familywise p of a block whose own ln p is given: how often chance does as well, the data themselves counted.
#[must_use]
pub fn familywise(ln_p: f64, smallest: &[f64]) -> f64 {
    let as_good = smallest.iter().filter(|&&s| s <= ln_p).count();
    (1 + as_good) as f64 / (1 + smallest.len()) as f64
}
