//! A calibration set in type: for the terminal, as a page for a browser, and as files for the next command.
//!
//! Every number and every word of judgement comes from `calibration`; here they only get a form.

mod files;
mod hidden;
mod html;
mod next;
mod pictures;
mod quantities;
mod residuals;
mod summary;

use calibration::calibrate::Calibration;
use calibration::data::Observations;

pub use files::{json, write_all};
pub use summary::{as_text, diff};

/// A calibration and what it was made from.
pub struct Reported<'a> {
    /// What came of it.
    pub calibration: &'a Calibration,
    /// The data that it was made from.
    pub observations: &'a Observations,
    /// The chain's file, as the study names it.
    pub chain_file: &'a str,
    /// The user's declaration as written.
    pub chain_text: &'a str,
    /// The date, as `2026-11-21`.
    pub date: &'a str,
}
