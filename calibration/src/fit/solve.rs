//! The loop: start robustly, fit with the noise known so far, learn the noise, until nothing changes.

use std::cell::OnceCell;

use faer::Mat;
use model_core::{Chain, SymbolId};

use super::align::starting_values;
use super::sweep::{Sweep, Weighting, coloured, residuals, sweep};
use super::{FitError, FitOptions, FitResult, Model, Outcome, Partial, Residuals, SetAside, Subspace};
use crate::data::Observations;
use crate::fit::noise::{self, Layout, Noise};

/// A step is negligible when it moves the prediction by this many standard deviations in all.
const NEGLIGIBLE: f64 = 1e-7;

/// The same while the noise is still being learned.
const ROUGHLY: f64 = 1e-2;

/// How often the noise is learned anew.
const NOISE_ROUNDS: usize = 8;

/// The noise is known when no standard deviation changes by more than this share.
const NOISE_KNOWN: f64 = 1e-3;

/// One fit in progress.
struct Solver<'a> {
    chain: &'a Chain,
    observations: &'a Observations,
    options: &'a FitOptions,
    model: Model,
    /// The same without derivatives, once it is needed.
    plain: OnceCell<Model>,
    layout: Layout,
    iterations: usize,
}

/// Where the solver is: values, and what all rows say there.
struct Point {
    values: Vec<f64>,
    sweep: Sweep,
}

/// Fits the chain to the observations.
///
/// Converging or not, and having enough observations or not, is in [`FitResult::outcome`].
///
/// # Errors
/// What the caller did wrong: nothing to estimate, a parameter that is neither error nor constant, missing readings.
pub fn fit(chain: &Chain, observations: &Observations, options: &FitOptions) -> Result<FitResult, FitError> {
    if options.start.len() != chain.symbols.len() {
        let why = format!("{} starting values for {} symbols", options.start.len(), chain.symbols.len());
        return Err(FitError::WrongShape { why });
    }
    let model = Model::new(chain, observations, &options.estimate)?;
    let (plain, layout) = (OnceCell::new(), Layout::of(observations));
    let solver = Solver { chain, observations, options, model, plain, layout, iterations: 0 };
    solver.run()
}

