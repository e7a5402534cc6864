//! Whether new rows are what a calibration foretells, and what alone would explain that they are not.
//!
//! All numbers are whitened by the noise of one observation. What is foretold of a row is off by J·e, e with the covariance C of the
//! parameters. Rows say of each observed combination how far it is from the calibration's (the explained part, by what rows and calibration
//! leave uncertain), and of the rest that no parameter follows only the noise. Both parts are independent.

use nalgebra::{DMatrix, DVector};

use super::chance::Squares;
use super::policy::OBSERVED;

/// A part of the disagreement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// The sum of squares in units of what is foretold.
    pub sum: f64,
    /// Its degrees of freedom.
    pub freedom: usize,
    /// The chance of as much where nothing changed; 1 of nothing.
    pub p_value: f64,
}

/// What is known of rows beside a calibration.
pub struct Agreement {
    /// What parameters follow.
    pub explained: Part,
    /// What no parameter follows.
    pub rest: Part,
    /// Per parameter what the rows say of a change of it alone: the information, one over its variance.
    pub information: DVector<f64>,
    /// Per parameter that information times the change that explains the rows best.
    pub score: DVector<f64>,
    /// Per row by how much the sum of squares is less without it.
    pub gain_of_row: Vec<f64>,
    /// The change of all parameters that explains the rows best, the smallest of such.
    pub change: DVector<f64>,
    /// How uncertain that is.
    pub uncertainty: DMatrix<f64>,
}

/// Compares rows with what is foretold: whitened residuals, so many components a row; whitened derivatives; the covariance of the
/// parameters; and the degrees of freedom of the noise.
#[must_use]
pub fn agreement(
    residual: &DVector<f64>,
    columns: &DMatrix<f64>,
    covariance: &DMatrix<f64>,
    components: usize,
    noise: Option<f64>,
) -> Agreement {
    let (count, parameters) = (residual.len(), columns.ncols());
    let (left, sizes, right) = observed(columns);
    let rank = sizes.len();
    let seen = left.tr_mul(residual);
    let scaled = DMatrix::from_fn(rank, parameters, |at, parameter| sizes[at] * right[(at, parameter)]);
    let foretold = DMatrix::identity(rank, rank) + &scaled * covariance * scaled.transpose();
    let solved = solve(foretold, &DMatrix::from_column_slice(rank, 1, seen.as_slice()));
    let explained = seen.dot(&solved.column(0));
    let rest = (residual.norm_squared() - seen.norm_squared()).max(0.0);
    let part = |sum: f64, freedom: usize| {
        let p_value = if freedom == 0 { 1.0 } else { Squares::new(freedom, noise).beyond(sum) };
        Part { sum, freedom, p_value }
    };
    let matrix = columns.tr_mul(columns);
    let information = information(&matrix, covariance);
    let identity = || DMatrix::<f64>::identity(parameters, parameters);
    let own = DMatrix::from_column_slice(parameters, 1, columns.tr_mul(residual).as_slice());
    let score = solve(identity() + &matrix * covariance, &own).column(0).into_owned();
    let back = DMatrix::from_fn(parameters, rank, |parameter, at| right[(at, parameter)] / sizes[at]);
    Agreement {
        explained: part(explained, rank),
        rest: part(rest, count - rank),
        information: information.diagonal(),
        score,
        gain_of_row: gain_of_rows(residual, columns, covariance, components),
        change: &back * &seen,
        uncertainty: &back * back.transpose() + projected(&right, covariance),
    }
}

/// The part of a covariance that rows see.
fn projected(right: &DMatrix<f64>, covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let onto = right.tr_mul(right);
    &onto * covariance * &onto
}

/// The combinations that rows observe: left vectors, singular values and right vectors, as rows.
fn observed(columns: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>, DMatrix<f64>) {
    if columns.is_empty() {
        return (DMatrix::zeros(columns.nrows(), 0), Vec::new(), DMatrix::zeros(0, columns.ncols()));
    }
    let parts = columns.clone().svd(true, true);
    let (Some(left), Some(right)) = (parts.u, parts.v_t) else { unreachable!("both factors were asked for") };
    let most = parts.singular_values.max();
    let seen: Vec<usize> =
        (0..parts.singular_values.len()).filter(|at| parts.singular_values[*at] > OBSERVED * most).collect();
    let sizes = seen.iter().map(|at| parts.singular_values[*at]).collect();
    (left.select_columns(&seen), sizes, right.select_rows(&seen))
}

