//! The files of a calibration, each written whole.

use std::io::Write;
use std::path::Path;

use calibration::diagnose::{Diagnosis, Shown};
use calibration::formats::{Texts, Written};
use model_core::Chain;
use serde::Serialize;

use super::errors::{errors_toml, ranges_of};
use super::page::page;
use super::residuals::Cells;
use super::{Provenance, Reported, diff, residuals};
use crate::errors_file::FoundOver;
use crate::failure::Failure;
use crate::output::Folder;
use crate::{tables, terminal};

/// The number of the promise that the keys of `report.json` are.
const SCHEMA: u32 = 4;

/// The files of a calibration in its folder.
pub const NAMES: [&str; 5] = ["report.html", "report.json", "amended.chain", "errors.toml", "residuals.csv"];

/// Rows that `residuals.csv` has at most, unless all are asked for.
const ROWS: usize = 100_000;

/// Which rows `residuals.csv` has.
#[must_use]
pub fn rows_written(reported: &Reported<'_>, all: bool) -> Shown {
    let most = if all { usize::MAX } else { ROWS };
    Shown::of(reported.observations, &reported.calibration.after, most)
}

/// Writes `report.html`, `report.json` and, with the rows that are shown, `residuals.csv` into a folder, which is made if it is not there;
/// and, where a usable model came out, `amended.chain` and `errors.toml`. They appear together, or not at all.
///
/// # Errors
/// The folder or a file cannot be written; nothing has changed then.
pub fn write_all(reported: &Reported<'_>, shown: &Shown, folder: &Path) -> Result<(), Failure> {
    let mut files = Folder::new(folder)?;
    files.write_text("report.json", &json(reported)?)?;
    let calibration = reported.calibration;
    for (name, text) in [("amended.chain", calibration.amended.clone()), ("errors.toml", errors(reported))] {
        match text {
            Some(text) => files.write_text(name, &text)?,
            None if folder.join(name).exists() => {
                terminal::warn(format_args!("{name} in {} is from an earlier run", folder.display()));
            }
            None => {}
        }
    }
    let (residuals, page) = rayon::join(
        || {
            let path = folder.join("residuals.csv");
            files.write("residuals.csv", |file| write_residuals(reported, shown, &path, file))
        },
        || page(reported),
    );
    residuals?;
    files.write_text("report.html", &page)?;
    files.finish()
}

/// `errors.toml`, where a usable model came out.
#[must_use]
pub fn errors(reported: &Reported<'_>) -> Option<String> {
    let calibration = reported.calibration;
    let date = &reported.provenance.date;
    let values = &calibration.after.values;
    let over = found_over(reported)?;
    Some(errors_toml(&calibration.diagnosis.errors, &calibration.chain, values, date, &over))
}

/// The ranges of the readings that an amended declaration was found over, if a usable model came out.
#[must_use]
pub fn found_over(reported: &Reported<'_>) -> Option<Vec<FoundOver>> {
    let calibration = reported.calibration;
    let amended = Chain::from_text(calibration.amended.as_ref()?).unwrap_or_else(|mistakes| {
        unreachable!("an amended text is read before it is given out: {mistakes}")
    });
    let mut over = ranges_of(reported.observations, &calibration.after.residuals.weight);
    // A side quantity that no effect needed is none of the amended chain's.
    over.retain(|range| amended.find_symbol(&calibration.chain.symbol(range.symbol).name).is_some());
    Some(over)
}

/// `report.json`: the diagnosis, and what it was made with.
#[derive(Serialize)]
struct Json<'a> {
    schema: u32,
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    /// The declaration's change, as a unified diff; empty where nothing was added.
    diff: String,
    provenance: &'a Provenance,
}

/// The report for programs.
///
/// # Errors
/// A number in it is none.
pub fn json(reported: &Reported<'_>) -> Result<String, Failure> {
    let json = Json {
        schema: SCHEMA,
        diagnosis: &reported.calibration.diagnosis,
        diff: diff(reported),
        provenance: reported.provenance,
    };
    serde_json::to_string_pretty(&json)
        .map(|text| text + "\n")
        .map_err(|error| Failure::Input(format!("the report cannot be written as JSON: {error}")))
}

/// One row an observation, as [`table`](super::table) has them; a cell is empty where there is no number.
fn write_residuals(
    reported: &Reported<'_>,
    shown: &Shown,
    path: &Path,
    file: &mut dyn Write,
) -> Result<(), Failure> {
    let columns = residuals::table(reported, shown);
    tables::csv_row(file, path, columns.iter().map(|(name, _)| name.as_str()))?;
    let texts: Vec<Option<Texts>> = columns
        .iter()
        .map(|(_, cells)| if let Cells::Texts(texts) = cells { Some(texts.iter().collect()) } else { None })
        .collect();
    let written = columns.iter().zip(&texts).map(|((_, cells), texts)| match (cells, texts) {
        (Cells::Rows(numbers), _) => Written::Counts(numbers),
        (Cells::Numbers(numbers), _) => Written::Numbers(numbers),
        (Cells::Residuals(numbers), _) => Written::Residuals(numbers),
        (Cells::Texts(_), Some(texts)) => Written::Texts(texts),
        (Cells::Texts(_), None) => unreachable!("texts were gathered above"),
    });
    tables::csv_rows(file, path, &written.collect::<Vec<_>>(), shown.rows.len())
}
