//! How a fit ended, and what became of rows without weight: with the reason, as data.

use std::fmt;

/// How a fit ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The next step would be negligible against the standard uncertainties.
    Converged {
        /// Steps taken.
        iterations: usize,
    },
    /// The fit failed: its values are the best that were seen, and no estimates.
    NotConverged {
        /// Steps taken.
        iterations: usize,
        /// Why no more were.
        reason: Reason,
    },
    /// No degrees of freedom are left: what the data say of the estimates, they say nothing of their uncertainty.
    TooFewObservations {
        /// Residual components with weight.
        components: usize,
        /// What was to be estimated.
        parameters: usize,
        /// Combinations of them that the data determine.
        rank: usize,
        /// Numbers of objects and stations that the data determine beside them.
        of_objects: usize,
    },
}

/// Why a fit ended before its steps became negligible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The greatest number of steps was reached.
    StepLimit,
    /// No step made the loss smaller, though there was a slope.
    NoDescent,
    /// It ended at a bottom, from which nothing is near what was measured, and so did other starts.
    FarOff,
    /// It ended at a bottom where most rows lie so far from the rest that too few are left.
    NoRest,
}

impl Outcome {
    /// Whether the estimates may be used.
    #[must_use]
    pub fn is_usable(&self) -> bool {
        matches!(self, Self::Converged { .. })
    }
}

/// A row that counts for nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct SetAside {
    /// Index of the row in the observations.
    pub row: usize,
    /// Why.
    pub why: Why,
}

/// Why a row counts for nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Why {
    /// It lies far from the rest.
    Far {
        /// Length of its whitened residual.
        standard_deviations: f64,
    },
    /// The chain has no finite value at its readings.
    NoValue,
}

impl fmt::Display for Why {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Far { standard_deviations } => {
                write!(out, "its residual is {standard_deviations:.1} standard deviations")
            }
            Self::NoValue => write!(out, "the chain has no finite value there"),
        }
    }
}
