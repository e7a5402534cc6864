//! The fit of more rows than memory holds: each pass takes the rows chunk by chunk into a tally, and tallies merge.
//!
//! The contract for any engine that deals out chunks: [`Pass::accumulate`] makes a [`Tally`] of a chunk, tallies of parts
//! [`Tally::merge`], and [`Streamed::next`] makes of the whole tally the next pass, until there is none. Memory
//! is that of one chunk. The noise is a floor for each kind of component; memory between rows is not looked for.

use faer::Mat;
use model_core::{Chain, SymbolId};
use serde::{Deserialize, Serialize};

use super::dense::Raw;
use super::model::{Block, Model};
use super::partial::Partial;
use super::subspace::Subspace;
use super::{FitError, FitOptions, fit, robust};
use crate::noise::{self, Layout};
use crate::observations::Observations;

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
    /// Standard deviation of each kind of component, rad or m.
    floor: Vec<f64>,
    robust: bool,
}

/// What a pass leaves of rows: its size depends on the numbers of parameters and of kinds alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Rows seen.
    pub rows: u64,
    /// Rows with weight.
    pub kept: u64,
    /// The factor of the whitened and weighted rows.
    pub partial: Partial,
    /// Per kind: sum of weights, and of weighted squares in units of the floor.
    kinds: Vec<[f64; 2]>,
    /// Sums over components of w² r², of w, and of the derivative of w r by r.
    sums: [f64; 3],
    /// Sum over rows kept of the squared length of the residual, rad² or m².
    squares: f64,
}

/// A streamed fit between passes.
#[derive(Debug, Clone)]
pub struct Streamed {
    /// The pass to make next.
    pub pass: Pass,
    /// What the sample determines without errors; what all rows determine extends it.
    subspace: Subspace,
    components: Vec<usize>,
    known: bool,
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
    /// Standard deviation of each kind of component, rad or m.
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
    /// Starts from a sample of the rows that fits in memory: its first chunk, say.
    ///
    /// Every chunk must have the series of the sample, in the same order (each may be empty).
    ///
    /// # Errors
    /// As [`fit`].
    pub fn from_sample(chain: &Chain, sample: &Observations, options: &FitOptions) -> Result<Self, FitError> {
        let mut options = options.clone();
        options.noise.variance = false;
        options.noise.serial = false;
        let start = fit(chain, sample, &options)?;
        let pass = Pass {
            model: Model::new(chain, sample, &options.estimate)?,
            values: start.values,
            floor: start.noise.floor.iter().map(|floor| floor.max(f64::MIN_POSITIVE)).collect(),
            robust: options.robust,
        };
        let raw = Raw::at(&pass.model, sample, &options.start)?;
        let layout = Layout::of(sample);
        let noise = noise::from_medians(&options.noise, sample, &layout, &raw.residual);
        let white = raw.whiten(&noise);
        let every = white.weights(&layout, &raw, |_, _| 1.0);
        let subspace = Subspace::determined(&white.partial(&layout, &every));
        let measures = sample.series.iter().map(|series| series.measure.components());
        let components = measures.flat_map(|count| std::iter::repeat_n(count, count)).collect();
        Ok(Self { pass, subspace, components, known: options.noise.sigma.is_some(), passes: 0 })
    }

    /// Makes of the tally of a whole pass the next one, or the result.
    #[must_use]
    pub fn next(mut self, tally: &Tally) -> Next {
        self.passes += 1;
        let subspace = self.subspace.clone().extended(&tally.partial);
        self.subspace = subspace.clone();
        let [squares, weights, slopes] = tally.sums;
        let stride = if slopes > 0.0 { (weights / slopes).clamp(1.0, 1.5) } else { 1.0 };
        let step = subspace.step(&tally.partial, 0.0).times(stride);
        let floor = self.floors(tally);
        let known = floor.iter().zip(&self.pass.floor).all(|(a, b)| (a - b).abs() <= FLOOR_KNOWN * b);
        let converged = known && step.length <= NEGLIGIBLE * (subspace.rank() as f64).sqrt();
        let lost = (tally.partial.components as f64 - subspace.rank() as f64).max(1.0);
        if converged || self.passes >= PASSES {
            let slope = (slopes / tally.partial.components as f64).max(0.05);
            let scale = if self.known { 1.0 } else { squares / lost / (slope * slope) };
            // The factor is weighted; dividing by the mean weight makes up for it.
            let mean = (weights / tally.partial.components as f64).max(f64::MIN_POSITIVE);
            let covariance = subspace.covariance(&tally.partial) * faer::Scale(scale * mean);
            return Next::Done(Box::new(StreamedResult {
                parameters: self.pass.model.parameters().to_vec(),
                values: self.pass.values,
                covariance,
                rank: subspace.rank(),
                separable: subspace.separable(),
                floor: self.pass.floor,
                rms: (tally.squares / (tally.kept as f64).max(1.0)).sqrt(),
                rows: [tally.rows, tally.kept],
                passes: self.passes,
                converged,
            }));
        }
        for (parameter, change) in self.pass.model.parameters().iter().zip(&step.change) {
            self.pass.values[parameter.index()] += change;
        }
        self.pass.floor = floor;
        Next::Pass(Box::new(self))
    }
}

