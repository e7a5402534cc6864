//! Tables of data as files: opened by the ending of their name, read in chunks, written whole.

mod readings;
mod write;

use std::path::Path;

use calibration::formats::DataError;

use crate::failure::Failure;
pub use readings::{ReadingsTable, Rows};
pub use write::{Column, csv_row, csv_rows, write};

/// Rows that are read, computed and written at a time.
pub const CHUNK: usize = 1 << 16;

fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Refuses a name that promises a format that this build neither reads nor writes.
fn known_format(path: &Path) -> Result<(), Failure> {
    if cfg!(not(feature = "parquet")) && ending(path) == "parquet" {
        return Err(failure(DataError::NoParquet { file: path.display().to_string() }));
    }
    if ["xlsx", "xls", "ods", "arrow", "feather"].contains(&ending(path).as_str()) {
        let message = format!(
            "`{}`: tables are read and written as .csv or .parquet; convert it first",
            path.display()
        );
        return Err(Failure::Input(message));
    }
    Ok(())
}

/// A mistake in a data file; its text names the file and the place.
pub fn failure(error: DataError) -> Failure {
    Failure::Input(error.to_string())
}
