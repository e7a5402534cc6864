//! Random signs for the rows, drawn group by group; what is stated by itself is turned into any direction instead.
//!
//! A handful of stated numbers has only a handful of signs, and none of those would be rare. But whoever states an uncertainty of each
//! says that they scatter alike in all directions, be they all too small by a factor: so chance draws one.
//!
//! Source: O. Langsrud, Rotation tests, Statistics and Computing 15 (2005).

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::folds::number;
use observe::golden;

/// Groups beyond this number are flipped together with their neighbours in the data: still a valid flip, and as
/// good a sample of chance, at a cost that does not grow with the data.
const MOST_FLIPPED: usize = 400;

/// A leverage from which on a row has nothing left to flip.
const FOLLOWED: f64 = 1.0 - 1e-3;

/// Random signs: one row a flip, one column a bucket of groups.
#[derive(Debug, Clone)]
pub struct Signs {
    signs: Mat<f64>,
    bucket_of_row: Vec<usize>,
    /// The last rows, each a bucket of its own, that state something by themselves: of a direction of mean square one their components.
    stated: usize,
}

impl Signs {
    /// Signs for the rows whose groups are given, of which so many, the last, state something by themselves. Where there are many groups,
    /// neighbours flip together: whatever correlation is left between them then counts as chance.
    #[must_use]
    pub fn new(group_of_row: &[u32], stated: usize, flips: usize, seed: u64) -> Self {
        Self::dealt(group_of_row, stated, flips, seed, |number, groups, buckets| number * buckets / groups)
    }

    /// The same, but groups that flip together lie apart: correlation between neighbours is what is looked for.
    #[must_use]
    pub fn scattered(group_of_row: &[u32], flips: usize, seed: u64) -> Self {
        // Steps by the golden section come back to a bucket after as many steps as there are, in no simple pattern.
        Self::dealt(group_of_row, 0, flips, seed, |number, groups, buckets| match groups > buckets {
            true => (golden::share(number) * buckets as f64) as usize % buckets,
            false => number,
        })
    }

    fn dealt(
        group_of_row: &[u32],
        stated: usize,
        flips: usize,
        seed: u64,
        bucket: impl Fn(usize, usize, usize) -> usize,
    ) -> Self {
        let (numbers, groups) = number(&group_of_row[..group_of_row.len() - stated]);
        let buckets = groups.min(MOST_FLIPPED);
        let of_numbers = numbers.into_iter().map(|number| bucket(number as usize, groups, buckets));
        let bucket_of_row = of_numbers.chain((buckets..).take(stated)).collect();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut bits = 0_u64;
        let mut left = 0;
        let mut signs = Mat::from_fn(flips, buckets, |_, _| {
            if left == 0 {
                bits = random.next_u64();
                left = 64;
            }
            let sign = if bits & 1 == 0 { 1.0 } else { -1.0 };
            bits >>= 1;
            left -= 1;
            sign
        });
        signs.resize_with(flips, buckets + stated, |_, _| 0.0);
        for flip in 0..flips {
            let direction: Vec<f64> = (0..stated).map(|_| StandardNormal.sample(&mut random)).collect();
            let length = direction.iter().map(|value: &f64| value * value).sum::<f64>().sqrt();
            for (at, value) in direction.into_iter().enumerate() {
                signs[(flip, buckets + at)] = value / length * (stated as f64).sqrt();
            }
        }
        Self { signs, bucket_of_row, stated }
    }

    /// What is flipped of what a fit leaves of each row, of which the fit took a share of its own noise: the row's leverage. What is
    /// stated has one size in all its rows, whichever direction it is in.
    #[must_use]
    pub fn flipped(&self, left: &[f64], leverage: &[f64]) -> Vec<f64> {
        let undone = left.iter().zip(leverage).map(|(left, h)| left / (1.0 - h.min(FOLLOWED)).sqrt());
        self.with_stated_alike(undone.collect(), left, leverage)
    }

    /// What is flipped where each flip has its own variance.
    #[must_use]
    pub fn flipped_as_is(&self, left: &[f64], leverage: &[f64]) -> Vec<f64> {
        self.with_stated_alike(left.to_vec(), left, leverage)
    }