impl Streamed {
    /// The floors as a whole tally has them.
    fn floors(&self, tally: &Tally) -> Vec<f64> {
        let lost = (tally.partial.components as f64)
            / (tally.partial.components as f64 - self.subspace.rank() as f64).max(1.0);
        let kinds = tally.kinds.iter().zip(&self.components).zip(&self.pass.floor);
        kinds
            .map(|(([weights, squares], &components), &floor)| {
                if self.known || *weights <= 0.0 || *squares <= 0.0 {
                    return floor;
                }
                let consistency = if self.pass.robust { robust::consistency(components) } else { 1.0 };
                floor * (consistency * lost * squares / weights).sqrt()
            })
            .collect()
    }
}

impl Pass {
    /// A tally without rows.
    #[must_use]
    pub fn empty(&self) -> Tally {
        Tally {
            rows: 0,
            kept: 0,
            partial: Partial::new(self.model.parameters().len()),
            kinds: vec![[0.0; 2]; self.floor.len()],
            sums: [0.0; 3],
            squares: 0.0,
        }
    }

    /// Takes in one chunk.
    ///
    /// # Errors
    /// A chunk of other columns or series than the sample.
    pub fn accumulate(&self, chunk: &Observations) -> Result<Tally, FitError> {
        let mut first_kind = vec![0];
        for series in &chunk.series {
            let last = first_kind.last().copied().unwrap_or_default();
            first_kind.push(last + series.measure.components());
        }
        if Layout::of(chunk).kinds != self.floor.len() {
            let why = "a chunk has other series than the sample".to_string();
            return Err(FitError::WrongShape { why });
        }
        let tallies = self.model.map_blocks(chunk, &self.values, |series, rows, block| {
            self.tally(&block, rows.len(), first_kind.get(series).copied().unwrap_or_default())
        })?;
        Ok(tallies.iter().fold(self.empty(), |whole, part| whole.merge(part)))
    }

    fn tally(&self, block: &Block, rows: usize, first_kind: usize) -> Tally {
        let mut tally = self.empty();
        let m = block.residual.len() / rows.max(1);
        let p = self.model.parameters().len();
        let floor = self.floor.get(first_kind..first_kind + m).unwrap_or_default();
        let mut root = vec![0.0; block.residual.len()];
        for (row, residual) in block.residual.chunks_exact(m.max(1)).enumerate() {
            tally.rows += 1;
            if !block.defined.get(row).copied().unwrap_or_default() {
                continue;
            }
            let square: f64 = residual.iter().zip(floor).map(|(r, floor)| (r / floor).powi(2)).sum();
            let norm = square.sqrt();
            let (weight, slope) =
                if self.robust { (robust::weight(norm, m), robust::slope(norm, m)) } else { (1.0, 0.0) };
            tally.sums[0] += weight * weight * square;
            tally.sums[1] += m as f64 * weight;
            tally.sums[2] += m as f64 * weight + slope * norm;
            if weight > 0.0 {
                tally.kept += 1;
                tally.squares += residual.iter().map(|r| r * r).sum::<f64>();
            }
            for (component, (r, floor)) in residual.iter().zip(floor).enumerate() {
                let [weights, squares] = &mut tally.kinds[first_kind + component];
                *weights += weight;
                *squares += weight * (r / floor).powi(2);
                root[row * m + component] = weight.sqrt() / floor;
            }
        }
        let weighted = Mat::from_fn(block.residual.len(), p + 1, |at, column| {
            let value = if column < p { block.jacobian[(at, column)] } else { block.residual[at] };
            value * root[at]
        });
        Tally { partial: tally.partial.clone().with_rows(weighted.as_ref()), ..tally }
    }
}

impl Tally {
    /// The tally of both parts.
    #[must_use]
    pub fn merge(self, other: &Self) -> Self {
        let mut sums = self.sums;
        for (sum, other) in sums.iter_mut().zip(other.sums) {
            *sum += other;
        }
        let mut kinds = self.kinds;
        for (kind, other) in kinds.iter_mut().flatten().zip(other.kinds.iter().flatten()) {
            *kind += other;
        }
        Self {
            rows: self.rows + other.rows,
            kept: self.kept + other.kept,
            partial: self.partial.merge(&other.partial),
            kinds,
            sums,
            squares: self.squares + other.squares,
        }
    }
}
