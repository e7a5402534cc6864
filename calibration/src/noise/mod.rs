//! The noise of the observations: how large in each component, how it varies with the joints, and how it
//! remembers the observation before.
//!
//! `σ²` of a component = floor² of its kind · exp(variance model of the joints); in order of acquisition the values
//! so scaled follow ARMA(1,1). Each part is taken up only if the data bear it out.

mod estimate;
mod layout;
mod serial;
mod variance;

use model_core::SymbolId;

pub use estimate::{estimate, from_medians, resolution};
pub use layout::{Layout, Run};

/// What is known of the noise, and what to find out about it.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseOptions {
    /// The standard deviation of every residual component, rad or m; estimated if `None`.
    pub sigma: Option<f64>,
    /// Whether to look for a variance that depends on the joints.
    pub variance: bool,
    /// Whether to look for serial correlation, where the rows are in sequence.
    pub serial: bool,
}

impl Default for NoiseOptions {
    fn default() -> Self {
        Self { sigma: None, variance: true, serial: true }
    }
}

/// The noise that a fit assumed and found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Noise {
    /// Standard deviation of each kind of component (series by series, component by component): rad or m, or a
    /// factor on the standard uncertainties that the data state.
    pub floor: Vec<f64>,
    /// The dependence of the variance on the joints, if one was found.
    pub variance: Option<VarianceModel>,
    /// The serial correlation, if one was found.
    pub serial: Option<Serial>,
    /// Per residual component the standard deviation that whitening divides by, rad or m, length n. With serial
    /// correlation, that of what the value before does not explain.
    pub sigma: Vec<f64>,
    /// Components that follow each other in order of acquisition.
    pub runs: Vec<Run>,
}

/// log variance = Σ coefficient · function of joints and ranges, above the floor.
#[derive(Debug, Clone, PartialEq)]
pub struct VarianceModel {
    /// Functions with their coefficients.
    pub terms: Vec<(VarianceTerm, f64)>,
}

/// A function in the variance model, less its mean over the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VarianceTerm {
    /// Cosine of a multiple of a joint.
    Cos(SymbolId, u8),
    /// Sine of a multiple of a joint.
    Sin(SymbolId, u8),
    /// The logarithm of an input of length: a measured range.
    LogRange(SymbolId),
}

/// ARMA(1,1): x_t = autoregressive · x_{t−1} + e_t + moving_average · e_{t−1}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Serial {
    /// Coefficient of the value before.
    pub autoregressive: f64,
    /// Coefficient of the innovation before.
    pub moving_average: f64,
}

impl Serial {
    /// Standard deviation of the values in units of that of the innovations.
    ///
    /// Source: G. E. P. Box, G. M. Jenkins, Time Series Analysis, section 3.4.3.
    #[must_use]
    pub fn gain(self) -> f64 {
        let (phi, theta) = (self.autoregressive, self.moving_average);
        ((1.0 + 2.0 * phi * theta + theta * theta) / (1.0 - phi * phi)).sqrt()
    }

    /// Turns values into innovations in place; the first value of the run, which nothing precedes, is scaled to the
    /// same variance.
    pub fn whiten(self, column: &mut [f64], run: Run) {
        for component in 0..run.stride {
            let (mut x_before, mut e_before) = (0.0, 0.0);
            for at in (run.start + component..run.end).step_by(run.stride) {
                let Some(value) = column.get_mut(at) else { return };
                let x = *value;
                e_before = if at == run.start + component {
                    x / self.gain()
                } else {
                    x - self.autoregressive * x_before - self.moving_average * e_before
                };
                x_before = x;
                *value = e_before;
            }
        }
    }
}

impl Noise {
    /// Whitens a column of residual components (length n, SI) in place: divides by the standard deviations and
    /// takes out what the observation before it explains. Robust weights are not part of it.
    pub fn whiten(&self, column: &mut [f64]) {
        for (value, sigma) in column.iter_mut().zip(&self.sigma) {
            *value /= sigma;
        }
        if let Some(serial) = self.serial {
            for &run in &self.runs {
                serial.whiten(column, run);
            }
        }
    }
}
