//! Uncertainty of the reference: errors that many rows have in common, as unknowns of the fit with a stated size.
//!
//! Each input is a number that is zero but for its standard uncertainty. The fit looks for errors and inputs together: what it finds of the
//! inputs is taken out of what was measured, and the errors are fitted again. Their covariance is that of errors and inputs together, so
//! that each input counts once: what the rows show of it is no longer in their noise, and what they cannot show is in the ±.
//!
//! Source: JCGM 100:2008 (GUM), 5.2, correlated inputs; of unknowns with a stated size, C. R. Henderson, Biometrics 31 (1975) 423-447.

use std::collections::BTreeMap;

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use nalgebra::{UnitQuaternion, Vector3};

use super::solver::{Course, Solver};
use super::sweep::residuals;
use super::{FitError, FitOptions, FitResult, Model};
use model_core::Chain;
use observe::{Measured, Observations};

/// By how much an input is moved to either side: a share, rad or m.
const STEP: f64 = 1e-6;

/// Targets at most that several rows have in common: each is three unknowns.
const TARGETS: usize = 300;

/// Fits at most, the first without anything known of the inputs.
const FITS: usize = 5;

/// Inputs that change by less, in their standard uncertainties, end the fits.
const SETTLED: f64 = 0.01;

/// The least noise that inputs are weighed against, of variances, over what whitens the rows: data without any still have one answer.
const LEAST_NOISE: f64 = 1e-9;

/// Standard uncertainties of what rows are compared with; zero where nothing is stated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reference {
    /// Of the scale of all lengths, as a share.
    pub scale: f64,
    /// Of each coordinate of a target, common to its rows, m.
    pub targets_m: f64,
    /// Of the frame's rotation about each axis, rad.
    pub rotation_rad: f64,
    /// Of the frame's origin along each axis, m.
    pub shift_m: f64,
}

/// An input of the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// The scale of all lengths.
    Scale,
    /// The coordinates of targets.
    Targets,
    /// The rotation of the frame.
    Rotation,
    /// Its origin.
    Shift,
}

/// What an input does to the estimates.
#[derive(Debug, Clone)]
pub struct FromReference {
    /// Which.
    pub input: Input,
    /// Its standard uncertainty: a share, rad or m.
    pub sigma: f64,
    /// By how much each parameter follows one standard uncertainty of each of its numbers, p × numbers, SI.
    pub followed: Mat<f64>,
}

impl FromReference {
    /// What it adds to the covariance of the estimates, p × p, SI.
    #[must_use]
    pub fn covariance(&self) -> Mat<f64> {
        &self.followed * self.followed.transpose()
    }

    /// What it adds to the standard uncertainty of a combination of parameters, each by its place with its factor, SI.
    #[must_use]
    pub fn contribution(&self, combination: &[(usize, f64)]) -> f64 {
        let of = |number: usize| -> f64 {
            combination.iter().map(|&(at, factor)| factor * self.followed[(at, number)]).sum()
        };
        (0..self.followed.ncols()).map(|number| of(number).powi(2)).sum::<f64>().sqrt()
    }
}

/// A way to move what was measured.
#[derive(Debug, Clone, Copy)]
enum Moved {
    Stretched,
    Turned(usize),
    Shifted(usize),
}

impl Moved {
    fn of(self, measured: &Measured, step: f64) -> Measured {
        let along = |axis: usize| Vector3::from_fn(|own, _| if own == axis { step } else { 0.0 });
        match self {
            Self::Stretched => measured.stretched(1.0 + step),
            Self::Turned(axis) => measured.turned(&UnitQuaternion::new(along(axis))),
            Self::Shifted(axis) => measured.shifted(&along(axis)),
        }
    }
}

const AXES: [usize; 3] = [0, 1, 2];

