//! What the same declaration predicts of rows that its fit did not see: the fit is its optimum without them.
//!
//! One step leads there from the fit of all rows, in whitened combinations, and the exact chain is evaluated behind it. Where the step
//! is too long for that, the rows that stay are fitted anew. What they do not show stands at its nominal value, whatever the
//! rows left out say of it.

use faer::{Mat, Side};
use model_core::Chain;

use crate::limits::{NOT_LEFT, SHORT, UNSEEN};
use crate::search::SearchError;
use crate::search::columns::Columns;
use fit::noise::{Layout, NoiseOptions};
use fit::{FitOptions, FitResult, Model, fit, residuals};
use observe::Observations;

/// A fit from which parts of its rows are taken out.
pub(super) struct Without<'a> {
    chain: &'a Chain,
    observations: &'a Observations,
    options: &'a FitOptions,
    fit: &'a FitResult,
    layout: Layout,
    plain: Model,
    /// Of every symbol at the fit.
    values: Vec<f64>,
    /// Whitened and weighted residuals at the fit.
    residual: Vec<f64>,
    /// Orthonormal columns of what is shown.
    shown: Mat<f64>,
    /// Their products with each other over all rows, and with the residual: a part is taken out of these.
    gram: Mat<f64>,
    score: Vec<f64>,
    /// From those to parameters, p × k, SI.
    back: Mat<f64>,
    /// The nominal values seen from the fit, as those combinations.
    nominal: Vec<f64>,
}

impl<'a> Without<'a> {
    pub fn of(
        chain: &'a Chain,
        observations: &'a Observations,
        options: &'a FitOptions,
        fit: &'a FitResult,
    ) -> Result<Self, SearchError> {
        let values = values_of(chain, fit);
        let columns = Columns::at(chain, observations, &fit.parameters, &values, &[])?;
        let layout = Layout::of(observations);
        let root: Vec<f64> = layout.row_of_each().map(|row| fit.residuals.weight[row].sqrt()).collect();
        let white = |values: &mut [f64]| {
            fit.noise.whiten(values);
            values.iter_mut().zip(&root).for_each(|(value, root)| *value *= root);
        };
        let mut residual = columns.residual;
        white(&mut residual);
        let mut matrix = columns.declared;
        let p = matrix.ncols();
        let mut scale = vec![1.0; p];
        for (at, scale) in scale.iter_mut().enumerate() {
            let own = matrix.col_as_slice_mut(at);
            white(own);
            let length = own.iter().map(|value| value * value).sum::<f64>().sqrt();
            if length > 0.0 && length.is_finite() {
                *scale = length;
                own.iter_mut().for_each(|value| *value /= length);
            } else {
                own.fill(0.0);
            }
        }
        let gram = matrix.transpose() * &matrix;
        let (squares, vectors) = symmetric(&gram);
        let largest = squares.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> = (0..p).filter(|&at| squares[at] > UNSEEN * UNSEEN * largest).collect();
        let root_of = |at: usize| squares[kept[at]].sqrt();
        let k = kept.len();
        let back = Mat::from_fn(p, k, |row, at| vectors[(row, kept[at])] / root_of(at) / scale[row]);
        let shown = &matrix * Mat::from_fn(p, k, |row, at| vectors[(row, kept[at])] / root_of(at));
        let score =
            (0..k).map(|at| shown.col_as_slice(at).iter().zip(&residual).map(|(a, b)| a * b).sum::<f64>());
        let score = score.collect();
        let start = chain.nominal_values();
        let away: Vec<f64> =
            fit.parameters.iter().map(|id| start[id.index()] - fit.values[id.index()]).collect();
        let nominal = (0..k)
            .map(|at| {
                let parts = (0..p).map(|row| vectors[(row, kept[at])] * scale[row] * away[row]);
                root_of(at) * parts.sum::<f64>()
            })
            .collect();
        Ok(Self {
            chain,
            observations,
            options,
            fit,
            plain: Model::without_columns(chain, &observations.poses),
            gram: shown.transpose() * &shown,
            score,
            shown,
            layout,
            values,
            residual,
            back,
            nominal,
        })
    }

