//! The fit: downhill robustly by degrees, with few rows by least squares, then what the data leave open under its prior.

use std::cell::OnceCell;

use model_core::{Chain, SymbolKind};

use super::align::starting_values;
use super::descent::{Course, Point};
use super::normal::Rest;
use super::size::Size;
use super::sweep::{Sweep, Weighting, residuals, sweep};
use super::{FitError, FitOptions, FitResult, Model, Outcome, Partial, Residuals, SetAside, Subspace, Why};
use crate::data::Observations;
use crate::data::unknowns::Unknowns;
use crate::fit::noise::{self, Layout, Noise};

/// The noise is known when no standard deviation changes by more than this share.
const NOISE_KNOWN: f64 = 1e-3;

/// When more than this share of the rows has lost all weight, other starts are tried.
const DOUBTFUL: f64 = 0.25;

/// One fit in progress.
pub(super) struct Solver<'a> {
    pub chain: &'a Chain,
    pub observations: &'a Observations,
    pub options: &'a FitOptions,
    pub model: Model,
    /// The same without derivatives, once it is needed.
    plain: OnceCell<Model>,
    pub layout: Layout,
    /// Rows that count for nothing, where they are few and chosen one by one; empty where all may count.
    pub aside: Vec<bool>,
    /// How large a parameter may be that the data do not show.
    pub prior_sizes: Vec<Size>,
    pub iterations: usize,
}

/// Fits the chain to the observations.
///
/// Converging or not, and having enough observations or not, is in [`FitResult::outcome`].
///
/// # Errors
/// What the caller did wrong: nothing to estimate, a parameter that is neither error nor constant, missing readings.
pub fn fit(chain: &Chain, observations: &Observations, options: &FitOptions) -> Result<FitResult, FitError> {
    let unknown = observations.unknowns.as_ref().map_or(0, Unknowns::numbers);
    if ![0, unknown].map(|more| chain.symbols.len() + more).contains(&options.start.len()) {
        let why = format!("{} starting values for {} symbols", options.start.len(), chain.symbols.len());
        return Err(FitError::WrongShape { why });
    }
    let model = Model::new(chain, observations, &options.estimate)?;
    let solver = Solver {
        chain,
        observations,
        options,
        model,
        plain: OnceCell::new(),
        layout: Layout::of(observations),
        aside: Vec::new(),
        prior_sizes: Vec::new(),
        iterations: 0,
    };
    solver.run()
}