impl Solver<'_> {
    fn run(mut self) -> Result<FitResult, FitError> {
        let mut values = starting_values(self.chain, self.observations, self.options)?;
        let mut noise = self.first_noise(&values)?;
        let mut point = self.point(values.clone(), &noise)?;
        let mut subspace = Subspace::determined(&self.unweighted_at(&point, &noise)?);
        if self.options.robust {
            self.start_robustly(&mut values, &mut noise, &subspace)?;
            point = self.point(values, &noise)?;
        }
        for _ in 0..NOISE_ROUNDS {
            self.descend(&mut point, &noise, &subspace, ROUGHLY)?;
            let seen = subspace.clone().extended(&self.partial(&point.sweep));
            if seen.rank() > subspace.rank() {
                subspace = seen;
                continue;
            }
            if self.layout.components() <= subspace.rank() {
                break;
            }
            let learned = self.learn_noise(&point, &noise, subspace.rank());
            let known = same(&learned, &noise);
            if learned != noise {
                point = self.point(point.values, &learned)?;
                noise = learned;
            }
            if known {
                break;
            }
        }
        let converged = self.descend(&mut point, &noise, &subspace, NEGLIGIBLE)?;
        self.result(point, noise, subspace, converged)
    }

    /// All rows at some values. Serial correlation has no part in it: estimates that do not lean on it stay right when
    /// what looks like memory is an effect that the chain lacks. It enters the uncertainties.
    fn sweep(&self, values: &[f64], noise: &Noise, weighting: Weighting) -> Result<Sweep, FitError> {
        let sigma = noise.sigma_without_memory();
        sweep(&self.model, self.observations, &self.layout, values, &sigma, weighting)
    }

    fn point(&self, values: Vec<f64>, noise: &Noise) -> Result<Point, FitError> {
        let sweep = self.sweep(&values, noise, self.options.weighting())?;
        Ok(Point { values, sweep })
    }

    fn moved(&self, values: &[f64], change: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        for (parameter, change) in self.model.parameters().iter().zip(change) {
            values[parameter.index()] += change;
        }
        values
    }

    fn partial(&self, sweep: &Sweep) -> Partial {
        sweep.tally.partial.spread(self.model.column_of())
    }

    fn first_noise(&self, values: &[f64]) -> Result<Noise, FitError> {
        // A noise that is known has no use for residuals.
        let plain = || self.plain.get_or_init(|| Model::without_columns(self.chain, self.observations));
        let residual = match self.options.noise.known() {
            Some(_) => Vec::new(),
            None => residuals(plain(), self.observations, values)?,
        };
        Ok(noise::from_medians(&self.options.noise, self.observations, &self.layout, &residual))
    }

    fn learn_noise(&self, point: &Point, noise: &Noise, rank: usize) -> Noise {
        let (_, weight) = self.norms_and_weights(point, noise);
        noise::estimate(
            self.chain,
            &self.options.noise,
            self.observations,
            &self.layout,
            &point.sweep.residual,
            &weight,
            rank,
        )
    }

    /// Per row the norm of its whitened components and its weight; rows without a value have none.
    fn norms_and_weights(&self, point: &Point, noise: &Noise) -> (Vec<f64>, Vec<f64>) {
        let (sigma, weighting) = (noise.sigma_without_memory(), self.options.weighting());
        let residual = point.sweep.residual.iter().zip(sigma.iter());
        let white: Vec<f64> = residual.map(|(residual, sigma)| residual / sigma).collect();
        let rows = self.layout.norms(&white).zip(self.layout.first.windows(2)).zip(&point.sweep.defined);
        rows.map(|((norm, ends), &defined)| {
            (norm, if defined { weighting.weight(norm, ends[1] - ends[0]) } else { 0.0 })
        })
        .unzip()
    }

    /// The factor of all rows that have a value, each with its full weight, whitened but for serial correlation.
    fn unweighted(&self, values: &[f64], noise: &Noise) -> Result<Partial, FitError> {
        Ok(self.partial(&self.sweep(values, noise, Weighting::Full)?))
    }

    /// The same where the solver is.
    fn unweighted_at(&self, point: &Point, noise: &Noise) -> Result<Partial, FitError> {
        match self.options.weighting() {
            Weighting::Full => Ok(self.partial(&point.sweep)),
            _ => self.unweighted(&point.values, noise),
        }
    }

    /// Least absolute deviations, roughly: brings the values near enough for the biweight, whatever the outliers.
    fn start_robustly(
        &mut self,
        values: &mut Vec<f64>,
        noise: &mut Noise,
        subspace: &Subspace,
    ) -> Result<(), FitError> {
        for _ in 0..30 {
            let step = subspace.step(&self.partial(&self.sweep(values, noise, Weighting::Distance)?), 0.0);
            *values = self.moved(values, &step.change);
            *noise = self.first_noise(values)?;
            self.iterations += 1;
            // Within a tenth of a standard uncertainty per combination the biweight takes over.
            if step.length < 0.1 * (subspace.rank() as f64).sqrt() {
                break;
            }
        }
        Ok(())
    }

    /// Levenberg-Marquardt with the noise as it is; whether it converged to a step no longer than `negligible`.
    ///
    /// Source: K. Madsen, H. B. Nielsen, O. Tingleff, Methods for Non-Linear Least Squares Problems (2004), with steps
    /// within the determined combinations and weights taken anew at every step.
    fn descend(
        &mut self,
        point: &mut Point,
        noise: &Noise,
        subspace: &Subspace,
        negligible: f64,
    ) -> Result<bool, FitError> {
        let negligible = negligible.max(self.unresolved(noise));
        let mut damping = 0.0;
        for _ in 0..self.options.max_iterations {
            let tally = &point.sweep.tally;
            let step = subspace.step(&self.partial(&point.sweep), damping).times(tally.stride());
            if step.length <= negligible && damping < 1e-3 {
                return Ok(true);
            }
            self.iterations += 1;
            let next = self.point(self.moved(&point.values, &step.change), noise)?;
            if next.sweep.tally.objective <= tally.objective * (1.0 + 1e-9) {
                *point = next;
                damping = if damping < 1e-7 { 0.0 } else { damping / 10.0 };
            } else {
                damping = (damping * 10.0).max(1e-6);
                if damping > 1e8 {
                    return Ok(false);
                }
            }
        }
        Ok(false)
    }

    /// The length of a step that only moves the last bits of the prediction.
    fn unresolved(&self, noise: &Noise) -> f64 {
        let resolution = noise::resolution(self.observations);
        let sigma = noise.sigma_without_memory();
        sigma.iter().map(|sigma| (resolution / sigma).powi(2)).sum::<f64>().sqrt()
    }

    fn result(
        self,
        point: Point,
        noise: Noise,
        subspace: Subspace,
        converged: bool,
    ) -> Result<FitResult, FitError> {
        let (n, rank) = (self.layout.components(), subspace.rank());
        let (norms, weight) = self.norms_and_weights(&point, &noise);
        let kept = self.layout.row.iter().filter(|&&row| weight[row as usize] > 0.0).count() as f64;
        let full = self.unweighted_at(&point, &noise)?;
        let covariance = match noise.serial {
            None => subspace.covariance(&full),
            Some(_) => {
                let coloured = coloured(&self.model, self.observations, &point.values, &noise)?;
                subspace.sandwich(&full, &coloured.spread(self.model.column_of()))
            }
        };
        let (tally, known) = (&point.sweep.tally, self.options.noise.known().is_some());
        let factor = tally.variance_factor(rank, known, self.options.weighting());
        let mut whitened = point.sweep.residual.clone();
        noise.whiten(&mut whitened);
        for (value, &row) in whitened.iter_mut().zip(&self.layout.row) {
            *value *= weight[row as usize].sqrt();
        }
        let parameters = self.model.parameters().to_vec();
        let outcome = if n <= rank || n == 0 {
            Outcome::TooFewObservations { components: n, parameters: parameters.len() }
        } else if converged {
            Outcome::Converged { iterations: self.iterations }
        } else {
            Outcome::NotConverged { iterations: self.iterations }
        };
        Ok(FitResult {
            outcome,
            parameters,
            covariance: scaled(&covariance, factor),
            rank,
            null_space: subspace.null_space(),
            separable: subspace.separable(),
            subspace,
            set_aside: set_aside(&point.sweep.defined, &norms, &weight),
            noise,
            chi_squared: whitened.iter().map(|r| r * r).sum(),
            degrees_of_freedom: kept - rank as f64,
            rms: tally.rms(),
            factor: self.partial(&point.sweep),
            values: point.values,
            residuals: Residuals { raw: point.sweep.residual, whitened, row: self.layout.row, weight },
        })
    }
}