/// How many combinations some columns show.
#[must_use]
pub fn rank(columns: &DMatrix<f64>) -> usize {
    observed(columns).1.len()
}

/// What rows and a calibration say together of changes: (1 + MC)⁻¹M, of rows with JᵀJ = M.
#[must_use]
pub fn information(matrix: &DMatrix<f64>, covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let parameters = matrix.nrows();
    solve(DMatrix::identity(parameters, parameters) + matrix * covariance, matrix)
}

/// By how much the sum of squares about what is foretold is less without each row.
fn gain_of_rows(
    residual: &DVector<f64>,
    columns: &DMatrix<f64>,
    covariance: &DMatrix<f64>,
    components: usize,
) -> Vec<f64> {
    let parameters = columns.ncols();
    // The inverse of 1 + JCJᵀ is 1 − JKJᵀ.
    let matrix = columns.tr_mul(columns);
    let kernel = solve(DMatrix::identity(parameters, parameters) + covariance * matrix, covariance);
    let weighted = residual - columns * (&kernel * columns.tr_mul(residual));
    let rows = residual.len() / components.max(1);
    let gain = |row: usize| {
        let own = columns.rows(row * components, components);
        let inverse = DMatrix::identity(components, components) - own * &kernel * own.transpose();
        let part = weighted.rows(row * components, components).into_owned();
        let solved = solve(inverse, &DMatrix::from_column_slice(components, 1, part.as_slice()));
        part.dot(&solved.column(0))
    };
    (0..rows).map(gain).collect()
}

/// A solution of equations that have one: what is singular to rounding is solved by its pseudo-inverse.
fn solve(matrix: DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    if right.is_empty() {
        return right.clone();
    }
    match matrix.clone().lu().solve(right) {
        Some(solved) if solved.iter().all(|value| value.is_finite()) => solved,
        _ => matrix.svd(true, true).solve(right, f64::EPSILON).unwrap_or_else(|_| right.scale(0.0)),
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Reference: `service/tests/verify/reference.py`, by the whole covariance of the rows.
    #[test]
    fn validate_against_an_independent_program() {
        let columns = DMatrix::from_row_slice(
            6,
            3,
            &[1.0, 0.2, 0.0, 0.0, 1.0, 0.5, 0.3, 0.0, 1.0, 1.0, -0.2, 0.1, 0.1, 1.0, -0.5, -0.3, 0.4, 1.0],
        );
        let covariance =
            DMatrix::from_row_slice(3, 3, &[0.05, 0.01, 0.0, 0.01, 0.08, -0.02, 0.0, -0.02, 0.04]);
        let residual = DVector::from_row_slice(&[2.1, -0.4, 1.9, 1.2, 0.3, 0.8]);
        let found = agreement(&residual, &columns, &covariance, 2, None);
        assert_relative_eq!(found.explained.sum, 7.563_530_327_15, max_relative = 1e-10);
        assert_relative_eq!(found.rest.sum, 1.960_950_985_6, max_relative = 1e-10);
        assert_eq!((found.explained.freedom, found.rest.freedom), (3, 3));
        let close = |found: &[f64], expected: [f64; 3]| {
            for (found, expected) in found.iter().zip(expected) {
                assert_relative_eq!(*found, expected, max_relative = 1e-10);
            }
        };
        close(found.information.as_slice(), [1.975_055_731_29, 1.922_849_918_8, 2.303_405_694_87]);
        close(found.score.as_slice(), [3.288_632_223_79, 0.338_178_453_51, 2.247_262_501_05]);
        close(&found.gain_of_row, [4.105_353_340_02, 4.437_663_530_48, 0.703_160_986_39]);
    }

    /// Errors that these rows cannot separate do not count as two.
    #[test]
    fn what_rows_do_not_separate_counts_once() {
        let columns = DMatrix::from_fn(4, 2, |row, _| 1.0 + row as f64);
        let residual = DVector::from_row_slice(&[1.0, 2.0, 3.0, 4.0]);
        // They are known only together: 1e6 apart, 0.01 together.
        let covariance = DMatrix::from_row_slice(2, 2, &[1e12, -1e12 + 1e-4, -1e12 + 1e-4, 1e12]);
        let found = agreement(&residual, &columns, &covariance, 1, None);
        assert_eq!((found.explained.freedom, found.rest.freedom), (1, 3));
        assert!(found.information.iter().all(|own| own.is_finite() && *own > 0.0), "{}", found.information);
    }
}
