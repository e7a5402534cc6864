//! Sign flips with the variance that each really has: for few groups, and for rows that carry much of a fit.
//!
//! The residual r of a fit on U is flipped by S; the score QᵀSr of a block Q (orthonormal, and orthogonal to U) then has the
//! covariance σ²(I − WᵀW) with W = UᵀSQ, not σ²I as the score of the data has. Divided by its root, flip by flip, it is as
//! large as chance makes the data's own.
//!
//! Source: De Santis, Goeman, Hemerik, Davenport and Finos, "Inference in generalized linear models with robustness to
//! misspecified variances", arXiv:2209.13918.

use faer::{Mat, MatRef};

use super::signs::Signs;

/// Buckets of groups, for each fitted column and in all, from which on the plain flips, with each row's leverage undone, do
/// as well.
const MANY_FOR_A_COLUMN: usize = 16;
const MANY: usize = 100;

/// Shares of a score's variance that a flip leaves below which it says nothing.
const NOTHING: f64 = 1e-6;

/// What is flipped.
pub(super) struct Standardised<'a> {
    signs: &'a Signs,
    /// U.
    basis: MatRef<'a, f64>,
    residual: &'a [f64],
}

/// Whether flips of so many buckets have to be standardised after a fit of so many columns.
pub(super) fn is_needed(buckets: usize, fitted: usize) -> bool {
    buckets < MANY.min(MANY_FOR_A_COLUMN * fitted)
}

impl<'a> Standardised<'a> {
    pub fn new(signs: &'a Signs, basis: MatRef<'a, f64>, residual: &'a [f64]) -> Self {
        Self { signs, basis, residual }
    }

    /// What a block explains of each flip's sum of squares.
    pub fn gains(&self, block: MatRef<'_, f64>) -> Vec<f64> {
        let (p, q) = (self.basis.ncols(), block.ncols());
        let mut products = Mat::zeros(self.signs.buckets(), p * q + q);
        let mut product = vec![0.0; self.residual.len()];
        for c in 0..q {
            for u in 0..p {
                let pairs = self.basis.col(u).iter().zip(block.col(c).iter());
                product.iter_mut().zip(pairs).for_each(|(target, (a, b))| *target = a * b);
                self.add(&product, products.col_as_slice_mut(c * p + u));
            }
            let pairs = self.residual.iter().zip(block.col(c).iter());
            product.iter_mut().zip(pairs).for_each(|(target, (a, b))| *target = a * b);
            self.add(&product, products.col_as_slice_mut(p * q + c));
        }
        let flipped = self.signs.flip(products.as_ref());
        let mut left = Mat::zeros(q, q);
        (0..self.signs.flips())
            .map(|flip| {
                let w = |u: usize, c: usize| flipped[(flip, c * p + u)];
                for i in 0..q {
                    for j in 0..=i {
                        let taken: f64 = (0..p).map(|u| w(u, i) * w(u, j)).sum();
                        left[(i, j)] = if i == j { 1.0 - taken } else { -taken };
                    }
                }
                let score: Vec<f64> = (0..q).map(|c| flipped[(flip, p * q + c)]).collect();
                quadratic(&mut left, score)
            })
            .collect()
    }

    fn add(&self, product: &[f64], target: &mut [f64]) {
        self.signs.bucket_of_row().iter().zip(product).for_each(|(&bucket, value)| target[bucket] += value);
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
