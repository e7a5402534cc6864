//! The fit of more rows than memory holds: each pass takes the rows chunk by chunk into a tally, and tallies merge.
//!
//! The contract for any engine that deals out chunks: [`Pass::accumulate`] makes a [`Tally`] of a chunk, tallies of parts
//! [`Tally::merge`], and [`Streamed::next`] makes of the tallies of whole files the next pass, until there is none. Memory
//! is that of one chunk. The noise is a floor for each kind of component; memory between rows is not looked for, but errors
//! that the rows of a file share.

use faer::Mat;
use model_core::{Chain, SymbolId, SymbolKind};

use super::estimable::variance_of;
use super::fingerprint::fingerprint;
use super::model::Model;
use super::normal::Rest;
use super::partial::{Partial, PartialError};
use super::size::UNSHOWN;
use super::stated::{Agreement, Stated};
use super::subspace::Subspace;
use super::sweep::{Tally, Weighting, tally};
use super::units::{SharedByUnits, shared};
use super::{FitError, FitOptions, fit, robust};
use crate::noise::{self, Layout, NoiseOptions};
use observe::Observations;

/// A step this short, in standard uncertainties, ends the passes.
const NEGLIGIBLE: f64 = 1e-4;

/// Floors are known when none changes by more than this share.
const FLOOR_KNOWN: f64 = 1e-3;

/// Passes at most.
const PASSES: usize = 30;

/// One pass over the rows: everything that a chunk's tally depends on.
#[derive(Debug, Clone)]
pub struct Pass {
    pub(super) model: Model,
    /// The value of every symbol, SI, by symbol.
    pub(super) values: Vec<f64>,
    /// Standard deviation of each kind of component, rad or m, or a factor on what the data state.
    pub(super) floor: Vec<f64>,
    pub(super) noise: NoiseOptions,
    pub(super) weighting: Weighting,
}

/// A streamed fit between passes.
#[derive(Debug, Clone)]
pub struct Streamed {
    /// The pass to make next.
    pub pass: Pass,
    /// What all rows determine with every error at zero: the first pass tells.
    subspace: Option<Subspace>,
    /// Where the second pass begins: the value of every symbol, SI, by symbol, and how rows are weighed from there on.
    begin: (Vec<f64>, Weighting),
    /// Of each parameter its size where the data do not show it, and where it is expected, SI.
    expected: Vec<[f64; 2]>,
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
    /// Covariance of the estimates, p × p, SI, if rows are independent.
    pub covariance: Mat<f64>,
    /// What the rows of a file share; none where they do not, or there are too few files to tell.
    pub shared: Option<SharedByUnits>,
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

impl StreamedResult {
    /// The standard uncertainty of a combination of parameters, each by its place in the covariance with its factor, SI: of independent
    /// rows or, where those of a file share errors, of files.
    #[must_use]
    pub fn standard_uncertainty(&self, combination: &[(usize, f64)]) -> f64 {
        let of = |covariance: &Mat<f64>| variance_of(combination, |i, j| covariance[(i, j)]);
        let of_files = self.shared.as_ref().map_or(0.0, |shared| of(&shared.covariance));
        of(&self.covariance).max(of_files).max(0.0).sqrt()
    }
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
        if let Some(at) = sample.poses.series.iter().position(|series| series.rows.is_empty()) {
            let source = &sample.poses.series[at].source;
            let why = format!("the sample has no rows of series {} ({source})", at + 1);
            return Err(FitError::WrongShape { why });
        }
        if let Some((id, _)) = sample.reading_sigma.first() {
            return Err(FitError::UncertainReadings { name: chain.symbol(*id).name.clone() });
        }
        if options.reference.is_some() {
            return Err(FitError::ReferenceInChunks);
        }
        let options = FitOptions { noise: streamed(&options.noise), ..options.clone() };
        let start = fit(chain, sample, &options)?;
        let model = Model::new(chain, &sample.poses, &options.estimate)?;
        let nominal = chain.nominal_values();
        let size = |at: usize| start.sizes.get(at).map_or(UNSHOWN, |size| size.value);
        let expected = model.parameters().iter().enumerate();
        let expected = expected.map(|(at, parameter)| [size(at), nominal[parameter.index()]]).collect();
        // What is determined is asked with every error at zero.
        let mut values = start.values.clone();
        for parameter in model.parameters().iter().filter(|id| chain.symbol(**id).kind == SymbolKind::Error) {
            values[parameter.index()] = 0.0;
        }
        let pass = Pass {
            model,
            values,
            floor: start.noise.floor.iter().map(|floor| floor.max(f64::MIN_POSITIVE)).collect(),
            weighting: Weighting::Full,
            noise: options.noise.clone(),
        };
        let measures = sample.poses.series.iter().map(|series| series.measure.components());
        let components = measures.flat_map(|count| std::iter::repeat_n(count, count)).collect();
        let begin = (start.values, options.weighting());
        Ok(Self { pass, subspace: None, begin, expected, components, passes: 0 })
    }

