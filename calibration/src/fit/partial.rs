//! What the rows leave behind: a packed triangular factor that more rows go into and that merges with others.
//!
//! Its size depends on the number of parameters alone. A factor rather than normal equations, so that the condition
//! number is not squared.

use faer::{Mat, MatRef};
use serde::{Deserialize, Serialize};

/// The triangular factor R of [J | r] for all rows so far, with counts: QᵀQ = 1, [J | r] = Q R.
///
/// p parameters, so R is (p + 1) × (p + 1); the last column belongs to the residual.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Partial {
    /// p.
    pub parameters: usize,
    /// Residual components that went in.
    pub components: u64,
    /// R, column by column, each down to its diagonal.
    packed: Vec<f64>,
}

impl Partial {
    /// No rows yet.
    #[must_use]
    pub fn new(parameters: usize) -> Self {
        let side = parameters + 1;
        Self { parameters, components: 0, packed: vec![0.0; side * (side + 1) / 2] }
    }

    /// Takes in rows of [J | r], whitened and weighted: as many columns as parameters, and the residual last.
    ///
    /// Columns in excess are not looked at; missing ones count as zero.
    #[must_use]
    pub fn with_rows(self, rows: MatRef<'_, f64>) -> Self {
        let side = self.parameters + 1;
        let components = self.components + rows.nrows() as u64;
        let old = if self.components == 0 { 0 } else { side };
        let stacked = Mat::from_fn((old + rows.nrows()).max(side), side, |row, column| {
            if row < old {
                self.at(row, column)
            } else if row - old < rows.nrows() && column < rows.ncols() {
                rows[(row - old, column)]
            } else {
                0.0
            }
        });
        let factored = stacked.qr();
        let factor = factored.thin_R();
        let packed = (0..side).flat_map(|column| (0..=column).map(move |row| (row, column)));
        let packed = packed.map(|(row, column)| factor[(row, column)]).collect();
        Self { parameters: self.parameters, components, packed }
    }

    /// Both together. Partials of different numbers of parameters do not belong together; the first is returned.
    #[must_use]
    pub fn merge(self, other: &Self) -> Self {
        if other.parameters != self.parameters || other.components == 0 {
            return self;
        }
        let components = self.components + other.components;
        let merged = self.with_rows(other.factor().as_ref());
        Self { components, ..merged }
    }

    /// R in full.
    #[must_use]
    pub fn factor(&self) -> Mat<f64> {
        let side = self.parameters + 1;
        Mat::from_fn(side, side, |row, column| self.at(row, column))
    }

    /// The sum of squares of the residual column.
    #[must_use]
    pub fn sum_of_squares(&self) -> f64 {
        (0..=self.parameters).map(|row| self.at(row, self.parameters).powi(2)).sum()
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        if row > column {
            return 0.0;
        }
        self.packed.get(column * (column + 1) / 2 + row).copied().unwrap_or_default()
    }
}

#[cfg(test)]
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
            let merged = first.merge(&second);
            assert_eq!(merged.components, 20);
            let direct = rows.transpose() * &rows;
            for row in 0..3 {
                for column in 0..3 {
                    assert_relative_eq!(gram(&whole)[(row, column)], direct[(row, column)], epsilon = 1e-13);
                    assert_relative_eq!(gram(&merged)[(row, column)], direct[(row, column)], epsilon = 1e-13);
                }
            }
        }
    }
}
