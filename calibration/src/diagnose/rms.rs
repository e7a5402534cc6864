//! Residuals before and after, as figures over rows.

use serde::Serialize;

/// Root mean square over observations of the length of the residual, SI: over every row, and over the rows kept.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Rms {
    /// On the data that were fitted, every row; absent if the residual has no finite value.
    pub rms: Option<f64>,
    /// The same over rows with weight in the last fit; absent if there are none.
    pub rms_kept: Option<f64>,
    /// On data that no stage saw, every row: a second file, or random folds; absent where nothing could be held out.
    pub held_out_rms: Option<f64>,
    /// The same over rows that are within reach of what the searches without them predict.
    pub held_out_rms_kept: Option<f64>,
    /// How many rows were held out.
    pub held_out_rows: usize,
    /// How many of them are within reach.
    pub held_out_rows_kept: usize,
    /// In regions of the joints that no stage saw, every row; absent where it was not measured.
    pub elsewhere_rms: Option<f64>,
    /// The same over rows that are within reach.
    pub elsewhere_rms_kept: Option<f64>,
}

/// Of the declaration as it was, and of the amended one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct BeforeAfter {
    pub before: Rms,
    pub after: Rms,
}
