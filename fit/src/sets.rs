//! Uncertainties where rows are independent, whatever the noise of each: sets of rows, by the squares of their own scores.
//!
//! A fit takes its share of every residual. What it took counts as much as usual noise leaves: enlarged for it, residuals that are
//! followed nearly in full would be made of next to nothing.
//!
//! Source: H. White, Econometrica 48 (1980) 817-838, with the bias under even noise made up for (J. G. MacKinnon, H. White, Journal
//! of Econometrics 29 (1985) 305-325) by adding instead of enlarging.

use faer::Mat;

use super::cluster::Share;

/// Sets of rows that are independent, as columns Q that are orthonormal over all rows see them.
#[derive(Debug, Clone)]
pub(super) struct Sets {
    /// Per set its Q_gᵀ Q_g.
    grams: Vec<Mat<f64>>,
    /// What the sets show of the covariance of Qᵀe, with what objects and stations took of it.
    shown: Mat<f64>,
    /// What the errors took of it.
    by_errors: Mat<f64>,
}

impl Sets {
    /// Of the shares of all sets; objects and stations took `by_unknowns` of Qᵀ Q, and usual noise has this variance.
    pub fn new(shares: Vec<Share>, by_unknowns: &Mat<f64>, variance: f64) -> Self {
        let k = by_unknowns.ncols();
        let (mut shown, mut by_errors) = (by_unknowns * faer::Scale(variance), Mat::zeros(k, k));
        for Share { gram, score, .. } in &shares {
            let score = Mat::from_fn(k, 1, |row, _| score[row]);
            shown += &score * score.transpose();
            by_errors += gram * gram;
        }
        let grams = shares.into_iter().map(|share| share.gram).collect();
        Self { grams, shown, by_errors: by_errors * faer::Scale(variance) }
    }

    /// The covariance of Qᵀe but for what the errors took, and what they took.
    pub fn parts(&self) -> [&Mat<f64>; 2] {
        [&self.shown, &self.by_errors]
    }

    /// The degrees of freedom of what the sets show along a combination of the columns: as many as sets have part in it, each of which
    /// is one square.
    ///
    /// Source: F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110-114.
    pub fn degrees_of_freedom(&self, combination: &[f64]) -> f64 {
        let a = Mat::from_fn(combination.len(), 1, |row, _| combination[row]);
        let shares = self.grams.iter().map(|gram| (a.transpose() * (gram * &a))[(0, 0)]);
        let (sum, squares) =
            shares.fold((0.0, 0.0), |(sum, squares), share| (sum + share, squares + share * share));
        if squares > 0.0 { sum * sum / squares } else { 0.0 }
    }
}
