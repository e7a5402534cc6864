//! The fit: declared errors (and freed constants) from observations, on the exact form.
//!
//! Weighted nonlinear least squares by Levenberg-Marquardt, robust and with a noise model; how it ended is an
//! [`Outcome`], never a panic.

mod align;
mod beam;
mod beside_reference;
mod block;
mod cluster;
mod coordinates;
mod descent;
mod estimable;
mod few;
mod fingerprint;
mod freed;
mod mixing;
mod model;
pub mod noise;
mod normal;
pub mod objects;
mod outcome;
mod partial;
mod prior;
pub(crate) mod readings;
mod reference;
mod reflections;
pub mod robust;
mod sets;
mod shared;
mod shrinking;
mod size;
mod solve;
mod solver;
mod spare;
mod starts;
mod stated;
mod stream;
mod subspace;
pub mod sweep;
mod turns;
mod uncertainty;
mod units;
mod validation;
mod wire;

use std::sync::Arc;

use faer::Mat;
use model_core::{Chain, SymbolId, SymbolKind};

use crate::noise::{Noise, NoiseOptions};
use sweep::Weighting;

pub use align::align_robustly;
pub use beam::range_of;
pub use block::Block;
pub use estimable::Estimable;
pub use estimable::variance_of;
pub use model::Model;
pub use normal::{Rest, Step};
pub use outcome::{Outcome, Reason, SetAside, Why};
pub use partial::{Partial, PartialError, Rows};
pub use readings::{correlated, pulled, pulls};
pub use reference::{FromReference, Input, Reference};
pub use size::BESIDE_OBJECTS;
pub use size::{Size, SizeOrigin};
pub use solve::{fit, fit_by};
pub use stated::{Agreement, Stated};
pub use stream::{Next, Pass, Streamed, StreamedResult};
pub use subspace::Subspace;
pub use sweep::Tally;
pub use sweep::residuals;
pub use units::SharedByUnits;
pub use validation::{Foretelling, Validation};
pub use wire::PassError;

/// What to fit and how.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// The errors and constants to estimate, in the order of the result.
    pub estimate: Vec<SymbolId>,
    /// The value of every symbol at the start, SI, indexed by symbol; those not estimated keep it. Where rows observe objects,
    /// their numbers and those of stations may stand behind them: else they start from where the observations say they are.
    pub start: Vec<f64>,
    /// Whether observations far from the rest lose their weight (Tukey's biweight on the observation's norm).
    pub robust: bool,
    /// What is known of the noise, and what to find out about it.
    pub noise: NoiseOptions,
    /// The greatest number of steps of one fit.
    pub max_iterations: usize,
    /// The size of errors as far as it is known, as a standard deviation, SI: what those are given that the data do not show.
    pub sizes: Vec<(SymbolId, f64)>,
    /// Whether a combination counts as shown only where the data say more of it than the sizes do. Where nobody knows where
    /// anything is, an arm could else shrink until its residuals vanish.
    pub anchored: bool,
    /// Whether a fit that ends far off starts from other values as well.
    pub other_starts: bool,
    /// How uncertain the reference is, where anything is stated of it.
    pub reference: Option<Reference>,
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
            sizes: Vec::new(),
            anchored: false,
            other_starts: true,
            reference: None,
        }
    }

    fn weighting(&self) -> Weighting {
        if self.robust { Weighting::Biweight } else { Weighting::Full }
    }
}

