//! A calibration set in type: for the terminal, as a page for a browser, and as files for the next command.
//!
//! Every number comes from `calibration`'s diagnosis and every sentence from its report; here they only get a form.

mod errors;
mod files;
pub mod page;
mod places;
mod residuals;
mod text;

use calibration::calibrate::Calibration;
use observe::Observations;
use study::Plan;

pub use files::{errors, file_names, found_over, json, rows_written, write_all};
pub use page::{excerpt, page};
pub use residuals::{Cells, table};
pub use text::{Layout, as_text, diff};

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
    /// Version of the command.
    pub version: &'static str,
    /// The command line.
    pub command: String,
    /// The date, as `2026-11-21`.
    pub date: String,
    /// The study's text as written.
    pub study: String,
    /// Every file that was read.
    pub files: Vec<FileRead>,
    /// What the command warned of before it began: what is doubtful of the study and of its data.
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

/// `1 row`, `2 rows`.
fn counted(rows: usize) -> String {
    format!("{rows} row{}", if rows == 1 { "" } else { "s" })
}
