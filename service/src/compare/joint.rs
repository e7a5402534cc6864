//! Whether several independent estimates of the same numbers are of one truth.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The test of many numbers at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The weighted sum of squares about the common estimate.
    pub chi_squared: f64,
    /// Its degrees of freedom.
    pub freedom: f64,
    /// The chance of as much where nothing changed.
    pub p_value: f64,
}

/// What a variance is less than, against the largest, where nothing of it is more than rounding.
const ROUNDING: f64 = 1e-13;

/// Tests whether estimates, each a vector with its covariance, are of one vector. `None` of less than two, or of nothing.
///
/// Source: the homogeneity statistic Q of W. G. Cochran, "The combination of estimates from different experiments", Biometrics 10 (1954)
/// 101–129, for vectors. Of two estimates it is dᵀ(C₁ + C₂)⁻¹d of their difference d.
#[must_use]
pub fn homogeneous(estimates: &[(DVector<f64>, DMatrix<f64>)]) -> Option<Joint> {
    let count = estimates.first()?.0.len();
    if estimates.len() < 2 || count == 0 {
        return None;
    }
    // Each in units of its uncertainty, so that radians and metres weigh alike.
    let scale = DVector::from_fn(count, |at, _| {
        estimates.iter().map(|(_, own)| own[(at, at)]).fold(0.0, f64::max).sqrt().max(f64::MIN_POSITIVE)
    });
    let scaled = estimates.iter().map(|(value, covariance)| {
        let value = value.component_div(&scale);
        let covariance = DMatrix::from_fn(count, count, |a, b| covariance[(a, b)] / scale[a] / scale[b]);
        (value, inverse(covariance))
    });
    let scaled: Vec<(DVector<f64>, DMatrix<f64>)> = scaled.collect();
    let weights = scaled.iter().fold(DMatrix::zeros(count, count), |sum, (_, weight)| sum + weight);
    let weighted = scaled.iter().fold(DVector::zeros(count), |sum, (value, weight)| sum + weight * value);
    let common = inverse(weights) * weighted;
    let squares = scaled.iter().map(|(value, weight)| {
        let off = value - &common;
        (off.transpose() * weight * &off)[(0, 0)]
    });
    let chi_squared: f64 = squares.sum();
    let freedom = ((estimates.len() - 1) * count) as f64;
    let p_value = chance(chi_squared, freedom);
    Some(Joint { chi_squared, freedom, p_value })
}

/// The chance of a sum of squares at least as large.
pub(super) fn chance(chi_squared: f64, freedom: f64) -> f64 {
    match ChiSquared::new(freedom) {
        Ok(distribution) if chi_squared.is_finite() => distribution.sf(chi_squared.max(0.0)),
        // What is known exactly, and differs.
        _ => 0.0,
    }
}

/// The inverse of a matrix without negative eigenvalues; directions of variance zero count as known to rounding.
fn inverse(matrix: DMatrix<f64>) -> DMatrix<f64> {
    let parts = SymmetricEigen::new(matrix);
    let least = (ROUNDING * parts.eigenvalues.max()).max(f64::MIN_POSITIVE);
    let inverse = parts.eigenvalues.map(|value| 1.0 / value.max(least));
    &parts.eigenvectors * DMatrix::from_diagonal(&inverse) * parts.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Reference: `service/tests/compare/reference.py` (NumPy, SciPy).
    #[test]
    fn validate_against_an_independent_program() {
        let matrix = |rows: &[f64]| DMatrix::from_row_slice(3, 3, rows);
        let estimates = [
            (
                DVector::from_row_slice(&[1.0, 2.0, 3.0]),
                matrix(&[0.5, 0.1, 0.0, 0.1, 0.4, 0.2, 0.0, 0.2, 0.9]),
            ),
            (
                DVector::from_row_slice(&[1.4, 0.6, 3.3]),
                matrix(&[0.3, 0.0, 0.1, 0.0, 0.2, 0.0, 0.1, 0.0, 0.6]),
            ),
            (
                DVector::from_row_slice(&[0.2, 1.9, 1.5]),
                matrix(&[0.7, 0.2, 0.1, 0.2, 0.8, 0.0, 0.1, 0.0, 0.5]),
            ),
        ];
        let two = homogeneous(&estimates[..2]).expect("two");
        let three = homogeneous(&estimates).expect("three");
        for (found, chi_squared, freedom, p_value) in
            [(two, TWO[0], 3.0, TWO[1]), (three, THREE[0], 6.0, THREE[1])]
        {
            assert_relative_eq!(found.chi_squared, chi_squared, max_relative = 1e-10);
            assert_relative_eq!(found.p_value, p_value, max_relative = 1e-9);
            assert_relative_eq!(found.freedom, freedom);
        }
    }

    const TWO: [f64; 2] = [4.134_575_260_804_77, 0.247_294_316_333_095];
    const THREE: [f64; 2] = [8.246_398_387_603_88, 0.220_601_645_582_633];

    #[test]
    fn numbers_of_very_different_units_weigh_alike() {
        let of = |factor: f64| {
            let value = |a: f64, b: f64| DVector::from_row_slice(&[a, b * factor]);
            let covariance =
                DMatrix::from_row_slice(2, 2, &[1.0, 0.3 * factor, 0.3 * factor, factor * factor]);
            homogeneous(&[(value(0.0, 1.0), covariance.clone()), (value(2.0, -1.0), covariance)])
        };
        let [one, other] = [of(1.0), of(1e-9)].map(|own| own.expect("two").chi_squared);
        assert_relative_eq!(one, other, max_relative = 1e-9);
    }
}
