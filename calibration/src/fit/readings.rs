//! Readings that are not exact: what they bring into the residuals.

use super::solver::Solver;
use super::sweep::residuals;
use super::{FitError, Model};
use crate::data::Observations;

impl Solver<'_> {
    /// The same model without derivatives.
    pub(super) fn plain(&self) -> &Model {
        self.plain.get_or_init(|| Model::without_columns(self.chain, &self.observations.poses))
    }

    /// Per component the standard deviation, rad or m, that the stated uncertainties of its row's readings bring at some values: each
    /// reading is moved by its own to either side. Empty where all are exact.
    pub(super) fn brought_at(&self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        let stated = &self.observations.reading_sigma;
        if stated.is_empty() {
            return Ok(Vec::new());
        }
        let mut squares = vec![0.0; self.layout.components()];
        for (id, sigma) in stated {
            // A reading that no observable hangs on brings nothing.
            let Some(column) = self.observations.poses.columns.iter().position(|(own, _)| own == id) else {
                continue;
            };
            let pulled = pulled(self.plain(), self.observations, values, column, |row| sigma[row])?;
            squares.iter_mut().zip(pulled).for_each(|(square, pulled)| *square += pulled * pulled);
        }
        Ok(squares.into_iter().map(f64::sqrt).collect())
    }
}

/// What it does to each component of the residual, rad or m, to move its row's reading of a column by so much: half of what moving it
/// to either side does. `model` is one without derivatives.
pub(crate) fn pulled(
    model: &Model,
    observations: &Observations,
    values: &[f64],
    column: usize,
    by: impl Fn(usize) -> f64,
) -> Result<Vec<f64>, FitError> {
    let mut moved = observations.clone();
    let read = &observations.poses.columns[column].1;
    let mut there = |side: f64| {
        let own = moved.poses.columns[column].1.iter_mut().zip(read).enumerate();
        own.for_each(|(row, (to, read))| *to = read + side * by(row));
        residuals(model, &moved, values)
    };
    let (more, less) = (there(1.0)?, there(-1.0)?);
    Ok(more.iter().zip(less).map(|(more, less)| 0.5 * (more - less)).collect())
}
