//! How likely a model makes the data, and what it pays for its parameters.

/// The largest log-likelihood of a model with normal noise of unknown size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Likelihood {
    /// The log-likelihood, up to a constant of the data.
    pub log: f64,
    /// Rows that it stands on.
    pub rows: usize,
    /// Coefficients and thresholds that were fitted for it.
    pub parameters: usize,
}

impl Likelihood {
    /// Of a model that leaves this sum of squares.
    #[must_use]
    pub fn of(rss: f64, rows: usize, parameters: usize) -> Self {
        Self { log: -(rows as f64) / 2.0 * rss.max(f64::MIN_POSITIVE).ln(), rows, parameters }
    }

    /// What is to be believed: half a Schwarz criterion.
    #[must_use]
    pub fn penalised(self) -> f64 {
        self.log - self.parameters as f64 / 2.0 * (self.rows as f64).ln()
    }

    /// What the model is expected to make of data like these: the log-likelihood less its parameters.
    ///
    /// Source: H. Akaike, "A new look at the statistical model identification", IEEE Transactions on Automatic Control 19 (1974).
    #[must_use]
    pub fn expected(self) -> f64 {
        self.log - self.parameters as f64
    }
}
