//! What acts outside the measured region: rungs of models are weighed by regions left out, fixed at calibration.
//!
//! A rung is a model that predicts: the declared chain alone (the first), laws, the full mixture, and any other. The
//! engine knows no chain: a caller fits rungs without some rows and predicts.

mod regions;
mod weigh;

pub use regions::{Region, Side, regions};
pub use weigh::{Answer, OutsideSet, Stack, Struck};

use crate::error::Error;
use crate::policy::Policy;

/// What a rung predicts for some rows, m components each, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// Mean of each value.
    pub mean: Vec<f64>,
    /// Standard uncertainty of the mean.
    pub uncertainty: Vec<f64>,
    /// Standard deviation of the noise of a reading.
    pub noise: Vec<f64>,
}

/// Models that predict, from the declared chain alone upwards.
pub trait Rungs {
    /// Names of the rungs, the declared chain alone first.
    fn names(&self) -> Vec<String>;

    /// Joints of each measured row.
    fn poses(&self) -> &[Vec<f64>];

    /// Measured components of a row.
    fn components(&self) -> usize;

    /// Measured values of some rows.
    fn measured(&self, rows: &[usize]) -> Vec<f64>;

    /// Limits of each joint, where they are known.
    fn limits(&self) -> Vec<Option<(f64, f64)>>;

    /// What each rung, fitted from nothing to some rows by the whole search, predicts for other measured rows.
    ///
    /// # Errors
    ///
    /// Where a rung cannot be fitted, in words.
    fn refitted(&self, fitted: &[usize], asked: &[usize]) -> Result<Vec<Predicted>, String>;

    /// What each rung, fitted to all rows, predicts at poses.
    ///
    /// # Errors
    ///
    /// Where a rung cannot be evaluated, in words.
    fn predicted(&self, poses: &[Vec<f64>]) -> Result<Vec<Predicted>, String>;
}

/// Weighs the rungs of a study by leaving out regions, and fixes what acts in each set outside.
///
/// # Errors
///
/// A rung that cannot be fitted or evaluated, or predictions of a wrong length.
pub fn stack(rungs: &dyn Rungs, policy: &Policy) -> Result<Stack, Error> {
    weigh::stack(rungs, policy)
}
