//! The loop: start robustly, fit with the noise known so far, learn the noise, until nothing changes.

use faer::Mat;
use model_core::{Chain, SymbolId};

use super::dense::{Raw, White};
use super::{
    FitError, FitOptions, FitResult, Linearised, Model, Outcome, Partial, SetAside, Subspace, robust,
};
use crate::noise::{self, Layout, Noise};
use crate::observations::Observations;

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
    layout: Layout,
    iterations: usize,
}

/// Where the solver is: values, and what they predict.
struct Point {
    values: Vec<f64>,
    raw: Raw,
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
    let layout = Layout::of(observations);
    let solver = Solver { chain, observations, options, model, layout, iterations: 0 };
    solver.run()
}

impl Solver<'_> {
    fn run(mut self) -> Result<FitResult, FitError> {
        let mut point = self.point(self.options.start.clone())?;
        let mut noise = self.first_noise(&point);
        let mut subspace = Subspace::determined(&self.unweighted(&point, &noise));
        if self.options.robust {
            self.start_robustly(&mut point, &mut noise, &subspace)?;
        }
        for _ in 0..NOISE_ROUNDS {
            self.descend(&mut point, &noise, &subspace, ROUGHLY)?;
            let seen = subspace.clone().extended(&self.unweighted(&point, &noise));
            if seen.rank() > subspace.rank() {
                subspace = seen;
                continue;
            }
            if self.layout.components() <= subspace.rank() {
                break;
            }
            let learned = self.learn_noise(&point, &noise, subspace.rank());
            let known = same(&learned, &noise);
            noise = learned;
            if known {
                break;
            }
        }
        let converged = self.descend(&mut point, &noise, &subspace, NEGLIGIBLE)?;
        Ok(self.result(point, noise, &subspace, converged))
    }

    fn point(&self, values: Vec<f64>) -> Result<Point, FitError> {
        let raw = Raw::at(&self.model, self.observations, &values)?;
        Ok(Point { values, raw })
    }

    fn moved(&self, point: &Point, change: &[f64]) -> Result<Point, FitError> {
        let mut values = point.values.clone();
        for (parameter, change) in self.model.parameters().iter().zip(change) {
            values[parameter.index()] += change;
        }
        self.point(values)
    }

    fn first_noise(&self, point: &Point) -> Noise {
        noise::from_medians(&self.options.noise, self.observations, &self.layout, &point.raw.residual)
    }

    fn learn_noise(&self, point: &Point, noise: &Noise, rank: usize) -> Noise {
        let weight = self.weights(&point.raw, &point.raw.whiten(&noise.without_memory()));
        noise::estimate(
            self.chain,
            &self.options.noise,
            self.observations,
            &self.layout,
            &point.raw.residual,
            &weight,
            rank,
        )
    }

    fn weights(&self, raw: &Raw, white: &White) -> Vec<f64> {
        let biweight = self.options.robust;
        white.weights(&self.layout, raw, |norm, m| if biweight { robust::weight(norm, m) } else { 1.0 })
    }

    /// The factor of all rows that have a value, each with its full weight, whitened but for serial correlation.
    fn unweighted(&self, point: &Point, noise: &Noise) -> Partial {
        let white = point.raw.whiten(&noise.without_memory());
        white.partial(&self.layout, &white.weights(&self.layout, &point.raw, |_, _| 1.0))
    }

    /// Least absolute deviations, roughly: brings the values near enough for the biweight, whatever the outliers.
    fn start_robustly(
        &mut self,
        point: &mut Point,
        noise: &mut Noise,
        subspace: &Subspace,
    ) -> Result<(), FitError> {
        for _ in 0..30 {
            *noise = self.first_noise(point);
            let white = point.raw.whiten(noise);
            let weight = white.weights(&self.layout, &point.raw, |norm, m| {
                (robust::median_norm(m) / norm.max(f64::MIN_POSITIVE)).min(1.0)
            });
            let step = subspace.step(&white.partial(&self.layout, &weight), 0.0);
            *point = self.moved(point, &step.change)?;
            self.iterations += 1;
            // Within a tenth of a standard uncertainty per combination the biweight takes over.
            if step.length < 0.1 * (subspace.rank() as f64).sqrt() {
                break;
            }
        }
        *noise = self.first_noise(point);
        Ok(())
    }

    /// Levenberg-Marquardt with the noise as it is; whether it converged to a step no longer than `negligible`.
    ///
    /// Serial correlation has no part in it: estimates that do not lean on it stay right when what looks like memory is
    /// an effect that the chain lacks. It enters the uncertainties.
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
        let noise = &noise.without_memory();
        let biweight = self.options.robust;
        let negligible = negligible.max(self.unresolved(noise));
        let mut damping = 0.0;
        let mut white = point.raw.whiten(noise);
        let mut objective = white.objective(&self.layout, &point.raw, biweight);
        for _ in 0..self.options.max_iterations {
            let weight = self.weights(&point.raw, &white);
            let step = subspace.step(&white.partial(&self.layout, &weight), damping);
            let step = step.times(self.stride(&white, &weight));
            if step.length <= negligible && damping < 1e-3 {
                return Ok(true);
            }
            self.iterations += 1;
            let next = self.moved(point, &step.change)?;
            let next_white = next.raw.whiten(noise);
            let next_objective = next_white.objective(&self.layout, &next.raw, biweight);
            if next_objective <= objective * (1.0 + 1e-9) {
                (*point, white, objective) = (next, next_white, next_objective);
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

    /// By how much a step with weights held fixed falls short of the minimum, because the weights move along.
    ///
    /// Source: Huber and Ronchetti, Robust Statistics, 2nd ed., section 7.8.
    fn stride(&self, white: &White, weight: &[f64]) -> f64 {
        if !self.options.robust {
            return 1.0;
        }
        let (mut weights, mut slopes) = (0.0, 0.0);
        let norms = self.layout.norms(&white.residual);
        for ((norm, &weight), ends) in norms.zip(weight).zip(self.layout.first.windows(2)) {
            let components = ends[1] - ends[0];
            weights += components as f64 * weight;
            slopes += components as f64 * weight + robust::slope(norm, components) * norm;
        }
        if slopes > 0.0 { (weights / slopes).clamp(1.0, 1.5) } else { 1.0 }
    }

    /// The length of a step that only moves the last bits of the prediction.
    fn unresolved(&self, noise: &Noise) -> f64 {
        let resolution = noise::resolution(self.observations);
        noise.sigma.iter().map(|sigma| (resolution / sigma).powi(2)).sum::<f64>().sqrt()
    }

    fn result(self, point: Point, noise: Noise, subspace: &Subspace, converged: bool) -> FitResult {
        let parameters = self.model.parameters().to_vec();
        let (n, rank) = (self.layout.components(), subspace.rank());
        let independent = point.raw.whiten(&noise.without_memory());
        let weight = self.weights(&point.raw, &independent);
        let norms: Vec<f64> = self.layout.norms(&independent.residual).collect();
        let set_aside = self.set_aside(&point, &norms, &weight);
        let kept: f64 = self.layout.row.iter().filter(|&&row| weight[row as usize] > 0.0).count() as f64;
        let degrees_of_freedom = kept - rank as f64;
        let factor = self.variance_factor(&norms, &weight, rank);
        let full = independent.weights(&self.layout, &point.raw, |_, _| 1.0);
        let partial = independent.partial(&self.layout, &full);
        let covariance = match noise.serial {
            None => subspace.covariance(&partial),
            Some(_) => {
                subspace.sandwich(&partial, &independent.coloured(&noise).partial(&self.layout, &full))
            }
        };
        let covariance = scaled(&covariance, factor);
        let mut white = point.raw.whiten(&noise);
        let (mut squares, mut rows) = (0.0, 0.0);
        for (norm, &weight) in self.layout.norms(&point.raw.residual).zip(&weight) {
            if weight > 0.0 {
                squares += norm * norm;
                rows += 1.0;
            }
        }
        for at in 0..n {
            let root = weight[self.layout.row[at] as usize].sqrt();
            white.residual[at] *= root;
            for column in 0..parameters.len() {
                white.jacobian[(at, column)] *= root;
            }
        }
        let outcome = if n <= rank || n == 0 {
            Outcome::TooFewObservations { components: n, parameters: parameters.len() }
        } else if converged {
            Outcome::Converged { iterations: self.iterations }
        } else {
            Outcome::NotConverged { iterations: self.iterations }
        };
        FitResult {
            outcome,
            parameters,
            values: point.values,
            covariance,
            rank,
            null_space: subspace.null_space(),
            separable: subspace.separable(),
            set_aside,
            noise,
            chi_squared: white.residual.iter().map(|r| r * r).sum(),
            degrees_of_freedom,
            rms: if rows > 0.0 { f64::sqrt(squares / rows) } else { 0.0 },
            linear: Linearised {
                raw_residual: point.raw.residual,
                residual: white.residual,
                jacobian: white.jacobian,
                projection: point.raw.projection,
                row: self.layout.row,
                weight,
            },
        }
    }

    /// By what (JᵀJ)⁻¹ of the whitened rows must be multiplied to be the covariance of the estimates.
    ///
    /// Source: Huber and Ronchetti, Robust Statistics, 2nd ed., equation (7.83), for norms of several components.
    fn variance_factor(&self, norms: &[f64], weight: &[f64], rank: usize) -> f64 {
        let n = self.layout.components() as f64;
        if self.options.noise.sigma.is_some() {
            return if self.options.robust { 1.0 / robust::EFFICIENCY } else { 1.0 };
        }
        if n <= rank as f64 {
            return f64::INFINITY;
        }
        let (mut squares, mut slopes) = (0.0, 0.0);
        for ((norm, &weight), ends) in norms.iter().zip(weight).zip(self.layout.first.windows(2)) {
            let components = ends[1] - ends[0];
            squares += (weight * norm).powi(2);
            slopes += components as f64 * weight;
            if self.options.robust {
                slopes += robust::slope(*norm, components) * norm;
            }
        }
        // Below a twentieth hardly any row has weight left, and the ratio would say nothing.
        let slope = (slopes / n).max(0.05);
        squares / (n - rank as f64) / (slope * slope)
    }

    fn set_aside(&self, point: &Point, norms: &[f64], weight: &[f64]) -> Vec<SetAside> {
        let rows = norms.iter().zip(weight).zip(&point.raw.defined).enumerate();
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
