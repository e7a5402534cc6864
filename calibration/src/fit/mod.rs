//! The fit: declared errors (and freed constants) from observations, on the exact form.
//!
//! Weighted nonlinear least squares by Levenberg-Marquardt, robust and with a noise model; how it ended is an
//! [`Outcome`], never a panic.

mod align;
mod model;
pub mod noise;
mod partial;
mod residual;
pub mod robust;
mod solve;
mod stream;
mod subspace;
pub(crate) mod sweep;

use faer::Mat;
use model_core::{Chain, SymbolId, SymbolKind};

use crate::fit::noise::{Noise, NoiseOptions};
use sweep::Weighting;

pub use model::{Block, Model};
pub use partial::{Partial, Rows};
pub use solve::fit;
pub use stream::{Next, Pass, Streamed, StreamedResult};
pub use subspace::{Step, Subspace};
pub use sweep::Tally;

/// What to fit and how.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// The errors and constants to estimate, in the order of the result.
    pub estimate: Vec<SymbolId>,
    /// The value of every symbol at the start, SI, indexed by symbol; those not estimated keep it.
    pub start: Vec<f64>,
    /// Whether observations far from the rest lose their weight (Tukey's biweight on the observation's norm).
    pub robust: bool,
    /// What is known of the noise, and what to find out about it.
    pub noise: NoiseOptions,
    /// The greatest number of steps of one fit.
    pub max_iterations: usize,
}

impl FitOptions {
    /// Every declared error, from zero; robust; noise estimated.
    #[must_use]
    pub fn for_chain(chain: &Chain) -> Self {
        Self {
            estimate: chain.symbols_of(SymbolKind::Error).collect(),
            start: chain.nominal_values(),
            robust: true,
            noise: NoiseOptions::default(),
            max_iterations: 50,
        }
    }

    fn weighting(&self) -> Weighting {
        if self.robust { Weighting::Biweight } else { Weighting::Full }
    }
}

/// How a fit ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The next step would be negligible against the standard uncertainties.
    Converged {
        /// Steps taken.
        iterations: usize,
    },
    /// The greatest number of steps was reached, or no step made the sum of squares smaller.
    NotConverged {
        /// Steps taken.
        iterations: usize,
    },
    /// Fewer residual components than could determine what was to be estimated.
    TooFewObservations {
        /// Residual components there are.
        components: usize,
        /// What was to be estimated.
        parameters: usize,
    },
}

/// A row that the robust weights set aside.
#[derive(Debug, Clone, PartialEq)]
pub struct SetAside {
    /// Index of the row in the observations.
    pub row: usize,
    /// Why: `residual 14.2 standard deviations`.
    pub why: String,
}

/// The residuals at the estimate: what the search for missing effects starts from.
///
/// `n` components of all observations, row by row.
#[derive(Debug, Clone)]
pub struct Residuals {
    /// Measured minus predicted before whitening, rad or m, length n.
    pub raw: Vec<f64>,
    /// Measured minus predicted, whitened: unit variance and independent if the noise model holds, times the
    /// square root of the robust weight; length n.
    pub whitened: Vec<f64>,
    /// The row of each component, length n.
    pub row: Vec<u32>,
    /// The robust weight of each row, 0 to 1.
    pub weight: Vec<f64>,
}

/// What a fit found.
#[derive(Debug, Clone)]
pub struct FitResult {
    /// How it ended.
    pub outcome: Outcome,
    /// What was estimated, in the order of the matrices.
    pub parameters: Vec<SymbolId>,
    /// The value of every symbol of the chain, SI, indexed by symbol: estimates, and what was held fixed.
    pub values: Vec<f64>,
    /// Covariance of the estimates, p × p, SI; combinations that these data cannot determine contribute nothing.
    pub covariance: Mat<f64>,
    /// The number of combinations that these data determine.
    pub rank: usize,
    /// Combinations that these data cannot determine, p × (p − rank), columns of length one in SI units, each with as few
    /// parts as the others leave it.
    pub null_space: Mat<f64>,
    /// Per parameter, whether no undetermined combination holds it.
    pub separable: Vec<bool>,
    /// Rows that were set aside.
    pub set_aside: Vec<SetAside>,
    /// The noise that was assumed and found.
    pub noise: Noise,
    /// Sum of squares of the whitened residual.
    pub chi_squared: f64,
    /// Components with weight, minus rank.
    pub degrees_of_freedom: f64,
    /// RMS over the observations kept of the length of the residual: rad or m.
    pub rms: f64,
    /// What the data determine.
    pub(crate) subspace: Subspace,
    /// The triangular factor of the derivatives by each parameter, whitened but for memory between rows, each row by the
    /// root of its robust weight.
    pub factor: Partial,
    /// The residuals.
    pub residuals: Residuals,
}

/// Why there was nothing to fit: mistakes of the caller, not of the data.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// Nothing to estimate.
    #[error("no error or constant is to be estimated")]
    NothingToEstimate,
    /// Only errors and constants can be estimated.
    #[error("`{name}` is {kind}: only errors and constants can be estimated")]
    NotEstimable {
        /// Its name.
        name: String,
        /// What it is.
        kind: &'static str,
    },
    /// Values or columns of the wrong number or length.
    #[error("observations and chain do not fit each other: {why}")]
    WrongShape {
        /// What differs.
        why: String,
    },
    /// A joint or input that the observable depends on has no readings.
    #[error("no readings of `{name}`, which `{observable}` depends on")]
    NoReadings {
        /// The joint or input.
        name: String,
        /// The observable.
        observable: String,
    },
}
