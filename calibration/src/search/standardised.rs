//! Sign flips with the variance that each really has: for few groups, and for rows that carry much of a fit.
//!
//! The residual r of a fit on U is flipped by S; the score QᵀSr of a block Q (orthonormal, and orthogonal to U) then has the
//! covariance σ²(I − WᵀW) with W = UᵀSQ, not σ²I as the score of the data has. Divided by its root, flip by flip, it is as
//! large as chance makes the data's own.
//!
//! Source: De Santis, Goeman, Hemerik, Davenport and Finos, "Inference in generalized linear models with robustness to
//! misspecified variances", arXiv:2209.13918.

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use super::products::picked;
use super::signs::Signs;

/// Buckets of groups for each fitted column from which on the plain flips, with each row's leverage undone, do as well.
const MANY_FOR_A_COLUMN: usize = 16;

/// The same of all fitted columns.
pub(super) const MANY: usize = 100;

/// Shares of a score's variance that a flip leaves below which it says nothing.
const NOTHING: f64 = 1e-6;

/// What is flipped, its rows in the order of their buckets.
pub(super) struct Standardised<'a> {
    signs: &'a Signs,
    /// Which row comes when.
    order: Vec<usize>,
    /// The rows of each bucket in that order.
    buckets: Vec<(usize, Range<usize>)>,
    /// `[U | r]`.
    fitted: Mat<f64>,
}

/// Whether flips of so many buckets have to be standardised after a fit of so many columns.
pub(super) fn is_needed(buckets: usize, fitted: usize) -> bool {
    buckets < MANY.min(MANY_FOR_A_COLUMN * fitted)
}

impl<'a> Standardised<'a> {
    pub fn new(signs: &'a Signs, basis: MatRef<'_, f64>, residual: &[f64]) -> Self {
        let of_row = signs.bucket_of_row();
        let mut order: Vec<usize> = (0..residual.len()).collect();
        order.sort_by_key(|&row| of_row[row]);
        let mut end = 0;
        let runs = order.chunk_by(|&a, &b| of_row[a] == of_row[b]).map(|run| {
            end += run.len();
            (of_row[run[0]], end - run.len()..end)
        });
        let buckets = runs.collect();
        let p = basis.ncols();
        let mut fitted = Mat::zeros(residual.len(), p + 1);
        fitted.subcols_mut(0, p).copy_from(picked(basis, &order));
        fitted.col_as_slice_mut(p).iter_mut().zip(&order).for_each(|(to, &row)| *to = residual[row]);
        Self { signs, order, buckets, fitted }
    }

    /// What a block explains of each flip's sum of squares.
    pub fn gains(&self, block: MatRef<'_, f64>) -> Vec<f64> {
        let (p, q) = (self.fitted.ncols() - 1, block.ncols());
        let block = picked(block, &self.order);
        // Of each bucket the products of U and of the residual with each column of the block.
        let mut products = Mat::zeros(self.signs.buckets(), (p + 1) * q);
        let mut own = Mat::zeros(p + 1, q);
        for (bucket, rows) in &self.buckets {
            let fitted = self.fitted.subrows(rows.start, rows.len());
            let block = block.subrows(rows.start, rows.len());
            matmul(&mut own, Accum::Replace, fitted.transpose(), block, 1.0, Par::Seq);
            for (c, column) in own.col_iter().enumerate() {
                for (u, product) in column.iter().enumerate() {
                    products[(*bucket, c * (p + 1) + u)] = *product;
                }
            }
        }
        let flipped = self.signs.flip(products.as_ref());
        let mut left = Mat::zeros(q, q);
        (0..self.signs.flips())
            .map(|flip| {
                let w = |u: usize, c: usize| flipped[(flip, c * (p + 1) + u)];
                for i in 0..q {
                    for j in 0..=i {
                        let taken: f64 = (0..p).map(|u| w(u, i) * w(u, j)).sum();
                        left[(i, j)] = if i == j { 1.0 - taken } else { -taken };
                    }
                }
                let score: Vec<f64> = (0..q).map(|c| w(p, c)).collect();
                quadratic(&mut left, score)
            })
            .collect()
    }
}

/// zᵀA⁻¹z of a symmetric matrix whose lower half is given (and spoiled), directions in which A is nothing left out.
fn quadratic(a: &mut Mat<f64>, mut z: Vec<f64>) -> f64 {
    let q = z.len();
    let mut sum = 0.0;
    for k in 0..q {
        let pivot = a[(k, k)];
        if pivot <= NOTHING {
            continue;
        }
        sum += z[k] * z[k] / pivot;
        for i in k + 1..q {
            let factor = a[(i, k)] / pivot;
            z[i] -= factor * z[k];
            for j in k + 1..=i {
                a[(i, j)] -= factor * a[(j, k)];
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quadratic_form_is_that_of_the_inverse() {
        // A = [4 1 0; 1 3 1; 0 1 2], z = (1, 2, 3), det A = 18.
        let mut a = Mat::from_fn(3, 3, |i, j| [[4.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 2.0]][i][j]);
        // adj A = [5 −2 1; −2 8 −4; 1 −4 11]; zᵀ adj z = 5 + 32 + 99 − 8 + 6 − 48 = 86.
        assert!((quadratic(&mut a, vec![1.0, 2.0, 3.0]) - 86.0 / 18.0).abs() < 1e-12);
    }
}