    /// Makes of a whole pass the next one, or the result: of the tallies of all files (rows that may share errors), merged in
    /// their order.
    ///
    /// # Errors
    /// Tallies of another pass.
    pub fn next(self, files: &[Tally]) -> Result<Next, PartialError> {
        let whole = files.iter().try_fold(self.pass.empty(), Tally::merge)?;
        Ok(self.after(&whole, files))
    }

    fn after(mut self, tally: &Tally, files: &[Tally]) -> Next {
        self.passes += 1;
        let partial = tally.partial.spread(self.pass.model.column_of());
        let Some(subspace) = self.subspace.clone() else {
            let size = self.expected.iter().map(|[size, _]| *size).collect();
            self.subspace = Some(Subspace::determined(&partial, size));
            (self.pass.values, self.pass.weighting) = self.begin.clone();
            return Next::Pass(Box::new(self));
        };
        let rest = self.rest(&subspace);
        let step = subspace.step(&partial, 0.0, &rest).times(tally.stride());
        let used = subspace.used(&partial, &rest);
        let floor = self.floors(tally, used);
        let known = floor.iter().zip(&self.pass.floor).all(|(a, b)| (a - b).abs() <= FLOOR_KNOWN * b);
        // What as many numbers fit as there are is no estimate.
        let is_over = partial.components as f64 > used;
        let settled = known && step.length <= NEGLIGIBLE * (subspace.rank() as f64).sqrt();
        if settled || self.passes >= PASSES {
            let converged = settled && is_over;
            return Next::Done(Box::new(self.result(&subspace, tally, files, &partial, converged)));
        }
        for (parameter, change) in self.pass.model.parameters().iter().zip(&step.change) {
            self.pass.values[parameter.index()] += change;
        }
        self.pass.floor = floor;
        Next::Pass(Box::new(self))
    }

    /// Where what is not determined stands under its prior.
    fn rest(&self, subspace: &Subspace) -> Rest {
        if subspace.rank() == subspace.parameters() {
            return Rest::Still;
        }
        let parameters = self.pass.model.parameters().iter().zip(&self.expected);
        let deviation: Vec<f64> =
            parameters.map(|(id, [_, expected])| self.pass.values[id.index()] - expected).collect();
        Rest::Prior(subspace.strain(&deviation))
    }

    fn result(
        self,
        subspace: &Subspace,
        tally: &Tally,
        files: &[Tally],
        partial: &Partial,
        converged: bool,
    ) -> StreamedResult {
        let rest = self.rest(subspace);
        let used = subspace.used(partial, &rest);
        let found = tally.variance_factor(partial.components as f64, used);
        let robust = self.pass.weighting == Weighting::Biweight;
        let efficiency = if robust { robust::EFFICIENCY } else { 1.0 };
        let left = (partial.components as f64 - used).max(0.0);
        // What is stated holds unless the residuals speak against it.
        let agrees = self.pass.noise.known().is_some()
            && Stated::compared(found * efficiency, left).agreement == Agreement::Agrees;
        let factor = if agrees { 1.0 / efficiency } else { found };
        let root = subspace.covariance_root(partial, &rest);
        let by_prior = &root * (root.transpose() * subspace.precision_root(&rest));
        let by_prior = &by_prior * by_prior.transpose();
        let of_data = &root * root.transpose() - &by_prior;
        // The factor is weighted; dividing by the mean weight makes up for it.
        let mean = (tally.weights / partial.components as f64).max(f64::MIN_POSITIVE);
        let covariance = of_data * faer::Scale(factor * mean) + by_prior;
        let variance = tally.weighted_squares / left.max(1.0) / mean;
        let of_files: Vec<Partial> =
            files.iter().map(|file| file.partial.spread(self.pass.model.column_of())).collect();
        let shared = shared(&of_files, &root, variance, tally.stride());
        StreamedResult {
            parameters: self.pass.model.parameters().to_vec(),
            values: self.pass.values,
            covariance,
            shared,
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
    fn floors(&self, tally: &Tally, used: f64) -> Vec<f64> {
        let components = tally.partial.components as f64;
        let lost = components / (components - used).max(1.0);
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

/// Of the noise, what a stream can find out about it.
pub(super) fn streamed(noise: &NoiseOptions) -> NoiseOptions {
    NoiseOptions { variance: false, serial: false, ..noise.clone() }
}

impl Pass {
    /// A tally without rows.
    #[must_use]
    pub fn empty(&self) -> Tally {
        Tally { pass: self.fingerprint(), ..Tally::new(self.model.columns(), self.floor.len()) }
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
        let tally = tally(&self.model, chunk, &layout, &self.values, &noise.sigma, self.weighting)?;
        Ok(Tally { pass: self.fingerprint(), ..tally })
    }

    /// What tells the tallies of this pass from those of others.
    fn fingerprint(&self) -> u64 {
        let numbers = self.values.iter().chain(&self.floor).map(|number| number.to_bits());
        fingerprint(numbers.chain([self.weighting as u64]))
    }
}