    fn with_stated_alike(&self, mut flipped: Vec<f64>, left: &[f64], leverage: &[f64]) -> Vec<f64> {
        let first = flipped.len() - self.stated;
        let squares: f64 = left[first..].iter().map(|value| value * value).sum();
        let free: f64 = leverage[first..].iter().map(|h| (1.0 - h).max(0.0)).sum();
        let size = if free > 0.0 { (squares / free).sqrt() } else { 0.0 };
        flipped[first..].fill(size);
        flipped
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

    /// Σ column × residual within each bucket, buckets × columns.
    #[must_use]
    pub fn scores(&self, columns: MatRef<'_, f64>, residual: &[f64]) -> Mat<f64> {
        self.scores_at(columns, |at| at, residual)
    }

    /// The same where the rows that have signs are some of the columns'; `row` gives the place of each there.
    pub(super) fn scores_at(
        &self,
        columns: MatRef<'_, f64>,
        row: impl Fn(usize) -> usize,
        residual: &[f64],
    ) -> Mat<f64> {
        let mut scores = Mat::zeros(self.buckets(), columns.ncols());
        // Rows of one bucket that follow each other are added up without going through memory.
        let mut start = 0;
        let runs: Vec<(usize, Range<usize>)> = self
            .bucket_of_row
            .chunk_by(|a, b| a == b)
            .map(|run| {
                start += run.len();
                (run[0], start - run.len()..start)
            })
            .collect();
        for (j, column) in columns.col_iter().enumerate() {
            let target = scores.col_as_slice_mut(j);
            for (bucket, run) in &runs {
                let products = run.clone().map(|at| column[row(at)] * residual[at]);
                target[*bucket] += products.sum::<f64>();
            }
        }
        scores
    }

    /// Sums within buckets, then their signed sums: flips × columns.
    #[must_use]
    pub fn flip(&self, bucket_scores: MatRef<'_, f64>) -> Mat<f64> {
        let mut sums = Mat::zeros(self.signs.nrows(), bucket_scores.ncols());
        matmul(&mut sums, Accum::Replace, &self.signs, bucket_scores, 1.0, Par::Seq);
        sums
    }

    /// The signs of one flip, bucket by bucket.
    #[must_use]
    pub fn of_flip(&self, flip: usize) -> Vec<f64> {
        self.signs.row(flip).iter().copied().collect()
    }

    /// How many buckets have a sign.
    #[must_use]
    pub fn with_sign(&self) -> usize {
        self.buckets() - self.stated
    }

    /// How many rows, the last, state something by themselves.
    #[must_use]
    pub fn stated(&self) -> usize {
        self.stated
    }

    /// How many buckets.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.signs.ncols()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is stated is turned and keeps its length; the signs of the other rows are what they are without it.
    #[test]
    fn what_is_stated_is_turned() {
        let groups: Vec<u32> = (0..12).collect();
        let (stated, flips) = (5, 400);
        let [alone, signs] = [&groups[..7], &groups].map(|own| Signs::new(own, own.len() - 7, flips, 3));
        assert_eq!((signs.with_sign(), signs.buckets()), (7, 12));
        let mut means = vec![0.0; stated];
        for flip in 0..flips {
            let own = signs.of_flip(flip);
            assert_eq!(own[..7], alone.of_flip(flip));
            let square: f64 = own[7..].iter().map(|value| value * value).sum();
            assert!((square - stated as f64).abs() < 1e-12);
            means.iter_mut().zip(&own[7..]).for_each(|(mean, value)| *mean += value / flips as f64);
        }
        // Four standard deviations of the mean of that many numbers of mean square one.
        assert!(means.iter().all(|mean| mean.abs() < 4.0 / (flips as f64).sqrt()), "{means:?}");
        // One size for all that is stated: 3² + 4² over 5 − 1 numbers that the fit does not follow.
        let left = [[1.0; 7].as_slice(), &[3.0, 4.0, 0.0, 0.0, 0.0]].concat();
        let leverage = [[0.75; 7].as_slice(), &[0.0, 0.0, 0.0, 0.0, 1.0]].concat();
        let flipped = signs.flipped(&left, &leverage);
        assert!(flipped[..7].iter().all(|value| (value - 2.0).abs() < 1e-12));
        assert!(flipped[7..].iter().all(|value| (value - 2.5).abs() < 1e-12), "{flipped:?}");
    }
}
