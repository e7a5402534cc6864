//! What can be told apart at the declared values of the constants: exact arithmetic at random rational poses, where formulas
//! over all values of the constants are too large.
//!
//! A new pose adds to what is determined unless everything that any pose shows is determined already; so poses are taken until
//! some in a row add nothing. That an error or a combination is determined, and that two errors are not one, is thereby proven
//! for these values. That more poses would show no more is certain but for a chance of less than one in 10¹⁵.

use super::columns::Evaluator;
use super::pair::Pair;
use super::place::Place;
use super::{IdentifyError, Quotient, Ratio};
use crate::algebra::Poly;
use crate::chain::{Chain, ObservableId};
use crate::symbol::SymbolId;

/// Poses in a row that show nothing new before no more are asked.
const IDLE: usize = 4;
/// Poses in a row at a pole before there is no answer.
const POLES: usize = 50;

/// Equations in reduced echelon form, with the poses that they came from.
pub(super) struct AtValues {
    /// By pivot column.
    pub(super) rows: Vec<(usize, Vec<Pair>)>,
    pub(super) poses: usize,
}

impl AtValues {
    /// The equations of observables seen together.
    pub(super) fn new(
        chain: &Chain,
        observables: &[ObservableId],
        errors: &[SymbolId],
    ) -> Result<Self, IdentifyError> {
        let evaluators: Vec<Evaluator> = observables
            .iter()
            .map(|&observable| Evaluator::new(chain, observable, errors))
            .collect::<Result<_, _>>()?;
        let mut equations = Vec::new();
        let mut known = Known::default();
        let (mut poses, mut idle, mut poles) = (0, 0, 0);
        for number in 1.. {
            if idle == IDLE || known.rows.len() == errors.len() {
                break;
            }
            let place = Place::new(chain, number);
            let rows: Option<Vec<Vec<Vec<Pair>>>> = evaluators.iter().map(|one| one.rows(&place)).collect();
            let Some(rows) = rows else {
                poles += 1;
                if poles == POLES {
                    return Err(IdentifyError::Poles);
                }
                continue;
            };
            poles = 0;
            poses += 1;
            let mut is_new = false;
            for row in rows.into_iter().flatten() {
                if known.learns(&row) {
                    is_new = true;
                    equations.push(row);
                }
            }
            idle = if is_new { 0 } else { idle + 1 };
        }
        Ok(Self { rows: reduced(equations, errors.len()), poses })
    }
}

/// Which equations say something new: an echelon without float arithmetic in mind.
#[derive(Default)]
struct Known {
    rows: Vec<(usize, Vec<Pair>)>,
}

impl Known {
    fn learns(&mut self, row: &[Pair]) -> bool {
        let mut row = row.to_vec();
        for (pivot, other) in &self.rows {
            eliminate(&mut row, *pivot, other);
        }
        let Some(pivot) = row.iter().position(|value| !value.is_zero()) else { return false };
        divide(&mut row, pivot);
        self.rows.push((pivot, row));
        true
    }
}

/// Independent equations in reduced echelon form; of the rows that could give a pivot the one with the largest value, so that
/// the floats beside the residues keep their digits.
fn reduced(mut equations: Vec<Vec<Pair>>, unknowns: usize) -> Vec<(usize, Vec<Pair>)> {
    let mut rows: Vec<(usize, Vec<Pair>)> = Vec::new();
    for column in 0..unknowns {
        let size = |row: &Vec<Pair>| row[column].value().abs();
        let candidates = equations.iter().enumerate().filter(|(_, row)| !row[column].is_zero());
        let largest = candidates.max_by(|(_, a), (_, b)| size(a).total_cmp(&size(b)));
        let Some((place, _)) = largest else { continue };
        let mut row = equations.swap_remove(place);
        divide(&mut row, column);
        for other in equations.iter_mut().chain(rows.iter_mut().map(|(_, other)| other)) {
            eliminate(other, column, &row);
        }
        rows.push((column, row));
    }
    rows
}

fn divide(row: &mut [Pair], pivot: usize) {
    let Some(inverse) = row[pivot].inverse() else { unreachable!("a pivot is not zero") };
    for value in row {
        *value = value.times(inverse);
    }
}

/// Takes as much of another row, which has one at its pivot, as makes the entry there zero.
fn eliminate(row: &mut [Pair], pivot: usize, other: &[Pair]) {
    let factor = row[pivot];
    if !factor.is_zero() {
        for (value, other) in row.iter_mut().zip(other) {
            if !other.is_zero() {
                *value = value.minus(factor.times(*other));
            }
        }
    }
}

impl Quotient for Pair {
    fn one() -> Self {
        Self::ONE
    }

    fn over(&self, other: &Self) -> Self {
        match other.inverse() {
            Some(inverse) => self.times(inverse),
            None => unreachable!("the parts of a column are not zero"),
        }
    }

    fn equals(&self, other: &Self) -> bool {
        Pair::equals(*self, *other)
    }

    fn ratio(&self) -> Ratio {
        Ratio { numerator: Poly::constant(self.to_rational()), denominator: Poly::one() }
    }
}
