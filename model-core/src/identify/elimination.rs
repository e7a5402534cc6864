//! Exact elimination: which combinations of unknowns a set of linear equations determines.
//!
//! The entries are polynomials in constants. Rows are multiplied across rather than divided, so everything stays a
//! polynomial, and zero is decided by the canonical form.

use crate::algebra::{Poly, Rational};

/// A linear combination of unknowns: columns in order, no coefficient zero.
pub(super) type Row = Vec<(usize, Poly)>;

/// Rows in reduced echelon form: each has a pivot column in which all the others are zero.
#[derive(Debug, Default)]
pub(super) struct Echelon {
    /// By pivot column.
    rows: Vec<(usize, Row)>,
    /// A column that becomes a pivot only if it must.
    last: Option<usize>,
}

impl Echelon {
    /// An echelon in which a column is a pivot only if it depends on no other.
    pub(super) fn with_last(column: usize) -> Self {
        Self { rows: Vec::new(), last: Some(column) }
    }

    /// The rows with their pivots, in order of pivots.
    pub(super) fn rows(&self) -> &[(usize, Row)] {
        &self.rows
    }

    /// Adds an equation.
    pub(super) fn insert(&mut self, mut row: Row) {
        for (pivot, other) in &self.rows {
            row = eliminated(&row, *pivot, other);
        }
        // A number as pivot keeps the rest free of denominators; the first column reads best.
        let mut candidates = row.iter().filter(|(column, _)| Some(*column) != self.last);
        let first = candidates.clone().next().or(row.first());
        let number = candidates.find(|(_, entry)| entry.as_constant().is_some());
        let Some(&(pivot, _)) = number.or(first) else { return };
        let row = simplified(row, pivot);
        for (other_pivot, other) in &mut self.rows {
            *other = simplified(eliminated(other, pivot, &row), *other_pivot);
        }
        let place = self.rows.partition_point(|(other, _)| *other < pivot);
        self.rows.insert(place, (pivot, row));
    }
}

/// The coefficient of a column.
pub(super) fn entry(row: &Row, column: usize) -> Option<&Poly> {
    row.binary_search_by_key(&column, |(column, _)| *column).ok().map(|index| &row[index].1)
}

/// `row` times the pivot of `other`, less `other` times the entry of `row` there.
fn eliminated(row: &Row, pivot: usize, other: &Row) -> Row {
    let (Some(here), Some(there)) = (entry(row, pivot), entry(other, pivot)) else { return row.clone() };
    let mut columns: Vec<usize> = row.iter().chain(other).map(|(column, _)| *column).collect();
    columns.sort_unstable();
    columns.dedup();
    let scaled =
        |row: &Row, column, factor: &Poly| entry(row, column).map_or_else(Poly::zero, |value| value * factor);
    columns
        .into_iter()
        .filter(|&column| column != pivot)
        .map(|column| (column, &scaled(row, column, there) - &scaled(other, column, here)))
        .filter(|(_, value)| !value.is_zero())
        .collect()
}

/// The row with common factors taken out, as far as they are seen, and a pivot that starts with one.
fn simplified(row: Row, pivot: usize) -> Row {
    let Some(value) = entry(&row, pivot) else { return row };
    if row.len() == 1 {
        return vec![(pivot, Poly::one())];
    }
    // Dividing by the whole pivot is best where the algebra can: a number, or sines and cosines of constants.
    let factor = value.recip().unwrap_or_else(|| {
        let leading = value.terms().next().and_then(|term| term.coefficient.recip());
        Poly::constant(leading.unwrap_or(Rational::ONE))
    });
    let row: Row = row.into_iter().map(|(column, value)| (column, &value * &factor)).collect();
    let common = row.iter().map(|(_, value)| value.monomial_content()).reduce(|a, b| {
        a.into_iter()
            .filter_map(|(symbol, n)| {
                b.iter().find(|(other, _)| *other == symbol).map(|&(_, m)| (symbol, n.min(m)))
            })
            .collect()
    });
    let common = common.unwrap_or_default();
    row.into_iter().map(|(column, value)| (column, value.without_monomial(&common))).collect()
}
