//! Random signs for the rows, drawn group by group.

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::folds::number;
use crate::data::golden;

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
    /// Signs for the rows whose groups are given. Where there are many groups, neighbours flip together: whatever
    /// correlation is left between them then counts as chance.
    #[must_use]
    pub fn new(group_of_row: &[u32], flips: usize, seed: u64) -> Self {
        Self::dealt(group_of_row, flips, seed, |number, groups, buckets| number * buckets / groups)
    }

    /// The same, but groups that flip together lie apart: correlation between neighbours is what is looked for.
    #[must_use]
    pub fn scattered(group_of_row: &[u32], flips: usize, seed: u64) -> Self {
        // Steps by the golden section come back to a bucket after as many steps as there are, in no simple pattern.
        Self::dealt(group_of_row, flips, seed, |number, groups, buckets| match groups > buckets {
            true => (golden::share(number) * buckets as f64) as usize % buckets,
            false => number,
        })
    }

    fn dealt(
        group_of_row: &[u32],
        flips: usize,
        seed: u64,
        bucket: impl Fn(usize, usize, usize) -> usize,
    ) -> Self {
        let (numbers, groups) = number(group_of_row);
        let buckets = groups.min(MOST_FLIPPED);
        let bucket_of_row =
            numbers.into_iter().map(|number| bucket(number as usize, groups, buckets)).collect();
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

    /// How many buckets.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.signs.ncols()
    }
}
