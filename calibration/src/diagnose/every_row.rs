//! What every row says of a calibration whose search read only some of them.

use serde::Serialize;

/// What every row says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EveryRow {
    /// All rows.
    pub rows: u64,
    /// Those of them that the fit of all gives any weight.
    pub used: u64,
    /// The files that they came in.
    pub files: usize,
    /// Whether the fit of every row converged; errors are those of the rows searched otherwise.
    pub converged: bool,
    /// What rows of one file share, if they share anything.
    pub shared_by_files: Option<SharedByFiles>,
    /// The error before and after on the rows that the search did not read.
    pub validation: Option<Foretold>,
}

/// What rows of one file share.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SharedByFiles {
    /// The variance of what the files say of the estimates, over what their rows explain.
    pub ratio: f64,
    /// How often files of independent rows scatter as much.
    pub p_value: f64,
}

/// Residuals of rows that nobody fitted, by the estimates of the rows that were searched: RMS of their lengths, SI.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Foretold {
    /// Rows.
    pub rows: u64,
    /// Those that are no outliers.
    pub rows_kept: u64,
    /// By the declaration as it was, over every row.
    pub before: f64,
    /// By the amended one.
    pub after: f64,
    /// By the declaration as it was, without the outliers.
    pub before_kept: f64,
    /// By the amended one.
    pub after_kept: f64,
}
