//! The kinds of noise: weights of heavy tails and uneven variance, memory along the order, set-ups that nobody labelled.

pub(crate) mod memory;
pub(crate) mod tails;
pub(crate) mod variance;

pub use memory::Memory;

/// Weights of the rows, with what heavy tails do to the likelihood.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise {
    /// Factor of each value: √u over the relative standard deviation.
    pub weights: Vec<f64>,
    /// Degrees of freedom of the tails; infinite for Gaussian ones.
    pub tails: f64,
    /// Σ (log t-density − log Gaussian density at the weights), less the price of leaving Gaussian tails.
    pub adjust: f64,
    /// Factor of the variance when the weights of t are treated as known.
    pub inflation: f64,
}

impl Noise {
    /// Even noise.
    pub fn even(values: usize) -> Self {
        Self { weights: vec![1.0; values], tails: f64::INFINITY, adjust: 0.0, inflation: 1.0 }
    }

    /// Whether all weights are one.
    pub fn is_even(&self) -> bool {
        self.weights.iter().all(|&weight| weight == self.weights[0])
    }

    /// Σ log weights − ½ m log|C|.
    pub fn log_det(&self, memory: Option<Memory>, rows: usize, components: usize) -> f64 {
        let weights: f64 = self.weights.iter().map(|weight| weight.ln()).sum();
        weights - memory.map_or(0.0, |memory| components as f64 / 2.0 * memory.filter(rows).log_det())
    }
}