/// The rows without weight, and why.
fn set_aside(defined: &[bool], norms: &[f64], weight: &[f64]) -> Vec<SetAside> {
    let rows = norms.iter().zip(weight).zip(defined).enumerate();
    rows.filter(|(_, ((_, weight), _))| **weight == 0.0)
        .map(|(row, ((norm, _), &defined))| SetAside {
            row,
            why: if defined {
                format!("its residual is {norm:.1} standard deviations")
            } else {
                "the chain has no finite value there".to_string()
            },
        })
        .collect()
}

/// Whether two noise models whiten alike.
fn same(a: &Noise, b: &Noise) -> bool {
    let close = |x: f64, y: f64| (x - y).abs() <= NOISE_KNOWN * y.abs();
    let serial = match (a.serial, b.serial) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            (a.autoregressive - b.autoregressive).abs() <= NOISE_KNOWN
                && (a.moving_average - b.moving_average).abs() <= NOISE_KNOWN
        }
        _ => false,
    };
    serial && a.sigma.len() == b.sigma.len() && a.sigma.iter().zip(&b.sigma).all(|(&x, &y)| close(x, y))
}

fn scaled(matrix: &Mat<f64>, factor: f64) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |row, column| match matrix[(row, column)] {
        0.0 => 0.0,
        value => value * factor,
    })
}

impl FitResult {
    /// The standard uncertainty of a parameter, SI; `None` if it was not estimated.
    #[must_use]
    pub fn standard_uncertainty(&self, parameter: SymbolId) -> Option<f64> {
        let at = self.parameters.iter().position(|&id| id == parameter)?;
        Some(self.covariance[(at, at)].sqrt())
    }
}
