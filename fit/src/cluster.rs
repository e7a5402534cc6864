//! Uncertainties where rows of one group are not independent: cluster-robust, with the bias and the degrees of freedom of few
//! groups taken care of.
//!
//! Source: R. M. Bell, D. F. McCaffrey, Bias reduction in standard errors for linear regression with multi-stage samples,
//! Survey Methodology 28 (2002) 169-181: the adjustment CR2 and its degrees of freedom under independent errors; in the form
//! of J. E. Pustejovsky, E. Tipton, Journal of Business & Economic Statistics 36 (2018) 672-683. With orthonormal columns Q,
//! (1 − Q_g Q_gᵀ)^(−1/2) Q_g = Q_g (1 − Q_gᵀ Q_g)^(−1/2), so that a group needs no more than its product Q_gᵀ Q_g.

use faer::{Mat, Side};

/// A group's direction that the group alone determines leaves no residual to learn from.
pub(super) const ALONE: f64 = 1e-8;

/// What a group of rows has part in: columns Q that are orthonormal over all rows.
#[derive(Debug, Clone)]
pub(super) struct Share {
    /// Q_gᵀ Q_g, k × k.
    pub gram: Mat<f64>,
    /// Q_gᵀ e, length k.
    pub score: Vec<f64>,
    /// Components.
    pub count: f64,
}

/// Groups, each adjusted for what the fit took out of its residuals.
#[derive(Debug, Clone)]
pub(super) struct Clusters {
    /// Per group its Q_gᵀ Q_g and (1 − Q_gᵀ Q_g)^(−1/2).
    groups: Vec<(Mat<f64>, Mat<f64>)>,
    /// Per group its adjusted score, a column each, k × groups.
    scores: Mat<f64>,
}

impl Clusters {
    /// Of the shares of all groups.
    pub fn new(shares: Vec<Share>) -> Self {
        let k = shares.first().map_or(0, |share| share.score.len());
        let mut scores = Mat::zeros(k, shares.len());
        let mut groups = Vec::with_capacity(shares.len());
        for (at, share) in shares.into_iter().enumerate() {
            let adjustment = adjustment(&share.gram);
            let score = Mat::from_fn(k, 1, |row, _| share.score[row]);
            scores.col_mut(at).copy_from((&adjustment * score).col(0));
            groups.push((share.gram, adjustment));
        }
        Self { groups, scores }
    }

    /// A matrix whose product with its own transpose is the covariance of Qᵀe, k × groups.
    pub fn scores(&self) -> &Mat<f64> {
        &self.scores
    }

    /// The degrees of freedom of the variance of a combination of the columns.
    pub fn degrees_of_freedom(&self, combination: &[f64]) -> f64 {
        let k = combination.len();
        let a = Mat::from_fn(k, 1, |row, _| combination[row]);
        let (mut trace, mut squares) = (0.0, 0.0);
        let mut products = Mat::<f64>::zeros(k, k);
        for (gram, adjustment) in &self.groups {
            let w = adjustment * &a;
            let b = gram * &w;
            let own = (w.transpose() * &b)[(0, 0)];
            let across = b.squared_norm_l2();
            trace += own - across;
            // The product with itself is among those of all pairs.
            squares += (own - across).powi(2) - across * across;
            products += &b * b.transpose();
        }
        squares += products.squared_norm_l2();
        if squares > 0.0 { trace * trace / squares } else { 0.0 }
    }
}

/// (1 − M)^(−1/2), where M says that all is the group's own: nothing.
fn adjustment(gram: &Mat<f64>) -> Mat<f64> {
    let k = gram.nrows();
    let Ok(eigen) = gram.self_adjoint_eigen(Side::Lower) else { return Mat::identity(k, k) };
    let (u, s) = (eigen.U(), eigen.S().column_vector());
    let scaled = Mat::from_fn(k, k, |row, column| {
        let left = 1.0 - s[column];
        if left > ALONE { u[(row, column)] / left.sqrt() } else { 0.0 }
    });
    scaled * u.transpose()
}
