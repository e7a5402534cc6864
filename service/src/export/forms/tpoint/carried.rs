//! Which errors of a mount are terms of TPOINT, and what the terms come to.
//!
//! An error is carried where its first-order column is a sum of terms as functions of the readings, which the canonical form decides;
//! only constants have their values then.

use std::collections::BTreeMap;

use effects::catalogue::PointingTerms;
use model_core::algebra::{BasisFunction, Poly};
use model_core::forms::Form;
use model_core::{SymbolId, SymbolKind};
use nalgebra::{DMatrix, DVector};

use super::Subject;

/// A column is a sum of others if less than this part of it is left.
const SAME: f64 = 1e-9;

/// The terms of an instrument.
pub struct Carried {
    /// Those that have a part in it, in the order of all terms.
    pub values: Vec<Value>,
    /// Errors that are no sum of terms.
    pub lost: Vec<SymbolId>,
}

/// A term with its value.
pub struct Value {
    /// Which of all terms.
    pub term: usize,
    /// rad
    pub value: f64,
    /// Its standard uncertainty, rad, where the instrument has one.
    pub uncertainty: Option<f64>,
    /// Whether the data determine each error in it.
    pub is_determined: bool,
}

/// Functions of the readings, each of one component, in the order in which they were met.
type Functions = BTreeMap<(usize, BasisFunction), usize>;

/// What the errors of an instrument come to as terms; `form` is its first order.
pub fn carried(subject: &Subject, terms: &PointingTerms, form: &Form) -> Carried {
    let chain = &subject.chain;
    let values = subject.without_errors();
    let moves = |id: SymbolId| {
        matches!(
            chain.symbol(id).kind,
            SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle
        )
    };
    let mut functions = Functions::new();
    let mut sparse = |change: &[Poly; 2]| -> Vec<(usize, f64)> {
        let parts = change.iter().enumerate().flat_map(|(at, part)| {
            part.split_by(moves).into_iter().map(move |(function, beside)| ((at, function), beside))
        });
        parts
            .map(|(key, beside)| {
                let next = functions.len();
                (*functions.entry(key).or_insert(next), beside.eval(&values))
            })
            .collect()
    };
    let of_terms: Vec<_> = terms.terms.iter().map(|term| sparse(&term.change)).collect();
    let errors: Vec<(SymbolId, Vec<(usize, f64)>)> = form
        .columns(chain)
        .into_iter()
        .filter(|(error, _)| subject.values[error.index()] != 0.0)
        .map(|(error, column)| (error, sparse(&terms.parts(&column))))
        .collect();
    let rows = functions.len();
    let dense = |column: &[(usize, f64)]| {
        let mut own = DVector::zeros(rows);
        column.iter().for_each(|(row, value)| own[*row] += value);
        own
    };
    let (kept, basis) = independent(&of_terms.iter().map(|column| dense(column)).collect::<Vec<_>>());
    let (orthogonal, triangle) = basis.qr().unpack();
    let (mut parts, mut lost) = (Vec::new(), Vec::new());
    for (error, column) in &errors {
        let column = dense(column);
        let seen = orthogonal.transpose() * &column;
        let left = (&column - &orthogonal * &seen).norm();
        match triangle.solve_upper_triangular(&seen) {
            Some(part) if left <= SAME * column.norm() => parts.push((*error, part)),
            _ => lost.push(*error),
        }
    }
    let mut all: Vec<Value> = kept
        .iter()
        .enumerate()
        .filter_map(|(at, &term)| {
            let largest = parts.iter().map(|(_, part)| part.amax()).fold(0.0, f64::max);
            let own = parts.iter().map(|(error, part)| (*error, part[at]));
            let own: Vec<(SymbolId, f64)> = own.filter(|(_, factor)| factor.abs() > SAME * largest).collect();
            if own.is_empty() { None } else { Some(value(subject, term, &own)) }
        })
        .collect();
    all.sort_by_key(|value| value.term);
    Carried { values: all, lost }
}

/// A term that is a sum of errors, each times a number.
fn value(subject: &Subject, term: usize, parts: &[(SymbolId, f64)]) -> Value {
    let value = parts.iter().map(|(error, factor)| factor * subject.values[error.index()]).sum();
    let Some(covariance) = &subject.covariance else {
        return Value { term, value, uncertainty: None, is_determined: true };
    };
    let place = |error: SymbolId| covariance.of.iter().position(|own| *own == error);
    let estimated: Vec<(usize, f64)> =
        parts.iter().filter_map(|(error, factor)| Some((place(*error)?, *factor))).collect();
    let mut variance = 0.0;
    for (row, a) in &estimated {
        variance += estimated.iter().map(|(column, b)| a * b * covariance.rows[*row][*column]).sum::<f64>();
    }
    let is_determined = parts.iter().all(|(error, _)| !covariance.undetermined.contains(error));
    Value { term, value, uncertainty: Some(variance.max(0.0).sqrt()), is_determined }
}

/// The columns that are no sum of those before them: their places, and themselves.
fn independent(columns: &[DVector<f64>]) -> (Vec<usize>, DMatrix<f64>) {
    let (mut kept, mut units): (Vec<usize>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
    for (at, column) in columns.iter().enumerate() {
        let mut left = column.clone();
        // Twice: what rounding left of the first time goes, too.
        for _ in 0..2 {
            for unit in &units {
                let along = unit.dot(&left);
                left -= unit * along;
            }
        }
        if left.norm() > SAME * column.norm() {
            units.push(left.normalize());
            kept.push(at);
        }
    }
    let own: Vec<DVector<f64>> = kept.iter().map(|at| columns[*at].clone()).collect();
    let rows = columns.first().map_or(0, DVector::len);
    (kept, if own.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(&own) })
}
