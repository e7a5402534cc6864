//! What rows of one file share, of a fit that reads many: errors of a day, say, which no number of rows makes up for.
//!
//! What the files say of the estimates scatters by more than their rows do, if so. Then uncertainties come from whole files.

use faer::Mat;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::cluster::{Clusters, Share};
use super::partial::Partial;

/// Files scatter so much by chance in one fit of a thousand.
const BY_CHANCE: f64 = 0.001;

/// Fewer files say nothing about others.
const FEWEST: usize = 3;

/// Rows of one file share an error.
#[derive(Debug, Clone)]
pub struct SharedByUnits {
    /// How many files there are.
    pub units: usize,
    /// The variance of what they say of the estimates, over what their rows explain.
    pub ratio: f64,
    /// How often files of independent rows scatter as much.
    pub p_value: f64,
    /// Covariance of the estimates from whole files, p × p, SI.
    pub covariance: Mat<f64>,
}

/// Whether the rows of a unit share anything. The factors of the units are whitened and weighted, over all parameters; `root` times its
/// transpose is the inverse of their sum's product, `variance` that of a row's whitened and weighted residual over its weight, and
/// `stride` by how much a step with fixed weights falls short.
pub(super) fn shared(
    units: &[Partial],
    root: &Mat<f64>,
    variance: f64,
    stride: f64,
) -> Option<SharedByUnits> {
    if units.len() < FEWEST || variance <= 0.0 {
        return None;
    }
    let shares: Vec<Share> = units.iter().map(|unit| share(unit, root)).collect();
    let scatter: f64 = shares.iter().map(|share| share.score.iter().map(|s| s * s).sum::<f64>()).sum();
    let own: f64 =
        shares.iter().map(|share| (0..root.ncols()).map(|at| share.gram[(at, at)]).sum::<f64>()).sum();
    let squares: f64 = shares.iter().map(|share| share.gram.squared_norm_l2()).sum();
    // The scores add up to nothing where the fit is best, which takes a part of each.
    let expected = own - squares;
    if expected <= 0.0 || squares <= 0.0 {
        return None;
    }
    // A sum of squares of unequal weights is as good as a multiple of chi-squared with the same mean and variance.
    // Source: F. E. Satterthwaite, An approximate distribution of estimates of variance components, Biometrics Bulletin 2 (1946) 110-114.
    let ratio = scatter / variance / expected;
    let degrees_of_freedom = expected * expected / squares;
    let p_value = ChiSquared::new(degrees_of_freedom).ok()?.sf(ratio * degrees_of_freedom);
    if p_value >= BY_CHANCE {
        return None;
    }
    let own = root * Clusters::new(shares).scores();
    let covariance = &own * own.transpose() * faer::Scale(stride * stride);
    Some(SharedByUnits { units: units.len(), ratio, p_value, covariance })
}

/// What a unit has part in: its factor in the directions of the estimates.
fn share(unit: &Partial, root: &Mat<f64>) -> Share {
    let p = root.nrows();
    let factor = unit.factor();
    let columns = factor.submatrix(0, 0, p + 1, p) * root;
    let score = columns.transpose() * factor.col(p);
    Share {
        gram: columns.transpose() * &columns,
        score: score.iter().copied().collect(),
        count: unit.components as f64,
    }
}
