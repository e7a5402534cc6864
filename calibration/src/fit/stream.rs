//! The fit of more rows than memory holds: each pass takes the rows chunk by chunk into a tally, and tallies merge.
//!
//! The contract for any engine that deals out chunks: [`Pass::accumulate`] makes a [`Tally`] of a chunk, tallies of parts
//! [`Tally::merge`], and [`Streamed::next`] makes of the whole tally the next pass, until there is none. Memory
//! is that of one chunk. The noise is a floor for each kind of component; memory between rows is not looked for.

use faer::Mat;
use model_core::{Chain, SymbolId};

use super::align::starting_values;
use super::model::Model;
use super::partial::Partial;
use super::subspace::Subspace;
use super::sweep::{Tally, Weighting, residuals, tally};
use super::{FitError, FitOptions, fit, robust};
use crate::data::Observations;
use crate::fit::noise::{self, Layout, NoiseOptions};

/// A step this short, in standard uncertainties, ends the passes.
const NEGLIGIBLE: f64 = 1e-4;

/// Floors are known when none changes by more than this share.
const FLOOR_KNOWN: f64 = 1e-3;

/// Passes at most.
const PASSES: usize = 30;

/// One pass over the rows: everything that a chunk's tally depends on.
#[derive(Debug, Clone)]
pub struct Pass {
    model: Model,
    /// The value of every symbol, SI, by symbol.
    values: Vec<f64>,
    /// Standard deviation of each kind of component, rad or m, or a factor on what the data state.
    floor: Vec<f64>,
    noise: NoiseOptions,
    weighting: Weighting,
}

/// A streamed fit between passes.
#[derive(Debug, Clone)]
pub struct Streamed {
    /// The pass to make next.
    pub pass: Pass,
    /// What the sample determines without errors; what all rows determine extends it.
    subspace: Subspace,
    components: Vec<usize>,
    passes: usize,
}

/// What a streamed fit found.
#[derive(Debug, Clone)]
pub struct StreamedResult {
    /// What was estimated, in the order of the covariance.
    pub parameters: Vec<SymbolId>,
    /// The value of every symbol, SI, by symbol.
    pub values: Vec<f64>,
    /// Covariance of the estimates, p × p, SI.
    pub covariance: Mat<f64>,
    /// The number of combinations that the data determine.
    pub rank: usize,
    /// Per parameter, whether no undetermined combination holds it.
    pub separable: Vec<bool>,
    /// Standard deviation of each kind of component, rad or m, or a factor on what the data state.
    pub floor: Vec<f64>,
    /// RMS over the rows kept of the length of the residual, rad or m.
    pub rms: f64,
    /// Rows seen, and those of them with weight.
    pub rows: [u64; 2],
    /// Passes over the rows.
    pub passes: usize,
    /// Whether the last step was negligible.
    pub converged: bool,
}

/// What is to be done after a pass.
#[derive(Debug, Clone)]
pub enum Next {
    /// Another pass.
    Pass(Box<Streamed>),
    /// Nothing: this was found.
    Done(Box<StreamedResult>),
}

impl Streamed {
    /// Starts from a sample of the rows that fits in memory, with some rows of each series: its first chunk, say, or every
    /// hundredth row.
    ///
    /// Every chunk must have the series of the sample, in the same order (there, each may be empty), as
    /// [`Observations::select`] gives them.
    ///
    /// # Errors
    /// As [`fit`]; a sample without rows of some series.
    pub fn from_sample(chain: &Chain, sample: &Observations, options: &FitOptions) -> Result<Self, FitError> {
        if let Some(at) = sample.series.iter().position(|series| series.rows.is_empty()) {
            let source = &sample.series[at].source;
            let why = format!("the sample has no rows of series {} ({source})", at + 1);
            return Err(FitError::WrongShape { why });
        }
        let mut options = options.clone();
        options.noise.variance = false;
        options.noise.serial = false;
        let start = fit(chain, sample, &options)?;
        let model = Model::new(chain, sample, &options.estimate)?;
        let subspace = seen_without_errors(chain, &model, sample, &options)?;
        let pass = Pass {
            model,
            values: start.values,
            floor: start.noise.floor.iter().map(|floor| floor.max(f64::MIN_POSITIVE)).collect(),
            weighting: options.weighting(),
            noise: options.noise,
        };
        let measures = sample.series.iter().map(|series| series.measure.components());
        let components = measures.flat_map(|count| std::iter::repeat_n(count, count)).collect();
        Ok(Self { pass, subspace, components, passes: 0 })
    }

