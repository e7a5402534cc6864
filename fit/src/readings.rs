//! Readings that are not exact: what they bring into the residuals.

use model_core::SymbolId;

use super::solver::Solver;
use super::sweep::residuals;
use super::{FitError, Model};
use observe::Observations;

impl Solver<'_> {
    /// The same model without derivatives.
    pub(super) fn plain(&self) -> &Model {
        self.plain.get_or_init(|| Model::without_columns(self.chain, &self.observations.poses))
    }

    /// Per component the standard deviation, rad or m, that the stated uncertainties of its row's readings bring at some values: each
    /// reading is moved by its own to either side. Empty where all are exact.
    pub(super) fn brought_at(&self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        if self.observations.reading_sigma.is_empty() {
            return Ok(Vec::new());
        }
        let mut squares = vec![0.0; self.layout.components()];
        let pulls = pulls(self.plain(), self.observations, values, 1.0)?;
        for pull in &pulls {
            squares.iter_mut().zip(&pull.pulled).for_each(|(square, pulled)| *square += pulled * pulled);
        }
        for (one, other, correlation) in correlated(self.observations, &pulls) {
            let both = pulls[one].pulled.iter().zip(&pulls[other].pulled).zip(self.layout.row_of_each());
            for (square, ((one, other), row)) in squares.iter_mut().zip(both) {
                *square += 2.0 * correlation[row] * one * other;
            }
        }
        // What readings that are off together bring may cancel, to rounding.
        Ok(squares.into_iter().map(|square| square.max(0.0).sqrt()).collect())
    }
}

/// An uncertain reading and what it brings.
pub struct Pull<'a> {
    id: SymbolId,
    /// Which column of the poses holds the reading.
    pub column: usize,
    /// Its standard uncertainty, one value a row.
    pub sigma: &'a [f64],
    /// What it does to each component of the residual to be off by it, times a factor, rad or m.
    pub pulled: Vec<f64>,
}

/// What uncertain readings bring that any observable hangs on, at some values, as uncertain as `factor` times what is stated.
pub fn pulls<'a>(
    model: &Model,
    observations: &'a Observations,
    values: &[f64],
    factor: f64,
) -> Result<Vec<Pull<'a>>, FitError> {
    let of = |(id, sigma): &'a (SymbolId, Vec<f64>)| {
        let column = observations.poses.columns.iter().position(|(own, _)| own == id)?;
        let pulled = pulled(model, observations, values, column, |row| factor * sigma[row]);
        Some(pulled.map(|pulled| Pull { id: *id, column, sigma, pulled }))
    };
    observations.reading_sigma.iter().filter_map(of).collect()
}

/// Which of them are off together, by their numbers, and how, row by row.
pub fn correlated<'a>(observations: &'a Observations, pulls: &[Pull<'_>]) -> Vec<(usize, usize, &'a [f64])> {
    let number = |id| pulls.iter().position(|pull| pull.id == id);
    let pairs = observations.reading_correlation.iter();
    pairs.filter_map(|([one, other], own)| Some((number(*one)?, number(*other)?, own.as_slice()))).collect()
}

/// What it does to each component of the residual, rad or m, to move its row's reading of a column by so much: half of what moving it
/// to either side does. `model` is one without derivatives.
pub fn pulled(
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