/// The inputs of a fit: those common to all rows, and behind them three of each target.
#[derive(Debug, Clone)]
pub(super) struct Inputs {
    common: Vec<(Input, Moved, f64)>,
    targets_m: f64,
    /// Of each row its target, where it shares one.
    target_of: Vec<Option<usize>>,
    targets: usize,
    /// What was found of each so far, in its standard uncertainties.
    found: Vec<f64>,
    /// How many independent numbers of the data they use up.
    pub used: f64,
}

impl Inputs {
    fn of(observations: &Observations, reference: &Reference) -> Result<Self, FitError> {
        let stretched = [(Input::Scale, Moved::Stretched, reference.scale)];
        let turned = AXES.map(|axis| (Input::Rotation, Moved::Turned(axis), reference.rotation_rad));
        let shifted = AXES.map(|axis| (Input::Shift, Moved::Shifted(axis), reference.shift_m));
        let common: Vec<_> =
            stretched.into_iter().chain(turned).chain(shifted).filter(|(.., sigma)| *sigma > 0.0).collect();
        let (target_of, targets) = match reference.targets_m > 0.0 {
            true => targets(observations),
            false => (vec![None; observations.rows()], 0),
        };
        if targets > TARGETS {
            return Err(FitError::TooManyTargets { targets, most: TARGETS });
        }
        let found = vec![0.0; common.len() + 3 * targets];
        Ok(Self { common, targets_m: reference.targets_m, target_of, targets, found, used: 0.0 })
    }

    /// What was measured without what was found of the inputs.
    fn taken_from(&self, observations: &Observations) -> Observations {
        let mut own = observations.clone();
        let of_targets = self.common.len();
        for (measured, target) in own.measured.iter_mut().zip(&self.target_of) {
            if let Some(target) = target {
                let first = of_targets + 3 * target;
                let by = Vector3::from_fn(|axis, _| -self.targets_m * self.found[first + axis]);
                *measured = measured.shifted(&by);
            }
            for ((_, moved, sigma), found) in self.common.iter().zip(&self.found) {
                *measured = moved.of(measured, -sigma * found);
            }
        }
        own
    }

    /// The inputs by their kinds, each with its standard uncertainty and its places among all.
    fn kinds(&self) -> Vec<(Input, f64, Vec<usize>)> {
        let mut kinds: Vec<(Input, f64, Vec<usize>)> = Vec::new();
        for (at, (input, _, sigma)) in self.common.iter().enumerate() {
            match kinds.last_mut().filter(|(known, ..)| known == input) {
                Some((.., places)) => places.push(at),
                None => kinds.push((*input, *sigma, vec![at])),
            }
        }
        if self.targets > 0 {
            kinds.push((Input::Targets, self.targets_m, (self.common.len()..self.found.len()).collect()));
        }
        kinds
    }
}

/// The target of each row that shares one with another, and how many there are. A target of one row is in the noise of that row.
fn targets(observations: &Observations) -> (Vec<Option<usize>>, usize) {
    let label = |row: usize| match observations.targets.get(row) {
        Some(&label) => vec![u64::from(label)],
        // Zero has two signs.
        None => observations.measured[row].numbers().iter().map(|number| (number + 0.0).to_bits()).collect(),
    };
    let mut rows_of: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    let is_point = |row: &usize| observations.measured[*row].point_m().is_some();
    for row in (0..observations.rows()).filter(is_point) {
        rows_of.entry(label(row)).or_default().push(row);
    }
    let mut target_of = vec![None; observations.rows()];
    let mut count = 0;
    for rows in rows_of.values().filter(|rows| rows.len() > 1) {
        rows.iter().for_each(|&row| target_of[row] = Some(count));
        count += 1;
    }
    (target_of, count)
}

/// What the inputs do at the end of a course.
pub(super) struct Followed {
    /// What is found of each, in its standard uncertainties.
    found: Vec<f64>,
    used: f64,
    pub parts: Vec<FromReference>,
    /// What the noise of the rows adds to the covariance because they say something of the inputs too, p × p, SI.
    pub noise: Mat<f64>,
}

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