    /// Makes of the tally of a whole pass the next one, or the result.
    #[must_use]
    pub fn next(mut self, tally: &Tally) -> Next {
        self.passes += 1;
        let partial = tally.partial.spread(self.pass.model.column_of());
        let subspace = self.subspace.clone().extended(&partial);
        self.subspace = subspace.clone();
        let step = subspace.step(&partial, 0.0).times(tally.stride());
        let floor = self.floors(tally);
        let known = floor.iter().zip(&self.pass.floor).all(|(a, b)| (a - b).abs() <= FLOOR_KNOWN * b);
        let converged = known && step.length <= NEGLIGIBLE * (subspace.rank() as f64).sqrt();
        if converged || self.passes >= PASSES {
            return Next::Done(Box::new(self.result(tally, &partial, converged)));
        }
        for (parameter, change) in self.pass.model.parameters().iter().zip(&step.change) {
            self.pass.values[parameter.index()] += change;
        }
        self.pass.floor = floor;
        Next::Pass(Box::new(self))
    }

    fn result(self, tally: &Tally, partial: &Partial, converged: bool) -> StreamedResult {
        let subspace = self.subspace;
        let known = self.pass.noise.known().is_some();
        let factor = tally.variance_factor(subspace.rank(), known, self.pass.weighting);
        // The factor is weighted; dividing by the mean weight makes up for it.
        let mean = (tally.weights / partial.components as f64).max(f64::MIN_POSITIVE);
        StreamedResult {
            parameters: self.pass.model.parameters().to_vec(),
            values: self.pass.values,
            covariance: subspace.covariance(partial) * faer::Scale(factor * mean),
            rank: subspace.rank(),
            separable: subspace.separable(),
            floor: self.pass.floor,
            rms: tally.rms(),
            rows: [tally.rows, tally.kept],
            passes: self.passes,
            converged,
        }
    }

    /// The floors as a whole tally has them.
    fn floors(&self, tally: &Tally) -> Vec<f64> {
        let components = tally.partial.components as f64;
        let lost = components / (components - self.subspace.rank() as f64).max(1.0);
        let kinds = tally.kinds.iter().zip(&self.components).zip(&self.pass.floor);
        kinds
            .map(|(([weights, squares], &components), &floor)| {
                if self.pass.noise.known().is_some() || *weights <= 0.0 || *squares <= 0.0 {
                    return floor;
                }
                let robust = self.pass.weighting == Weighting::Biweight;
                let consistency = if robust { robust::consistency(components) } else { 1.0 };
                floor * (consistency * lost * squares / weights).sqrt()
            })
            .collect()
    }
}

/// The combinations that a sample determines where the errors have their starting values.
fn seen_without_errors(
    chain: &Chain,
    model: &Model,
    sample: &Observations,
    options: &FitOptions,
) -> Result<Subspace, FitError> {
    let layout = Layout::of(sample);
    let start = starting_values(chain, sample, options)?;
    let residual = residuals(model, sample, &start)?;
    let noise = noise::from_medians(&options.noise, sample, &layout, &residual);
    let tally = tally(model, sample, &layout, &start, &noise.sigma, Weighting::Full)?;
    Ok(Subspace::determined(&tally.partial.spread(model.column_of())))
}

impl Pass {
    /// A tally without rows.
    #[must_use]
    pub fn empty(&self) -> Tally {
        Tally::new(self.model.columns(), self.floor.len())
    }

    /// Takes in one chunk.
    ///
    /// # Errors
    /// A chunk of other columns or series than the sample.
    pub fn accumulate(&self, chunk: &Observations) -> Result<Tally, FitError> {
        let layout = Layout::of(chunk);
        if layout.kinds != self.floor.len() {
            let why = "a chunk has other series than the sample".to_string();
            return Err(FitError::WrongShape { why });
        }
        let noise = noise::of_floors(self.floor.clone(), &self.noise, chunk, &layout);
        tally(&self.model, chunk, &layout, &self.values, &noise.sigma, self.weighting)
    }
}
