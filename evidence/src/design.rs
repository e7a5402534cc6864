//! The columns of a dictionary at a point, made block by block from functions and places, never held as a whole.

use faer::Mat;

use crate::algebra::column_mut;
use crate::families::Dictionary;
use crate::function::Function;
use crate::places::Places;
use crate::point::Point;
use crate::problem::{Place, Rows};

/// Each column as products of a place's column with a table of function values.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    /// Values of each function in each row.
    values: Vec<Vec<f64>>,
    /// The functions, with the place where their values hang on it.
    known: Vec<(Option<usize>, Function)>,
    /// Terms of each column: distinct place, function.
    columns: Vec<Vec<(usize, usize)>>,
}

impl Table {
    /// Adds the columns that a dictionary has gained.
    pub fn extend(&mut self, dictionary: &Dictionary, rows: &Rows, places: &Places, given: &[Place]) {
        for column in &dictionary.columns[self.columns.len()..] {
            let mut terms = Vec::with_capacity(column.terms.len());
            for (place, function) in &column.terms {
                let own = function.of_the_place().then_some(*place);
                let found = self.known.iter().position(|(at, known)| *at == own && known == function);
                let at = found.unwrap_or_else(|| {
                    self.values.push(function.values(rows, &given[places.distinct[*place].place]));
                    self.known.push((own, function.clone()));
                    self.values.len() - 1
                });
                terms.push((*place, at));
            }
            self.columns.push(terms);
        }
    }

    /// Number of columns of the dictionary.
    pub fn count(&self) -> usize {
        self.columns.len()
    }

    /// One column of the dictionary over a range of rows.
    pub fn column(&self, point: &Point, column: usize, rows: std::ops::Range<usize>, into: &mut [f64]) {
        let components = into.len() / rows.len().max(1);
        into.fill(0.0);
        for &(place, function) in &self.columns[column] {
            let moved = &point.places[place][rows.start * components..rows.end * components];
            let values = &self.values[function][rows.clone()];
            for ((into, moved), value) in
                into.chunks_exact_mut(components).zip(moved.chunks_exact(components)).zip(values)
            {
                for (into, moved) in into.iter_mut().zip(moved) {
                    *into += moved * value;
                }
            }
        }
    }

    /// The amount that a column adds in each row at each of its places, for a coefficient of one.
    pub fn amounts(&self, column: usize) -> impl Iterator<Item = (usize, &[f64])> {
        self.columns[column].iter().map(|&(place, function)| (place, self.values[function].as_slice()))
    }

    /// Number of columns of residual, declared errors and dictionary together.
    pub fn width(&self, point: &Point) -> usize {
        1 + point.declared.len() + self.count()
    }

    /// Any of all columns by its number in [y J Z], over a range of rows.
    pub fn any(&self, point: &Point, number: usize, rows: std::ops::Range<usize>, into: &mut [f64]) {
        let components = into.len() / rows.len().max(1);
        let part = rows.start * components..rows.end * components;
        let declared = point.declared.len();
        match number {
            0 => into.copy_from_slice(&point.residual[part]),
            _ if number <= declared => into.copy_from_slice(&point.declared[number - 1][part]),
            _ => self.column(point, number - 1 - declared, rows, into),
        }
    }

    /// Some of all columns as a matrix over all rows.
    pub fn some(&self, point: &Point, numbers: &[usize], rows: usize) -> Mat<f64> {
        let mut matrix = Mat::zeros(point.residual.len(), numbers.len());
        for (at, &number) in numbers.iter().enumerate() {
            self.any(point, number, 0..rows, column_mut(&mut matrix, at));
        }
        matrix
    }
}
