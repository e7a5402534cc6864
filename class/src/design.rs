//! What data determine: columns of derivatives, what they leave of a signature, and how certain a sum of errors is.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Combinations whose squared singular value is below this share of the largest are not seen.
const SEEN: f64 = 1e-11;

/// Columns of derivatives, each scaled to length one.
#[derive(Debug, Clone)]
pub struct Design<'c> {
    columns: Vec<&'c [f64]>,
    lengths: Vec<f64>,
    seen: Vec<(f64, DVector<f64>)>,
}

impl<'c> Design<'c> {
    /// The design of columns of one length. Columns of zeros are allowed; one that is not finite is left out.
    #[must_use]
    pub fn new(columns: impl IntoIterator<Item = &'c Vec<f64>>) -> Self {
        let is_finite = |column: &&[f64]| product(column, column).is_finite();
        let columns: Vec<&[f64]> = columns.into_iter().map(Vec::as_slice).filter(is_finite).collect();
        let length =
            |column: &&[f64]| Some(product(column, column).sqrt()).filter(|own| *own > 0.0).unwrap_or(1.0);
        let lengths: Vec<f64> = columns.iter().map(length).collect();
        let count = columns.len();
        let scaled = |i: usize, j: usize| product(columns[i], columns[j]) / (lengths[i] * lengths[j]);
        let mut seen = Vec::new();
        if count > 0 {
            let eigen = SymmetricEigen::new(DMatrix::from_fn(count, count, scaled));
            let largest = eigen.eigenvalues.amax();
            for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                if *value > SEEN * largest {
                    seen.push((*value, vector.into_owned()));
                }
            }
        }
        Self { columns, lengths, seen }
    }

    /// The length of what no sum of the columns explains.
    #[must_use]
    pub fn left_of(&self, signature: &[f64]) -> f64 {
        let along = self
            .columns
            .iter()
            .zip(&self.lengths)
            .map(|(column, length)| product(column, signature) / length);
        let along = DVector::from_vec(along.collect());
        let explained: f64 = self.seen.iter().map(|(value, vector)| vector.dot(&along).powi(2) / value).sum();
        (product(signature, signature) - explained).max(0.0).sqrt()
    }

    /// The standard uncertainty of a sum of the errors times `weights`, where each number of the data has the noise 1.
    #[must_use]
    pub fn uncertainty(&self, weights: &[f64]) -> f64 {
        let scaled = weights.iter().zip(&self.lengths).map(|(weight, length)| weight / length);
        let scaled = DVector::from_vec(scaled.collect());
        let variance: f64 = self.seen.iter().map(|(value, vector)| vector.dot(&scaled).powi(2) / value).sum();
        variance.sqrt()
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