/// The residuals at the estimate: what the search for missing effects starts from.
///
/// `n` components of all observations, row by row.
#[derive(Debug, Clone)]
pub struct Residuals {
    /// Measured minus predicted before whitening, rad or m, length n.
    pub raw: Vec<f64>,
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
    /// The value of every symbol of the chain, SI, indexed by symbol: estimates, and what was held fixed. Behind them the
    /// numbers of objects and stations, where rows observe any.
    pub values: Vec<f64>,
    /// Covariance of the estimates, p × p, SI, infinite where the data leave no degrees of freedom to know it from. What is not
    /// determined is as uncertain as its [size](Self::sizes) says, and its influence on the rest is in it.
    pub covariance: Mat<f64>,
    /// Per parameter the degrees of freedom of its variance, for Student's t; infinite where the noise is stated.
    pub parameter_degrees_of_freedom: Vec<f64>,
    /// Independent combinations that these data determine, as many as the rank, with their values.
    pub estimable: Vec<Estimable>,
    /// The number of combinations that these data determine.
    pub rank: usize,
    /// Combinations that these data cannot determine, p × (p − rank), columns of length one in SI units, each with as few
    /// parts as the others leave it.
    pub null_space: Mat<f64>,
    /// Per parameter, whether no undetermined combination holds it.
    pub separable: Vec<bool>,
    /// Per parameter, whether some determined combination holds it: these data show nothing of the others.
    pub shown: Vec<bool>,
    /// Per parameter how large it may be where the data do not show it; empty where they show everything.
    pub sizes: Vec<Size>,
    /// The noise that the data state beside the noise that was found; `None` where they state none.
    pub stated: Option<Stated>,
    /// What the reference does to the estimates, input by input; none where nothing is stated of it.
    pub from_reference: Vec<FromReference>,
    /// Rows that were set aside.
    pub set_aside: Vec<SetAside>,
    /// The noise that was assumed and found, which copies share.
    pub noise: Arc<Noise>,
    /// Sum of squares of the whitened residual.
    pub chi_squared: f64,
    /// Components with weight, less the independent numbers that the estimates use up.
    pub degrees_of_freedom: f64,
    /// RMS over the observations kept of the length of the residual: rad or m.
    pub rms: f64,
    /// What the data determine.
    pub subspace: Subspace,
    /// What became of the rest.
    pub(crate) rest: Rest,
    /// The triangular factor of the derivatives by each parameter, whitened but for memory between rows, each row by the
    /// root of its robust weight.
    pub factor: Partial,
    /// The residuals, which copies share: of many rows they are most of what a fit holds.
    pub residuals: Arc<Residuals>,
}

impl FitResult {
    /// The standard uncertainty of a parameter, SI; `None` if it was not estimated or these data do not tell.
    #[must_use]
    pub fn standard_uncertainty(&self, parameter: SymbolId) -> Option<f64> {
        let at = self.parameters.iter().position(|&id| id == parameter)?;
        Some(self.covariance[(at, at)].sqrt()).filter(|uncertainty| uncertainty.is_finite())
    }

    /// Half the width of the interval that holds a parameter with this confidence (0.95, say), SI; `None` where nothing is known.
    #[must_use]
    pub fn half_width(&self, parameter: SymbolId, confidence: f64) -> Option<f64> {
        let at = self.parameters.iter().position(|&id| id == parameter)?;
        let freedom = self.parameter_degrees_of_freedom[at];
        estimable::half_width(self.standard_uncertainty(parameter)?, freedom, confidence)
    }

    /// (JᵀJ)⁻¹ of the whitened and weighted rows, the prior of what is not determined included, p × p, SI.
    #[must_use]
    pub fn design_covariance(&self) -> Mat<f64> {
        let root = self.design_root();
        &root * root.transpose()
    }

    /// A matrix whose product with its own transpose is [that](Self::design_covariance).
    #[must_use]
    pub fn design_root(&self) -> Mat<f64> {
        self.subspace.covariance_root(&self.factor, &self.rest)
    }
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
    /// Readings are not exact, where rows are fitted chunk by chunk.
    #[error(
        "the readings of `{name}` state how uncertain they are: rows that are read chunk by chunk are weighed by what is measured \
         alone. Leave out its `sigma`, or calibrate with all rows in memory"
    )]
    UncertainReadings {
        /// The joint or input.
        name: String,
    },
    /// Chunk by chunk nobody sees what rows have in common.
    #[error(
        "`[reference]` states what rows have in common: rows that are read chunk by chunk are fitted as independent ones. Leave out \
         `[reference]`, or calibrate with all rows in memory"
    )]
    ReferenceInChunks,
    /// Of objects and stations their own uncertainties are stated.
    #[error(
        "rows observe unknown objects: write `sigma` under `[objects]` and `[stations]`, and leave out `[reference]`"
    )]
    ReferenceOfObjects,
    /// Each target is three unknowns.
    #[error(
        "{targets} targets have several rows each, and `[reference]` takes {most} at most: leave out `targets`, or name fewer by a \
         column of labels"
    )]
    TooManyTargets {
        /// Targets that several rows share.
        targets: usize,
        /// As many as can be.
        most: usize,
    },
    /// Beyond what can be reckoned with.
    #[error("`[reference]` states uncertainties that are too large for these rows: write smaller ones")]
    ReferenceTooLarge,
    /// A joint or input that the observable depends on has no readings.
    #[error("no readings of `{name}`, which `{observable}` depends on")]
    NoReadings {
        /// The joint or input.
        name: String,
        /// The observable.
        observable: String,
    },
}
