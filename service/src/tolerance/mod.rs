//! Tolerances: what the sizes that a designer allows his errors come to at an observable, and which sizes a wanted error asks
//! for. Nothing here is measured.
//!
//! All of it is to first order in the errors, over the poses of a [`Sensitivity`].
//!
//! - [`root_sum_square`]: what to expect of independent errors, and the share of each.
//! - [`worst_case`]: the most that any combination within the sizes does.
//! - [`simulate`]: draws of all errors at once, to percentiles and yield.
//! - [`allocate`]: the sizes that keep a wanted error at the least cost.
//! - [`after`]: what remains when a campaign of poses has been measured and corrected for.

mod after;
mod allocate;
mod distribution;
mod monte_carlo;
mod registration;
mod spread;
mod worst;

#[cfg(test)]
mod tests;

use model_core::SymbolId;

pub use after::{After, Campaign, after};
pub use allocate::{Allocation, NotAllocated, Wish, allocate};
pub use distribution::{Distribution, DistributionError, Shape, Written};
pub use monte_carlo::{Sample, Simulation, simulate};
pub use registration::registered;
pub use spread::{Spread, root_sum_square};
pub use worst::worst_case;

pub use model_core::budget::Sensitivity;

/// What is allowed of one error.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// The error.
    pub error: SymbolId,
    /// Its size, SI.
    pub size: f64,
    /// How it is spread, in units of the size.
    pub distribution: Distribution,
}

impl Tolerance {
    /// The mean, SI.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.size * self.distribution.mean()
    }

    /// The standard deviation, SI.
    #[must_use]
    pub fn standard_deviation(&self) -> f64 {
        self.size * self.distribution.standard_deviation()
    }
}
