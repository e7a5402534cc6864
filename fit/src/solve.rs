//! The fit in its order: least squares, then robust weights by degrees (not with few rows), then what the data do not
//! determine, under its prior.

use std::cell::OnceCell;
use std::sync::Arc;

use model_core::Chain;

use super::align::starting_values;
use super::beside_reference::fit_beside;
use super::descent::SCALE_SETTLED;
use super::solver::{Course, Solver};
use super::sweep::{Weighting, residuals};
use super::turns::unwound;
use super::{FitError, FitOptions, FitResult, Model, Outcome, Reason, Residuals, SetAside, Why};
use crate::noise::{Layout, NoiseOptions};
use observe::Observations;
use observe::unknowns::Unknowns;

/// Rows from which on a robust fit comes near on a sample of them first.
const MANY: usize = 200_000;

/// Rows of such a sample, about.
const SAMPLE: usize = 20_000;

/// When more than this share of the rows has lost all weight, other starts are tried.
const DOUBTFUL: f64 = 0.25;

/// Fits the chain to the observations.
///
/// Converging or not, and having enough observations or not, is in [`FitResult::outcome`].
///
/// # Errors
/// What the caller did wrong: nothing to estimate, a parameter that is neither error nor constant, missing readings.
pub fn fit(chain: &Chain, observations: &Observations, options: &FitOptions) -> Result<FitResult, FitError> {
    fit_by(Model::new(chain, &observations.poses, &options.estimate)?, chain, observations, options)
}

/// The same by a model that was built before, of what the options estimate and of series as these observations have.
///
/// # Errors
/// As [`fit`].
pub fn fit_by(
    model: Model,
    chain: &Chain,
    observations: &Observations,
    options: &FitOptions,
) -> Result<FitResult, FitError> {
    let unknown = observations.unknowns.as_ref().map_or(0, Unknowns::numbers);
    if ![0, unknown].map(|more| chain.symbols.len() + more).contains(&options.start.len()) {
        let why = format!("{} starting values for {} symbols", options.start.len(), chain.symbols.len());
        return Err(FitError::WrongShape { why });
    }
    if let Some(reference) = &options.reference {
        return fit_beside(model, chain, observations, options, reference);
    }
    let mut solver = Solver::new(model, chain, observations, options);
    let course = solver.brought_down()?;
    solver.result(course)
}

impl<'a> Solver<'a> {
    pub(super) fn new(
        model: Model,
        chain: &'a Chain,
        observations: &'a Observations,
        options: &'a FitOptions,
    ) -> Self {
        Solver {
            chain,
            observations,
            options,
            model: model.for_steps(chain, &observations.poses),
            plain: OnceCell::new(),
            layout: Layout::of(observations),
            aside: Vec::new(),
            brought: Vec::new(),
            prior_sizes: Vec::new(),
            inputs: None,
            iterations: 0,
        }
    }
}