impl Solver<'_> {
    fn run(mut self) -> Result<FitResult, FitError> {
        let start = self.with_state(starting_values(self.chain, self.observations, self.options)?);
        let weighting = self.options.weighting();
        let mut course = self.course(&start, weighting)?;
        if self.doubtful(&course)? {
            course = self.elsewhere(course)?;
        }
        if weighting == Weighting::Biweight && self.are_few(course.subspace.rank()) {
            course = self.of_few(course)?;
        }
        self.release(&mut course)?;
        self.result(course)
    }

    /// Whether a course failed, or ended where much of the data does not count or where no errors at all would do better.
    fn doubtful(&self, course: &Course) -> Result<bool, FitError> {
        let (_, weight) = self.norms_and_weights(course);
        let lost = weight.iter().filter(|weight| **weight == 0.0).count();
        let many = !self.are_few(course.subspace.rank()) && lost as f64 > DOUBTFUL * weight.len() as f64;
        let plain = self.plain.get_or_init(|| Model::without_columns(self.chain, self.observations));
        let nominal = residuals(plain, self.observations, &self.nominal())?;
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
            let scale = |course: &Course| self.ln_scale(&course.point.sweep.residual);
            if scale(&other) < scale(&best) {
                best = other;
            }
        }
        Ok(best)
    }

    /// All rows at some values. Serial correlation has no part in it: estimates that do not lean on it stay right when
    /// what looks like memory is an effect that the chain lacks. It enters the uncertainties.
    pub(super) fn sweep(
        &self,
        values: &[f64],
        noise: &Noise,
        weighting: Weighting,
    ) -> Result<Sweep, FitError> {
        let sigma = noise.sigma_without_memory();
        sweep(&self.model, self.observations, &self.layout, values, &sigma, weighting, &self.aside)
    }

    pub(super) fn point(
        &self,
        values: Vec<f64>,
        noise: &Noise,
        weighting: Weighting,
        rest: Rest,
    ) -> Result<Point, FitError> {
        let sweep = self.sweep(&values, noise, weighting)?;
        Ok(Point { values, sweep, rest })
    }

    /// Values with the numbers of objects and stations behind them: zero, as they count from where they are taken to be.
    fn with_state(&self, mut values: Vec<f64>) -> Vec<f64> {
        let unknown = self.observations.unknowns.as_ref().map_or(0, Unknowns::numbers);
        values.resize(self.chain.symbols.len() + unknown, 0.0);
        values
    }

    fn nominal(&self) -> Vec<f64> {
        self.with_state(self.chain.nominal_values())
    }

    /// The values after a step that was made `stride` times as long; objects and stations follow the errors.
    pub(super) fn moved(&self, from: &Point, change: &[f64], stride: f64) -> Vec<f64> {
        let mut values = from.values.clone();
        let mut by_column = vec![0.0; self.model.columns()];
        for ((parameter, change), column) in
            self.model.parameters().iter().zip(change).zip(self.model.column_of())
        {
            values[parameter.index()] += change;
            if let Some(column) = *column {
                by_column[column] += change;
            }
        }
        if let Some(eliminated) = &from.sweep.eliminated {
            let state = eliminated.moved(self.model.state(&from.values), &by_column, stride);
            values.truncate(self.chain.symbols.len());
            values.extend(state);
        }
        values
    }

    pub(super) fn partial(&self, sweep: &Sweep) -> Partial {
        sweep.tally.partial.spread(self.model.column_of())
    }

    /// What the data determine: every error at zero, constants where they are. Of an anchored fit, what they tell more of
    /// than the sizes do, where the errors are: only there are residuals no larger than the noise.
    pub(super) fn determined(&self, values: &[f64], noise: &Noise) -> Result<Subspace, FitError> {
        if self.options.anchored {
            let partial = self.partial(&self.sweep(values, noise, Weighting::Full)?);
            return Ok(Subspace::beyond(&partial, self.first_sizes()));
        }
        let mut values = values.to_vec();
        for &parameter in self.model.parameters() {
            if self.chain.symbol(parameter).kind == SymbolKind::Error {
                values[parameter.index()] = 0.0;
            }
        }
        let partial = self.partial(&self.sweep(&values, noise, Weighting::Full)?);
        Ok(Subspace::determined(&partial, self.first_sizes()))
    }

    /// How far each parameter is from where it is expected: an error from zero, a constant from its nominal value; SI.
    pub(super) fn deviation(&self, values: &[f64]) -> Vec<f64> {
        let nominal = self.chain.nominal_values();
        self.model.parameters().iter().map(|id| values[id.index()] - nominal[id.index()]).collect()
    }

    /// Values that the data cannot tell from these to first order, as near as can be to where they are expected.
    pub(super) fn with_smallest(&self, values: &[f64], subspace: &Subspace) -> Vec<f64> {
        let smallest = subspace.smallest(&self.deviation(values));
        let nominal = self.chain.nominal_values();
        let mut values = values.to_vec();
        for (parameter, deviation) in self.model.parameters().iter().zip(smallest) {
            values[parameter.index()] = nominal[parameter.index()] + deviation;
        }
        values
    }

    pub(super) fn first_noise(&self, values: &[f64]) -> Result<Noise, FitError> {
        // A noise that is known has no use for residuals.
        let plain = || self.plain.get_or_init(|| Model::without_columns(self.chain, self.observations));
        let residual = match self.options.noise.known() {
            Some(_) => Vec::new(),
            None => residuals(plain(), self.observations, values)?,
        };
        Ok(self.noise_of(&residual))
    }

    /// Floors from the medians of residuals.
    pub(super) fn noise_of(&self, residual: &[f64]) -> Noise {
        noise::from_medians(&self.options.noise, self.observations, &self.layout, residual)
    }

    /// The logarithm of how large residuals are by their medians, the mean over all components.
    pub(super) fn ln_scale(&self, residual: &[f64]) -> f64 {
        noise::ln_scale(self.observations, &self.layout, residual)
    }

    pub(super) fn learn_noise(&self, course: &Course) -> Noise {
        let (_, weight) = self.norms_and_weights(course);
        let (residual, used) = (&course.point.sweep.residual, self.used(course));
        let options = &self.options.noise;
        noise::estimate(self.chain, options, self.observations, &self.layout, residual, &weight, used)
    }

    /// Per row the norm of its whitened components and its weight; rows without a value have none.
    pub(super) fn norms_and_weights(&self, course: &Course) -> (Vec<f64>, Vec<f64>) {
        let sigma = course.noise.sigma_without_memory();
        let sweep = &course.point.sweep;
        let white: Vec<f64> =
            sweep.residual.iter().zip(sigma.iter()).map(|(residual, sigma)| residual / sigma).collect();
        let rows =
            self.layout.norms(&white).zip(self.layout.first.windows(2)).zip(&sweep.defined).enumerate();
        rows.map(|(row, ((norm, ends), &defined))| {
            let counts = defined && self.aside.get(row) != Some(&true);
            (norm, if counts { course.weighting.weight(norm, ends[1] - ends[0]) } else { 0.0 })
        })
        .unzip()
    }

    /// The number of components with weight.
    pub(super) fn kept_components(&self, course: &Course) -> usize {
        let (_, weight) = self.norms_and_weights(course);
        self.layout.row.iter().filter(|&&row| weight[row as usize] > 0.0).count()
    }

    /// How many independent numbers of the data the estimates use up.
    pub(super) fn used(&self, course: &Course) -> f64 {
        let sweep = &course.point.sweep;
        let of_objects = sweep.eliminated.as_ref().map_or(0.0, |eliminated| eliminated.taken);
        of_objects + course.subspace.used(&self.partial(sweep), &course.point.rest)
    }

    fn result(self, course: Course) -> Result<FitResult, FitError> {
        let rank = course.subspace.rank();
        let of_objects = course.point.sweep.eliminated.as_ref().map_or(0, |own| own.taken as usize);
        let (norms, weight) = self.norms_and_weights(&course);
        let kept = self.layout.row.iter().filter(|&&row| weight[row as usize] > 0.0).count();
        let (uncertainty, shared) = self.uncertainty(&course, &weight)?;
        let Course { point, noise, subspace, stopped, .. } = course;
        let noise = shared.in_noise(noise);
        let mut whitened = point.sweep.residual.clone();
        noise.whiten(&mut whitened);
        for (value, &row) in whitened.iter_mut().zip(&self.layout.row) {
            *value *= weight[row as usize].sqrt();
        }
        let parameters = self.model.parameters().to_vec();
        let outcome = match stopped {
            _ if kept <= rank + of_objects => {
                Outcome::TooFewObservations { components: kept, parameters: parameters.len(), rank }
            }
            None => Outcome::Converged { iterations: self.iterations },
            Some(reason) => Outcome::NotConverged { iterations: self.iterations, reason },
        };
        Ok(FitResult {
            outcome,
            estimable: uncertainty.estimable(&subspace, &parameters, &point.values),
            shown: subspace.shown(),
            separable: subspace.separable(),
            null_space: subspace.null_space(),
            rank,
            degrees_of_freedom: uncertainty.degrees_of_freedom(),
            parameter_degrees_of_freedom: uncertainty.of_parameters(),
            covariance: uncertainty.covariance(),
            stated: uncertainty.stated(),
            sizes: self.prior_sizes,
            set_aside: set_aside(&point.sweep.defined, &norms, &weight),
            noise,
            chi_squared: whitened.iter().map(|r| r * r).sum(),
            rms: point.sweep.tally.rms(),
            factor: point.sweep.tally.partial.spread(self.model.column_of()),
            rest: point.rest,
            subspace,
            parameters,
            values: point.values,
            residuals: Residuals { raw: point.sweep.residual, whitened, row: self.layout.row, weight },
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

/// Whether two noise models weigh components alike.
pub(super) fn same(a: &Noise, b: &Noise) -> bool {
    let close = |x: f64, y: f64| (x - y).abs() <= NOISE_KNOWN * y.abs();
    a.sigma.len() == b.sigma.len() && a.sigma.iter().zip(&b.sigma).all(|(&x, &y)| close(x, y))
}
