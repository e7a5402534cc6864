//! Exact elimination: which combinations of unknowns a set of linear equations determines.
//!
//! The entries are polynomials in constants. Rows are multiplied across rather than divided, so everything stays a
//! polynomial, and zero is decided by the canonical form. Factors that this brings in are divided out again.

use std::cell::Cell;

use super::modular::{Row, independent};
use crate::algebra::{Poly, Rational};

/// Terms that the entries of one equation may have together.
const TERMS_LIMIT: usize = 20_000;
/// Products of terms that all equations together may take: a second or two.
const WORK_LIMIT: usize = 3_000_000;

/// The entries of an equation grow beyond what can be worked with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooLarge;

/// Rows in reduced echelon form: each has a pivot column in which all the others are zero.
#[derive(Debug, Default)]
pub(super) struct Echelon {
    /// By pivot column.
    rows: Vec<(usize, Row)>,
    /// A column that becomes a pivot only if it must.
    last: Option<usize>,
    /// What the equations took so far, in products of terms.
    work: Work,
}

#[derive(Debug, Default)]
struct Work(Cell<usize>);

impl Work {
    fn spend(&self, products: usize) -> Result<(), TooLarge> {
        self.0.set(self.0.get().saturating_add(products));
        if products > TERMS_LIMIT || self.0.get() > WORK_LIMIT { Err(TooLarge) } else { Ok(()) }
    }
}

impl Echelon {
    /// An echelon in which a column is a pivot only if it depends on no other.
    pub(super) fn with_last(column: usize) -> Self {
        Self { last: Some(column), ..Self::default() }
    }

    /// The rows with their pivots, in order of pivots.
    pub(super) fn rows(&self) -> &[(usize, Row)] {
        &self.rows
    }

    /// Adds equations in so many unknowns: those first that are independent for sure. Each of the others is shown to say
    /// nothing new by what the echelon leaves undetermined; if it does say something, it is added too.
    pub(super) fn insert_all(&mut self, equations: &[Row], unknowns: usize) -> Result<(), TooLarge> {
        let chosen = independent(equations, unknowns);
        for &number in &chosen {
            self.insert(equations[number].clone())?;
        }
        let mut chosen = chosen.into_iter().peekable();
        for (number, equation) in equations.iter().enumerate() {
            if chosen.next_if_eq(&number).is_none() && !self.implies(equation)? {
                self.insert(equation.clone())?;
            }
        }
        Ok(())
    }

    /// Whether an equation holds wherever those of the echelon hold: on every vector with one free unknown at 1, the other
    /// free ones at 0, and each pivot at what its row says.
    fn implies(&self, equation: &Row) -> Result<bool, TooLarge> {
        let is_pivot = |column: usize| self.rows.binary_search_by_key(&column, |(pivot, _)| *pivot).is_ok();
        let mut free: Vec<usize> = equation.iter().map(|(column, _)| *column).collect();
        let pivots = self.rows.iter().filter(|(pivot, _)| entry(equation, *pivot).is_some());
        free.extend(pivots.flat_map(|(_, row)| row.iter().map(|(column, _)| *column)));
        free.sort_unstable();
        free.dedup();
        free.retain(|&column| !is_pivot(column));
        for column in free {
            if !self.vanishes(equation, column)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether `equation` is zero on the vector of one free unknown, over a common denominator.
    fn vanishes(&self, equation: &Row, free: usize) -> Result<bool, TooLarge> {
        let mut numerator = entry(equation, free).cloned().unwrap_or_default();
        let mut denominator = Poly::one();
        for (pivot, row) in &self.rows {
            let (Some(factor), Some(above), Some(below)) =
                (entry(equation, *pivot), entry(row, free), entry(row, *pivot))
            else {
                continue;
            };
            let work = factor.len() * above.len() * denominator.len() + numerator.len() * below.len();
            self.work.spend(work)?;
            // n/d − factor·above/below
            let part = &(factor * above) * &denominator;
            numerator = &(&numerator * below) - &part;
            denominator = &denominator * below;
        }
        Ok(numerator.is_zero())
    }

    /// Adds an equation.
    fn insert(&mut self, mut row: Row) -> Result<(), TooLarge> {
        for (pivot, other) in &self.rows {
            if entry(&row, *pivot).is_some() {
                row = without_factors(eliminated(&row, *pivot, other, &self.work)?, &self.rows);
            }
        }
        // A number as pivot keeps the rest free of denominators; the first column reads best.
        let mut candidates = row.iter().filter(|(column, _)| Some(*column) != self.last);
        let first = candidates.clone().next().or(row.first());
        let number = candidates.find(|(_, entry)| entry.as_constant().is_some());
        let Some(&(pivot, _)) = number.or(first) else { return Ok(()) };
        let row = simplified(row, pivot);
        let earlier = self.rows.clone();
        for (other_pivot, other) in &mut self.rows {
            if entry(other, pivot).is_some() {
                let reduced = without_factors(eliminated(other, pivot, &row, &self.work)?, &earlier);
                *other = simplified(reduced, *other_pivot);
            }
        }
        let place = self.rows.partition_point(|(other, _)| *other < pivot);
        self.rows.insert(place, (pivot, row));
        Ok(())
    }
}

/// The coefficient of a column.
pub(super) fn entry(row: &Row, column: usize) -> Option<&Poly> {
    row.binary_search_by_key(&column, |(column, _)| *column).ok().map(|index| &row[index].1)
}

/// `row` times the pivot of `other`, less `other` times the entry of `row` there.
fn eliminated(row: &Row, pivot: usize, other: &Row, work: &Work) -> Result<Row, TooLarge> {
    let (Some(here), Some(there)) = (entry(row, pivot), entry(other, pivot)) else { return Ok(row.clone()) };
    let size = |row: &Row| row.iter().map(|(_, entry)| entry.len()).sum::<usize>();
    work.spend(size(row) * there.len() + size(other) * here.len())?;
    let mut columns: Vec<usize> = row.iter().chain(other).map(|(column, _)| *column).collect();
    columns.sort_unstable();
    columns.dedup();
    let scaled =
        |row: &Row, column, factor: &Poly| entry(row, column).map_or_else(Poly::zero, |value| value * factor);
    Ok(columns
        .into_iter()
        .filter(|&column| column != pivot)
        .map(|column| (column, &scaled(row, column, there) - &scaled(other, column, here)))
        .filter(|(_, value)| !value.is_zero())
        .collect())
}

/// The row without the polynomials that elimination brings in: the pivots that it was multiplied by, and its own shortest
/// entry, as often as they divide every entry.
fn without_factors(mut row: Row, others: &[(usize, Row)]) -> Row {
    let shortest = row.iter().map(|(_, entry)| entry).min_by_key(|entry| entry.len()).cloned();
    let pivots = others.iter().filter_map(|(pivot, other)| entry(other, *pivot).cloned());
    for factor in shortest.into_iter().chain(pivots).filter(|factor| factor.len() > 1) {
        loop {
            let divided: Option<Row> =
                row.iter().map(|(column, entry)| Some((*column, entry.exact_quotient(&factor)?))).collect();
            match divided {
                Some(divided) if !divided.is_empty() => row = divided,
                _ => break,
            }
        }
    }
    row
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