    /// What each row leaves, of every part of the rows as a fit of the others has it: measured minus predicted, component by component.
    pub fn each(&self, part_of: impl Fn(usize) -> usize, parts: usize) -> Result<Vec<f64>, SearchError> {
        let mut left = self.fit.residuals.raw.clone();
        for part in 0..parts {
            let is_out = |row: usize| part_of(row) == part;
            let own = self.residuals(&is_out)?;
            for row in (0..self.layout.rows()).filter(|&row| is_out(row)) {
                let components = self.layout.of_rows(row..row + 1);
                left[components.clone()].copy_from_slice(&own[components]);
            }
        }
        Ok(left)
    }

    /// The residuals of all rows by a fit without some.
    fn residuals(&self, is_out: &dyn Fn(usize) -> bool) -> Result<Vec<f64>, SearchError> {
        let stays: Vec<bool> = self.layout.row_of_each().map(|row| !is_out(row)).collect();
        let step = self.step(&stays);
        let mut values = self.values.clone();
        for (at, id) in self.fit.parameters.iter().enumerate() {
            values[id.index()] += (0..step.len()).map(|own| self.back[(at, own)] * step[own]).sum::<f64>();
        }
        let found = residuals(&self.plain, self.observations, &values)?;
        if self.is_short(&step, &found, &stays) {
            return Ok(found);
        }
        let rows: Vec<usize> = (0..self.layout.rows()).filter(|&row| !is_out(row)).collect();
        let noise = NoiseOptions { variance: false, serial: false, ..self.options.noise.by_residuals() };
        let options =
            FitOptions { start: self.values.clone(), other_starts: false, noise, ..self.options.clone() };
        let anew = fit(self.chain, &self.observations.select(&rows), &options)?;
        if !anew.outcome.is_usable() {
            return Ok(found);
        }
        Ok(residuals(&self.plain, self.observations, &anew.values)?)
    }

    /// The step from the fit of all rows to that of those that stay.
    fn step(&self, stays: &[bool]) -> Vec<f64> {
        let k = self.shown.ncols();
        let mut gram = self.gram.clone();
        let mut score = self.score.clone();
        for (at, _) in stays.iter().enumerate().filter(|(_, stays)| !**stays) {
            for i in 0..k {
                let own = self.shown[(at, i)];
                score[i] -= own * self.residual[at];
                for j in 0..=i {
                    gram[(i, j)] -= own * self.shown[(at, j)];
                }
            }
        }
        let (values, vectors) = symmetric(&gram);
        let mut step = vec![0.0; k];
        for at in 0..k {
            let along = |values: &[f64]| (0..k).map(|own| vectors[(own, at)] * values[own]).sum::<f64>();
            let size = if values[at] > NOT_LEFT { along(&score) / values[at] } else { along(&self.nominal) };
            step.iter_mut().enumerate().for_each(|(own, step)| *step += vectors[(own, at)] * size);
        }
        step
    }

    /// Whether the chain does to the rows that stay what a step foretells.
    fn is_short(&self, step: &[f64], found: &[f64], stays: &[bool]) -> bool {
        let mut white = found.to_vec();
        self.fit.noise.whiten(&mut white);
        let (mut off, mut squares) = (0.0, 0.0);
        for (at, row) in self.layout.row_of_each().enumerate().filter(|(at, _)| stays[*at]) {
            let own = white[at] * self.fit.residuals.weight[row].sqrt();
            let change: f64 = (0..step.len()).map(|own| self.shown[(at, own)] * step[own]).sum();
            off += (own - (self.residual[at] - change)).powi(2);
            squares += self.residual[at].powi(2);
        }
        off <= SHORT * squares
    }
}

/// The values of a fit for a chain that has perhaps taken up further symbols behind those of the fit: ramps of functions to search for.
pub(super) fn values_of(chain: &Chain, fit: &FitResult) -> Vec<f64> {
    let mut values = fit.values.clone();
    values.extend(chain.nominal_values().into_iter().skip(values.len()));
    values
}

/// Eigenvalues and eigenvectors of a symmetric matrix, of which the lower half is read; none of either where it has numbers that are none.
fn symmetric(matrix: &Mat<f64>) -> (Vec<f64>, Mat<f64>) {
    let k = matrix.ncols();
    match matrix.self_adjoint_eigen(Side::Lower) {
        Ok(found) => {
            let values = found.S().column_vector();
            ((0..k).map(|at| values[at]).collect(), found.U().to_owned())
        }
        Err(_) => (vec![0.0; k], Mat::identity(k, k)),
    }
}