impl Solver<'_> {
    /// At the bottom, with what becomes of the rest.
    pub(super) fn brought_down(&mut self) -> Result<Course, FitError> {
        let mut course = self.arrived()?;
        self.take_as_they_are(&mut course)?;
        let arrived = self.scale(&course);
        self.release(&mut course)?;
        // Small errors are not what the data show.
        let is_pulled_off = self.scale(&course) > arrived + SCALE_SETTLED;
        if self.options.other_starts
            && (is_pulled_off || self.has_long_errors(&course) || self.doubtful(&course)?)
        {
            course = self.best_of_homes(course)?;
        }
        // Rows that are set aside only now leave few of them for what they now show.
        if self.counts_in_full(&course) {
            course = self.of_few(course)?;
            self.release(&mut course)?;
        }
        self.take_as_they_are(&mut course)?;
        Ok(course)
    }

    /// At the bottom, what the data do not determine still where it is expected.
    fn arrived(&mut self) -> Result<Course, FitError> {
        let weighting = self.options.weighting();
        let near = match self.of_objects() {
            None => self.of_sample()?,
            near => near,
        };
        let mut course = match near {
            Some(near) => self.course_from(&near, weighting)?,
            None => {
                let start = self.with_state(starting_values(self.chain, self.observations, self.options)?);
                self.course(&start, weighting)?
            }
        };
        if self.options.other_starts {
            if self.doubtful(&course)? {
                course = self.elsewhere(course)?;
            }
            course = self.nearest(course)?;
        }
        course = self.freed(course)?;
        if self.counts_in_full(&course) {
            course = self.of_few(course)?;
        }
        Ok(course)
    }

    /// Where another fit of these objects ended, if this one is to start there.
    fn of_objects(&self) -> Option<Vec<f64>> {
        let start = &self.options.start;
        (start.len() > self.chain.symbols.len()).then(|| start.clone())
    }

    /// Where a fit of some of very many rows comes to; none where they are not many, or that fit does not get there.
    fn of_sample(&self) -> Result<Option<Vec<f64>>, FitError> {
        let has_objects = self.observations.unknowns.is_some();
        if self.observations.rows() < MANY || !self.options.robust || has_objects {
            return Ok(None);
        }
        let sample = self.observations.sample(SAMPLE);
        let noise = NoiseOptions { variance: false, serial: false, ..self.options.noise.clone() };
        let options = FitOptions { noise, ..self.options.clone() };
        let model = Model::new(self.chain, &sample.poses, &options.estimate)?;
        let mut of_sample = Solver::new(model, self.chain, &sample, &options);
        let course = of_sample.arrived()?;
        let has_arrived = of_sample.has_arrived(&course);
        Ok(has_arrived.then_some(course.point.values))
    }

    /// Whether a course failed, or ended where much of the data does not count or where no errors at all would do better.
    fn doubtful(&self, course: &Course) -> Result<bool, FitError> {
        let (_, weight) = self.norms_and_weights(course);
        let lost = weight.iter().filter(|weight| **weight == 0.0).count();
        let many = !self.are_few(course) && lost as f64 > DOUBTFUL * weight.len() as f64;
        let nominal = residuals(self.plain(), self.observations, &self.nominal())?;
        let worse = self.ln_scale(&course.point.sweep.residual) > self.ln_scale(&nominal);
        Ok(course.stopped.is_some() || many || worse)
    }

    /// The best of some courses from other starts and this one: that with the smallest residual by its medians.
    fn elsewhere(&mut self, course: Course) -> Result<Course, FitError> {
        let mut best = course;
        let given = self.with_state(self.options.start.clone());
        let squares = self.course(&given, Weighting::Full)?;
        for start in [squares.point.values, given, self.nominal()] {
            let other = self.course(&start, self.options.weighting())?;
            if self.scale(&other) < self.scale(&best) {
                best = other;
            }
        }
        Ok(best)
    }

    /// The best of a course and of those in which one joint counts from elsewhere.
    fn best_of_homes(&mut self, course: Course) -> Result<Course, FitError> {
        let mut best = course;
        if self.observations.rows() > SAMPLE {
            return Ok(best);
        }
        for start in self.other_homes() {
            let mut other = self.course(&start, self.options.weighting())?;
            // Another home of the same bottom says nothing more.
            let least = self.scale(&best) - SCALE_SETTLED;
            if other.stopped.is_some() || self.scale(&other) >= least {
                continue;
            }
            self.release(&mut other)?;
            if self.scale(&other) < least {
                best = other;
            }
        }
        Ok(best)
    }

    pub(super) fn result(self, course: Course) -> Result<FitResult, FitError> {
        let rank = course.subspace.rank();
        let of_objects = course.point.sweep.eliminated.as_ref().map_or(0, |own| own.taken as usize);
        let (norms, weight) = self.norms_and_weights(&course);
        let kept = self.kept_components(&weight);
        let (uncertainty, shared) = self.uncertainty(&course, &weight)?;
        let enough = self.layout.row_of_each().filter(|&row| course.point.sweep.defined[row]).count();
        // Where most of rows enough lie far from the rest, there is no rest.
        let is_lost = kept <= rank + of_objects && enough > (rank + of_objects).max(2 * kept);
        let far_off =
            self.is_far_off(&course).then_some(Reason::FarOff).or(is_lost.then_some(Reason::NoRest));
        let Course { point, noise, subspace, stopped, .. } = course;
        let noise = Arc::new(shared.in_noise(Arc::unwrap_or_clone(noise)));
        let mut whitened = point.sweep.residual.clone();
        noise.whiten(&mut whitened);
        for (value, row) in whitened.iter_mut().zip(self.layout.row_of_each()) {
            *value *= weight[row].sqrt();
        }
        let parameters = self.model.parameters().to_vec();
        let values = unwound(self.chain, &parameters, point.values);
        let outcome = match far_off.or(stopped) {
            // Far off all noise is none, and no row near enough to count.
            Some(reason @ (Reason::FarOff | Reason::NoRest)) => {
                Outcome::NotConverged { iterations: self.iterations, reason }
            }
            _ if kept <= rank + of_objects => Outcome::TooFewObservations {
                components: kept,
                parameters: parameters.len(),
                rank,
                of_objects,
            },
            None => Outcome::Converged { iterations: self.iterations },
            Some(reason) => Outcome::NotConverged { iterations: self.iterations, reason },
        };
        Ok(FitResult {
            outcome,
            estimable: uncertainty.estimable(&subspace, &parameters, &values),
            shown: subspace.shown(),
            separable: subspace.separable(),
            null_space: subspace.null_space(),
            rank,
            degrees_of_freedom: uncertainty.degrees_of_freedom(),
            parameter_degrees_of_freedom: uncertainty.of_parameters(),
            covariance: uncertainty.covariance(),
            stated: uncertainty.stated(),
            from_reference: uncertainty.of_reference(),
            sizes: self.prior_sizes,
            set_aside: set_aside(&point.sweep.defined, &norms, &weight),
            noise,
            chi_squared: whitened.iter().map(|r| r * r).sum(),
            rms: point.sweep.tally.rms(),
            factor: point.sweep.tally.partial.spread(self.model.column_of()),
            rest: point.rest,
            subspace,
            parameters,
            values,
            residuals: Arc::new(Residuals { raw: point.sweep.residual, weight }),
        })
    }
}

/// The rows without weight, and why.
fn set_aside(defined: &[bool], norms: &[f64], weight: &[f64]) -> Vec<SetAside> {
    let rows = norms.iter().zip(weight).zip(defined).enumerate();
    rows.filter(|(_, ((_, weight), _))| **weight == 0.0)
        .map(|(row, ((&norm, _), &defined))| SetAside {
            row,
            why: if defined { Why::Far { standard_deviations: norm } } else { Why::NoValue },
        })
        .collect()
}
