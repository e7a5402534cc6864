//! What remains of tolerances when a campaign of poses has been measured and its errors are corrected for.

use model_core::budget::Sensitivity;
use nalgebra::DMatrix;

use super::Tolerance;
use super::spread::{Spread, norm_squared};

/// Poses that will be measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaign {
    /// What the errors do at them, of the same errors as the tolerances.
    pub sensitivity: Sensitivity,
    /// The standard deviation of each measured component, rad or m.
    pub sigma: f64,
}

/// What remains.
#[derive(Debug, Clone, PartialEq)]
pub struct After {
    /// What to expect at each pose of use; `shares` say how much of the mean square less there would be for each
    /// percent off an error's variance, over a percent of the whole.
    pub spread: Spread,
    /// The share of the campaign's own noise in the mean square.
    pub share_of_noise: f64,
    /// The standard deviation of each error that remains, SI.
    pub standard_deviations: Vec<f64>,
    /// What independent normal numbers of variance one are multiplied by to make errors that are spread so, SI.
    pub root: DMatrix<f64>,
}

/// Σ_after = (Σ⁻¹ + AᵀA/σ²)⁻¹ with the campaign's columns A, and what it does over the poses of use; the tolerances count by
/// their variance, as if they were normal.
///
/// In units of the standard deviations, D = diag σᵢ, it is D (1 + D AᵀA D/σ²)⁻¹ D, which nothing makes singular.
#[must_use]
pub fn after(of_use: &Sensitivity, campaign: &Campaign, tolerances: &[Tolerance]) -> After {
    let n = tolerances.len();
    let sigma: Vec<f64> = tolerances.iter().map(Tolerance::standard_deviation).collect();
    let mut information = DMatrix::identity(n, n);
    for pose in 0..campaign.sensitivity.poses() {
        let columns = campaign.sensitivity.at_pose(pose);
        for i in 0..n {
            for j in 0..n {
                let product: f64 = (0..3).map(|axis| columns[i][axis] * columns[j][axis]).sum();
                information[(i, j)] += sigma[i] / campaign.sigma * product * (sigma[j] / campaign.sigma);
            }
        }
    }
    let Some(factor) = information.cholesky() else { unreachable!("one plus a sum of squares is positive") };
    // information = L Lᵀ, so that its inverse is L⁻ᵀ L⁻¹.
    let Some(inverse) = factor.l().try_inverse() else {
        unreachable!("the factor's diagonal is at least one")
    };
    let (root, kept) = (inverse.transpose(), inverse.transpose() * &inverse);
    let scaled =
        |matrix: &DMatrix<f64>| DMatrix::from_fn(n, n, |row, column| sigma[row] * matrix[(row, column)]);
    let (root, kept) = (scaled(&root), scaled(&kept));
    let squares = |columns: &[[f64; 3]], through: &DMatrix<f64>| -> Vec<f64> {
        (0..n)
            .map(|at| {
                let part =
                    [0, 1, 2].map(|axis| (0..n).map(|i| columns[i][axis] * through[(i, at)]).sum::<f64>());
                norm_squared(&part)
            })
            .collect()
    };
    // d ln(mean square) / d ln σᵢ²: what of the whole the error's own variance still brings; the rest is the campaign's noise.
    let poses = (0..of_use.poses()).map(|pose| {
        let columns = of_use.at_pose(pose);
        let of_errors = squares(columns, &kept);
        let whole: f64 = squares(columns, &root).iter().sum();
        let noise = (whole - of_errors.iter().sum::<f64>()).max(0.0);
        (of_errors, noise)
    });
    let spread = Spread::new(n, poses);
    let share_of_noise = (1.0 - spread.shares.iter().sum::<f64>()).clamp(0.0, 1.0);
    let standard_deviations = (0..n).map(|row| root.row(row).norm()).collect();
    After { spread, share_of_noise, standard_deviations, root }
}
