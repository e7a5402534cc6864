//! A packed triangular factor of the weighted derivatives and residuals: rows are added to it, and two of them merge.
//!
//! Its size depends on the number of columns alone. A factor rather than normal equations, so that the condition
//! number is not squared: which combinations the data determine is decided at 1e-8, where normal equations have
//! only rounding errors left.

use codegen::vector;
use faer::{Mat, MatRef};

use super::reflections::{LANES, Reflections};

/// The triangular factor R of [J | r] for all rows so far, with counts: QᵀQ = 1, [J | r] = Q R.
///
/// p parameters, so R is (p + 1) × (p + 1); the last column belongs to the residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Partial {
    /// p.
    pub parameters: usize,
    /// Residual components that went in.
    pub components: u64,
    /// R, column by column, each down to its diagonal.
    packed: Vec<f64>,
}

/// Why partial sums do not belong together, or bytes are none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PartialError {
    /// Sums over different parameters.
    #[error(
        "partial sums of {one} and of {other} columns do not belong together: accumulate both with one pass"
    )]
    Columns {
        /// Columns of the one.
        one: usize,
        /// Columns of the other.
        other: usize,
    },
    /// Sums over different kinds of components.
    #[error(
        "partial sums of {one} and of {other} kinds of components do not belong together: accumulate both with one pass"
    )]
    Kinds {
        /// Kinds of the one.
        one: usize,
        /// Kinds of the other.
        other: usize,
    },
    /// Sums at different values of the errors, or with different weights.
    #[error(
        "partial sums of different passes do not belong together: accumulate every chunk again with the pass at hand"
    )]
    Passes,
    /// Bytes that are something else.
    #[error("these bytes are no partial sums")]
    NotPartial,
    /// Bytes of another version.
    #[error("these bytes are partial sums as another version writes them: run the same version everywhere")]
    Version,
    /// Too few bytes, or too many.
    #[error(
        "these partial sums have {found} bytes where {expected} were expected: they were cut off, or added to"
    )]
    Length {
        /// Bytes that there should be.
        expected: usize,
        /// Bytes that there are.
        found: usize,
    },
    /// A number among them is none.
    #[error("these partial sums hold a number that is not finite")]
    NotFinite,
}

/// Rows of [J | r] column by column, whitened and weighted, on their way into a [`Partial`].
#[derive(Debug, Clone)]
pub struct Rows {
    values: Vec<f64>,
    /// Rows there are, and with the zeros that make them whole groups of lanes.
    count: usize,
    stride: usize,
}

impl Rows {
    /// So many rows and columns, all zero; as many columns as parameters, and the residual last.
    #[must_use]
    pub fn zeros(count: usize, columns: usize) -> Self {
        let stride = count.next_multiple_of(LANES);
        Self { values: vec![0.0; stride * columns], count, stride }
    }

    /// Rotates the rows so that the first `k` columns move `k` rows of their own alone: those, k × all columns, and what is left
    /// of the rows in the other columns.
    #[must_use]
    pub fn split(mut self, k: usize) -> (Mat<f64>, Self) {
        let Some(side) = self.values.len().checked_div(self.stride) else {
            unreachable!("rows that are split are one at least")
        };
        let mut packed = vec![0.0; side * (side + 1) / 2];
        self.reflect(&mut packed, side, k.min(side));
        let at = |row: usize, column: usize| {
            if row > column { 0.0 } else { packed[column * (column + 1) / 2 + row] }
        };
        let own = Mat::from_fn(k, side, at);
        let values = self.values.split_off(k.min(side) * self.stride);
        (own, Self { values, ..self })
    }

    /// Turns the first of `side` columns, so many, into a triangle above the rows.
    fn reflect(&mut self, packed: &mut [f64], side: usize, leading: usize) {
        let (values, stride) = (self.values.as_mut_slice(), self.stride);
        vector::run(vector::path(), Reflections { packed, side, leading, values, stride });
    }

    /// Rows below each other, so many columns of each.
    #[must_use]
    pub fn stacked(parts: Vec<Self>, columns: usize) -> Self {
        let mut stacked = Self::zeros(parts.iter().map(|part| part.count).sum(), columns);
        let mut at = 0;
        for mut part in parts {
            let count = part.count;
            for (to, from) in stacked.columns_mut().zip(part.columns_mut()) {
                to[at..at + count].copy_from_slice(from);
            }
            at += count;
        }
        stacked
    }

    /// How many rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// As a matrix.
    #[must_use]
    pub fn to_matrix(mut self) -> Mat<f64> {
        let columns: Vec<&mut [f64]> = self.columns_mut().collect();
        Mat::from_fn(columns.first().map_or(0, |column| column.len()), columns.len(), |i, j| columns[j][i])
    }

    /// The columns in order.
    pub fn columns_mut(&mut self) -> impl Iterator<Item = &mut [f64]> {
        let count = self.count;
        self.values.chunks_exact_mut(self.stride.max(1)).filter_map(move |column| column.get_mut(..count))
    }
}

impl Partial {
    /// No rows yet.
    #[must_use]
    pub fn new(parameters: usize) -> Self {
        let side = parameters + 1;
        Self { parameters, components: 0, packed: vec![0.0; side * (side + 1) / 2] }
    }

