//! The noise of the observations: how large in each component, how it varies with the joints, and how it
//! remembers the observation before.
//!
//! Source: `DIAGNOSIS` step 2 in words: variance model, floor per component, ARMA(1,1) in order of acquisition.

use model_core::SymbolId;

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
    /// Standard deviation of each kind of component (series by series, component by component), rad or m.
    pub floor: Vec<f64>,
    /// The dependence of the variance on the joints, if one was found.
    pub variance: Option<VarianceModel>,
    /// The serial correlation, if one was found.
    pub serial: Option<Serial>,
    /// Per residual component the standard deviation before serial correlation, rad or m, length n.
    pub sigma: Vec<f64>,
    /// Residual components at which a new sequence starts (nothing is remembered across), and the stride to the
    /// same component of the row before.
    pub runs: Vec<Run>,
}

/// log variance = Σ coefficient · function of the joints, around its mean.
#[derive(Debug, Clone, PartialEq)]
pub struct VarianceModel {
    /// Coefficients with the functions they multiply.
    pub terms: Vec<(VarianceTerm, f64)>,
}

/// A function of the joints in the variance model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VarianceTerm {
    /// Cosine of a multiple of a joint.
    Cos(SymbolId, u8),
    /// Sine of a multiple of a joint.
    Sin(SymbolId, u8),
    /// The logarithm of an input of length (a measured range).
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

/// Rows that follow each other: components `start..end`, `stride` components a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// First component.
    pub start: usize,
    /// One past the last component.
    pub end: usize,
    /// Components a row.
    pub stride: usize,
}

impl Noise {
    /// Whitens a column of residual components (length n, SI) in place: divides by the standard deviations and
    /// takes out what the observation before it explains.
    ///
    /// Robust weights are not part of it.
    pub fn whiten(&self, column: &mut [f64]) {
        for (value, sigma) in column.iter_mut().zip(&self.sigma) {
            *value /= sigma;
        }
        let Some(serial) = self.serial else {
            return;
        };
        for run in &self.runs {
            for component in 0..run.stride {
                let (mut x_before, mut e_before) = (0.0, 0.0);
                for at in (run.start + component..run.end).step_by(run.stride.max(1)) {
                    let Some(value) = column.get_mut(at) else { break };
                    let x = *value;
                    e_before = x - serial.autoregressive * x_before - serial.moving_average * e_before;
                    x_before = x;
                    *value = e_before;
                }
            }
        }
    }
}
