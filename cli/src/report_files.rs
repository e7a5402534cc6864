//! The files of a calibration, each written whole.

use std::io::Write;
use std::path::Path;

use calibration::diagnose::Shown;
use report::{Cells, Reported};
use service::report_files::{self, PAGE, RESIDUALS};

use crate::failure::Failure;
use crate::output::Folder;
use crate::terminal;

/// Writes `report.html`, `report.json` and, with the rows that are shown, `residuals.csv` into a folder, which is made if it is not there;
/// and, where a usable model came out, the `instrument` as `instrument.toml`, `amended.chain` and `errors.toml`, and `objects.csv` and `stations.csv` where there are such. They appear together, or not at all.
///
/// # Errors
/// The folder or a file cannot be written; nothing has changed then.
pub fn write_all(
    reported: &Reported<'_>,
    shown: &Shown,
    instrument: Option<String>,
    folder: &Path,
) -> Result<(), Failure> {
    let mut files = Folder::new(folder)?;
    let is_left = |name: &str| {
        if folder.join(name).exists() {
            terminal::warn(format_args!("{name} in {} is from an earlier run", folder.display()));
        }
    };
    for (name, text) in report_files::texts(reported, instrument)? {
        match text {
            Some(text) => files.write_text(name, &text)?,
            None => is_left(name),
        }
    }
    for (name, columns) in report_files::tables_of_places(reported) {
        match columns {
            Some(columns) => files.write(name, |file| write_table(&columns, &folder.join(name), file))?,
            None if report_files::file_names(reported.plan).any(|own| own == name) => is_left(name),
            None => {}
        }
    }
    let (residuals, page) = rayon::join(
        || {
            let path = folder.join(RESIDUALS);
            files.write(RESIDUALS, |file| write_table(&report::table(reported, shown), &path, file))
        },
        || report::page(reported),
    );
    residuals?;
    files.write_text(PAGE, &page)?;
    files.finish()
}

/// Columns as separated values into the file of a name.
fn write_table(columns: &[(String, Cells<'_>)], path: &Path, file: &mut dyn Write) -> Result<(), Failure> {
    report::write_csv(columns, file).map_err(|error| Failure::write(path, &error))
}
