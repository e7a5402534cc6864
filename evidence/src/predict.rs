//! A posterior carried to new rows.

use faer::Mat;

use crate::average::Moments;
use crate::bench::Bench;
use crate::design::Table;
use crate::likelihood::Posterior;
use crate::linearise::{Amount, Linearisation};
use crate::outcome::NewRows;

impl Bench<'_> {
    /// Moments of the correction at new rows as a function of a posterior.
    pub(crate) fn new_moments(&self, new: &NewRows, told: usize) -> impl Fn(&Posterior, usize) -> Moments {
        let values = new.places.first().map_or(0, |place| place.column.len());
        let given = Linearisation {
            residual: vec![0.0; values],
            declared: new.declared.clone(),
            places: new.places.iter().map(|place| place.column.clone()).collect(),
        };
        // New rows have no stated uncertainty: their columns come without weights.
        let plain = crate::point::Scaling { stated: vec![1.0; values], ..self.scaling.clone() };
        let point = plain.point(&self.places, &given, Vec::new());
        let mut table = Table::default();
        table.extend(&self.dictionary, &new.rows, &self.places, &new.places);
        let rows = new.rows.count;
        let unit = self.scaling.unit;
        let inside = self.points[told].inside.clone();
        let first = 1 + point.declared.len();
        move |posterior, _| {
            let numbered: Vec<usize> =
                (0..posterior.columns.len()).filter(|&at| posterior.columns[at] != usize::MAX).collect();
            let numbers: Vec<usize> = numbered.iter().map(|&at| posterior.columns[at]).collect();
            let columns = table.some(&point, &numbers, rows);
            let mut moments = Moments { mean: vec![0.0; values], variance: vec![0.0; values] };
            let shape = Mat::from_fn(numbered.len(), numbered.len(), |i, j| {
                posterior.shape[(numbered[i], numbered[j])]
            });
            let spread = &columns * shape;
            for row in 0..values {
                let mut variance = 0.0;
                for (i, &a) in numbered.iter().enumerate() {
                    moments.mean[row] += unit * columns[(row, i)] * posterior.mean[a];
                    variance += columns[(row, i)] * spread[(row, i)];
                }
                moments.variance[row] = variance * posterior.variance * unit * unit;
            }
            // What is in the exact chain already is no part of the correction.
            let held: Vec<usize> = inside.iter().map(|(column, _)| first + column).collect();
            let held_columns = table.some(&point, &held, rows);
            for (at, (_, coefficient)) in inside.iter().enumerate() {
                for row in 0..values {
                    moments.mean[row] -= unit * coefficient * held_columns[(row, at)];
                }
            }
            moments
        }
    }

    /// Amounts of effects given by coefficients of columns, over the rows of a table, in the chain's units.
    pub(crate) fn amounts_of(&self, table: &Table, coefficients: &[(usize, f64)]) -> Vec<Amount> {
        let mut amounts: Vec<Amount> = Vec::new();
        for &(column, coefficient) in coefficients {
            for (place, values) in table.amounts(column) {
                let place = self.places.distinct[place].place;
                let at = amounts.iter().position(|known| known.place == place).unwrap_or_else(|| {
                    amounts.push(Amount { place, amount: vec![0.0; values.len()] });
                    amounts.len() - 1
                });
                for (sum, value) in amounts[at].amount.iter_mut().zip(values) {
                    *sum += coefficient * self.scaling.unit * value;
                }
            }
        }
        amounts
    }
}
