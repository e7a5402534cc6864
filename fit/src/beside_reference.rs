//! Errors of a chain and inputs of the reference, fitted together.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::reference::{AXES, Followed, FromReference, Inputs, Moved, Reference};
use super::solver::{Course, Solver};
use super::sweep::residuals;
use super::{FitError, FitOptions, FitResult, Model};
use model_core::Chain;
use observe::Observations;

/// By how much an input is moved to either side: a share, rad or m.
const STEP: f64 = 1e-6;

/// Fits at most, the first without anything known of the inputs.
const FITS: usize = 5;

/// Inputs that change by less, in their standard uncertainties, end the fits.
const SETTLED: f64 = 0.01;

/// The least noise that inputs are weighed against, of variances, over what whitens the rows: data without any still have one answer.
const LEAST_NOISE: f64 = 1e-9;

/// Fits errors and inputs together.
pub(super) fn fit_beside(
    model: Model,
    chain: &Chain,
    observations: &Observations,
    options: &FitOptions,
    reference: &Reference,
) -> Result<FitResult, FitError> {
    if observations.unknowns.is_some() {
        return Err(FitError::ReferenceOfObjects);
    }
    let mut inputs = Inputs::of(observations, reference)?;
    let (mut own, mut options) = (observations.clone(), options.clone());
    let mut fits = 1;
    loop {
        let mut solver = Solver::new(model.clone(), chain, &own, &options);
        solver.inputs = Some(inputs.clone());
        let course = solver.brought_down()?;
        let (_, weight) = solver.norms_and_weights(&course);
        let Some(Followed { found, used, .. }) = solver.beside_inputs(&course, &weight)? else {
            return solver.result(course);
        };
        let change = found.iter().zip(&inputs.found).map(|(new, old)| (new - old).abs());
        if fits == FITS || change.fold(0.0, f64::max) < SETTLED && (used - inputs.used).abs() < SETTLED {
            return solver.result(course);
        }
        fits += 1;
        (inputs.found, inputs.used) = (found, used);
        let start = course.point.values;
        drop(solver);
        own = inputs.taken_from(observations);
        options.start = start;
    }
}

impl Solver<'_> {
    /// What the inputs do at the end of a course; none where there are none, or nothing is determined.
    pub(super) fn beside_inputs(
        &self,
        course: &Course,
        weight: &[f64],
    ) -> Result<Option<Followed>, FitError> {
        let Some(inputs) = &self.inputs else { return Ok(None) };
        let root = course.subspace.covariance_root(&self.partial(&course.point.sweep), &course.point.rest);
        let own = self.coordinates(course, weight, &root)?;
        let (q, residual) = (own.q, own.residual);
        let (k, m) = (q.ncols(), inputs.found.len());
        // What a standard uncertainty of each does, whitened and weighed as the rows are.
        let mut common = Vec::new();
        for &(_, moved, sigma) in &inputs.common {
            common.push(self.moves(course, weight, moved, sigma)?);
        }
        let mut of_targets = Vec::new();
        if inputs.targets > 0 {
            for axis in AXES {
                of_targets.push(self.moves(course, weight, Moved::Shifted(axis), inputs.targets_m)?);
            }
        }
        let (mut b, mut gram, mut score) =
            (Mat::<f64>::zeros(k, m), Mat::<f64>::zeros(m, m), Mat::<f64>::zeros(m, 1));
        for (at, row) in self.layout.row_of_each().enumerate() {
            let mut entries: Vec<(usize, f64)> =
                common.iter().enumerate().map(|(own, column)| (own, column[at])).collect();
            if let Some(target) = inputs.target_of[row] {
                let first = common.len() + 3 * target;
                entries
                    .extend(of_targets.iter().enumerate().map(|(axis, column)| (first + axis, column[at])));
            }
            for &(one, value) in &entries {
                (0..k).for_each(|j| b[(j, one)] += q[(at, j)] * value);
                entries.iter().for_each(|&(other, more)| gram[(one, other)] += value * more);
                score[(one, 0)] += value * residual[at];
            }
        }
        let along = q.transpose() * Mat::from_fn(residual.len(), 1, |at, _| residual[at]);
        let noise = self.noise_beside(course, weight);
        let shown = (gram - b.transpose() * &b) * faer::Scale(1.0 / noise);
        let before = Mat::from_fn(m, 1, |at, _| inputs.found[at]);
        let score = (score - b.transpose() * along) * faer::Scale(1.0 / noise) - &before;
        if !shown.as_ref().is_all_finite() {
            return Err(FitError::ReferenceTooLarge);
        }
        let Ok(factor) = (&shown + Mat::<f64>::identity(m, m)).llt(Side::Lower) else {
            return Err(FitError::ReferenceTooLarge);
        };
        let inverse = factor.solve(Mat::<f64>::identity(m, m));
        let step = &inverse * score;
        // Of each input the share that the rows do not show stays with the errors.
        let followed = &root * b * &inverse;
        let parts = inputs.kinds().into_iter().map(|(input, sigma, places)| FromReference {
            input,
            sigma,
            followed: Mat::from_fn(followed.nrows(), places.len(), |row, at| followed[(row, places[at])]),
        });
        let used = (0..m).map(|at| 1.0 - inverse[(at, at)]).sum();
        Ok(Some(Followed {
            found: (0..m).map(|at| inputs.found[at] + step[(at, 0)]).collect(),
            used,
            parts: parts.collect(),
            noise: &followed * shown * followed.transpose(),
        }))
    }

    /// The variance of rows that are whitened and weighed, as far as their weights say something of an estimate.
    fn noise_beside(&self, course: &Course, weight: &[f64]) -> f64 {
        let (tally, kept) = (&course.point.sweep.tally, self.kept_components(weight) as f64);
        let variance = match self.options.noise.known() {
            Some(_) => 1.0,
            None => tally.variance_factor(kept, self.used(course)),
        };
        let own = variance * tally.weights / kept.max(1.0);
        if own.is_finite() { own.max(LEAST_NOISE) } else { 1.0 }
    }

    /// What moving by this much does to each component, whitened and weighed; rows that do not count have none.
    fn moves(&self, course: &Course, weight: &[f64], moved: Moved, by: f64) -> Result<Vec<f64>, FitError> {
        let at = |step: f64| {
            let mut observations = self.observations.clone();
            observations.measured.iter_mut().for_each(|own| *own = moved.of(own, step));
            residuals(self.plain(), &observations, &course.point.values)
        };
        let (above, below) = (at(STEP)?, at(-STEP)?);
        let sigma = course.noise.sigma_without_memory();
        let each = above.iter().zip(&below).zip(sigma.iter()).zip(self.layout.row_of_each());
        let own = each.map(|(((above, below), sigma), row)| {
            let value = by * (above - below) / (2.0 * STEP * sigma) * weight[row].sqrt();
            if weight[row] > 0.0 && value.is_finite() { value } else { 0.0 }
        });
        Ok(own.collect())
    }
}