    /// Takes in rows of as many columns as there are parameters, and the residual.
    #[must_use]
    pub fn with(mut self, rows: Rows) -> Self {
        self.add(rows);
        self
    }

    /// The same in place.
    pub fn add(&mut self, mut rows: Rows) {
        self.components += rows.count as u64;
        let side = self.parameters + 1;
        rows.reflect(&mut self.packed, side, side);
    }

    /// Takes in the rows of a matrix.
    ///
    /// Columns in excess are not looked at; missing ones count as zero.
    #[must_use]
    pub fn with_rows(self, matrix: MatRef<'_, f64>) -> Self {
        let mut rows = Rows::zeros(matrix.nrows(), self.parameters + 1);
        for (to, from) in rows.columns_mut().zip(matrix.col_iter()) {
            to.iter_mut().zip(from.iter()).for_each(|(to, from)| *to = *from);
        }
        self.with(rows)
    }

    /// Both together.
    ///
    /// # Errors
    /// Partials of different numbers of parameters do not belong together.
    pub fn merge(self, other: &Self) -> Result<Self, PartialError> {
        if other.parameters != self.parameters {
            return Err(PartialError::Columns { one: self.parameters, other: other.parameters });
        }
        if other.components == 0 {
            return Ok(self);
        }
        let components = self.components + other.components;
        Ok(Self { components, ..self.with_rows(other.factor().as_ref()) })
    }

    /// R, column by column, each down to its diagonal.
    pub(super) fn packed(&self) -> &[f64] {
        &self.packed
    }

    /// The partial of so many numbers as its triangle has.
    pub(super) fn of_packed(parameters: usize, components: u64, packed: Vec<f64>) -> Self {
        debug_assert_eq!(packed.len(), (parameters + 1) * (parameters + 2) / 2);
        Self { parameters, components, packed }
    }

    /// The partial of parameters each of which has one of these columns, or none: then its column is zero.
    #[must_use]
    pub fn spread(&self, column_of: &[Option<usize>]) -> Self {
        let side = self.parameters + 1;
        let mut rows = Rows::zeros(side, column_of.len() + 1);
        for (to, from) in rows.columns_mut().zip(column_of.iter().chain([&Some(self.parameters)])) {
            if let Some(from) = *from {
                to.iter_mut().enumerate().for_each(|(row, to)| *to = self.at(row, from));
            }
        }
        Self { components: self.components, ..Self::new(column_of.len()).with(rows) }
    }

    /// R in full.
    #[must_use]
    pub fn factor(&self) -> Mat<f64> {
        let side = self.parameters + 1;
        Mat::from_fn(side, side, |row, column| self.at(row, column))
    }

    /// The length of a column of J.
    #[must_use]
    pub fn length(&self, column: usize) -> f64 {
        (0..=column).map(|row| self.at(row, column).powi(2)).sum::<f64>().sqrt()
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        if row > column {
            return 0.0;
        }
        self.packed[column * (column + 1) / 2 + row]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// RᵀR, which does not depend on signs.
    fn gram(partial: &Partial) -> Mat<f64> {
        let factor = partial.factor();
        factor.transpose() * &factor
    }

    proptest::proptest! {
        #[test]
        fn parts_merge_to_the_whole(values in proptest::collection::vec(-1.0f64..1.0, 60), cut in 0usize..20) {
            let rows = Mat::from_fn(20, 3, |row, column| values[3 * row + column]);
            let whole = Partial::new(2).with_rows(rows.as_ref());
            let first = Partial::new(2).with_rows(rows.subrows(0, cut));
            let second = Partial::new(2).with_rows(rows.subrows(cut, 20 - cut));
            let merged = first.merge(&second).unwrap();
            assert_eq!(merged.components, 20);
            let direct = rows.transpose() * &rows;
            for row in 0..3 {
                for column in 0..3 {
                    assert_relative_eq!(gram(&whole)[(row, column)], direct[(row, column)], epsilon = 1e-13);
                    assert_relative_eq!(gram(&merged)[(row, column)], direct[(row, column)], epsilon = 1e-13);
                }
            }
        }

        #[test]
        fn rows_that_are_split_have_the_same_inner_products(values in proptest::collection::vec(-1.0f64..1.0, 50)) {
            let matrix = Mat::from_fn(10, 5, |row, column| values[5 * row + column]);
            let mut rows = Rows::zeros(10, 5);
            for (j, column) in rows.columns_mut().enumerate() {
                column.iter_mut().enumerate().for_each(|(i, value)| *value = matrix[(i, j)]);
            }
            let (own, mut rest) = rows.split(2);
            let rest: Vec<Vec<f64>> = rest.columns_mut().map(|column| column.to_vec()).collect();
            for i in 0..5usize {
                for j in 0..5usize {
                    let of_rest: f64 = match (i.checked_sub(2), j.checked_sub(2)) {
                        (Some(i), Some(j)) => rest[i].iter().zip(&rest[j]).map(|(a, b)| a * b).sum(),
                        _ => 0.0,
                    };
                    let product = of_rest + (0..2).map(|row| own[(row, i)] * own[(row, j)]).sum::<f64>();
                    let direct: f64 = (0..10).map(|row| matrix[(row, i)] * matrix[(row, j)]).sum();
                    assert_relative_eq!(product, direct, epsilon = 1e-13);
                }
            }
        }
    }
}
