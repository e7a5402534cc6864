//! A calibration set in type: in words, as text, as a page for a browser, as tables and for programs.
//!
//! Every number comes from `calibration`'s diagnosis, and every sentence comes from [`words`]. What is made here are strings; where they go
//! to is for whoever asked.

mod csv;
mod json;
pub mod letters;
pub mod page;
pub mod places;
mod residuals;
mod shell;
pub mod style;
mod text;
pub mod words;
pub mod wrap;

use calibration::calibrate::Calibration;
use observe::Observations;
use study::Plan;

pub use csv::write_csv;
pub use json::{NotJson, json};
pub use page::{excerpt, page};
pub use residuals::{Cells, rows_written, table};
pub use shell::shell_word;
pub use text::{Layout, as_text, diff, why};

/// A calibration and what it was made from.
pub struct Reported<'a> {
    /// What came of it.
    pub calibration: &'a Calibration,
    /// The data that it was made from.
    pub observations: &'a Observations,
    /// What was asked for.
    pub plan: &'a Plan,
    /// The chain's file, as the study names it.
    pub chain_file: &'a str,
    /// The user's declaration as written.
    pub chain_text: &'a str,
    /// The folder that the files go to, if they are written.
    pub folder: Option<&'a str>,
    /// What it was made with.
    pub provenance: &'a Provenance,
}

/// What a calibration was made with: enough to make it again.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: &'static str,
    /// The command line.
    pub command: String,
    /// The date, as `2026-11-21`.
    pub date: String,
    /// The study's text as written.
    pub study: String,
    /// Every file that was read.
    pub files: Vec<FileRead>,
    /// What was warned of before it began: what is doubtful of the study and of its data.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct FileRead {
    /// Its path as the study, or the command line, names it.
    pub path: String,
    /// SHA-256 of its bytes; none for what is no file and can be read once only.
    pub sha256: Option<String>,
}

/// `1 outlier`, `2 outliers`.
fn outliers(rows: usize) -> String {
    format!("{rows} outlier{}", if rows == 1 { "" } else { "s" })
}
