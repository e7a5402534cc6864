//! Tables of data as files: opened by the ending of their name, read in chunks, written whole.

mod files;
mod joining;
mod readings;
mod write;

use std::fs::File;
use std::io;
use std::path::Path;

use service::Source;
use tables::formats::{self, DataError, Input, Options, TableReader};

use crate::failure::Failure;
use crate::source;
pub use files::Files;
pub use joining::{beside, joining};
pub use readings::open_kept;
#[cfg(feature = "point-clouds")]
pub use readings::open_readings;
pub use write::write;

/// Whether the name of a file is that of a point cloud.
#[must_use]
pub fn is_point_cloud(path: &Path) -> bool {
    ["las", "laz"].contains(&ending(path).as_str())
}

/// Whether the points of a cloud of this name are compressed.
#[cfg(feature = "point-clouds")]
#[must_use]
pub fn is_compressed_cloud(path: &Path) -> bool {
    ending(path) == "laz"
}

fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Refuses a name that promises a format that this build neither reads nor writes.
///
/// # Errors
/// It does.
pub fn known_format(path: &Path) -> Result<(), Failure> {
    if cfg!(not(feature = "parquet")) && ending(path) == "parquet" {
        return Err(failure(DataError::NoParquet { file: path.display().to_string() }));
    }
    if is_point_cloud(path) {
        let why = if cfg!(feature = "point-clouds") {
            "this is a point cloud, which `trueaxis apply` corrects; tables are .csv or .parquet"
        } else {
            "this build does not read or write point clouds: build the command with `--features point-clouds`"
        };
        return Err(Failure::Input(format!("{}: {why}", path.display())));
    }
    if ["gz", "zst", "xz", "bz2", "zip"].contains(&ending(path).as_str()) {
        let message = format!(
            "`{}`: tables are read and written as .csv or .parquet, and not compressed: unpack it first, or name a .csv file",
            path.display()
        );
        return Err(Failure::Input(message));
    }
    if ["toml", "chain"].contains(&ending(path).as_str()) {
        let message = format!(
            "`{}`: this is a text of trueaxis, and a table of data goes here (.csv or .parquet); a study names its tables under `data`",
            path.display()
        );
        return Err(Failure::Input(message));
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

/// Opens a data file that the study names; one that is not there comes with where the study says that it is to be had.
///
/// # Errors
/// It cannot be read.
pub fn open_beside(study: &Source, path: &str, from: Option<&str>) -> Result<Input<'static>, DataError> {
    open_named(&study.beside(Path::new(path)), from)
}

/// Opens a table by its path.
///
/// # Errors
/// It cannot be read, or promises a format that this build does not read.
pub fn open_table(path: &Path, options: &Options) -> Result<Box<dyn TableReader>, DataError> {
    formats::open(open_named(path, None)?, &path.display().to_string(), options)
}

/// Opens a data file by its path; one that is not there comes with where it is to be had.
///
/// # Errors
/// It cannot be read.
pub fn open_named(beside: &Path, from: Option<&str>) -> Result<Input<'static>, DataError> {
    let unreadable = |error: &io::Error| {
        let why = match source::not_readable(beside, error) {
            Failure::Read { why, .. } => why,
            other => other.to_string(),
        };
        let why = match from {
            Some(from) if error.kind() == io::ErrorKind::NotFound => {
                format!("{why}; the study says where the data are to be had: {from}")
            }
            _ => why,
        };
        DataError::Unreadable { file: beside.display().to_string(), why }
    };
    open(beside).map_err(|error| unreadable(&error))
}

/// Opens a data file.
///
/// # Errors
/// It cannot be opened, or is a folder.
pub fn open(path: &Path) -> io::Result<Input<'static>> {
    let file = File::open(path)?;
    match file.metadata() {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if metadata.is_file() => Ok(Input::ranged(file, metadata.len())),
        // Pipes and devices are files too, but have no places.
        _ => Ok(Input::Stream(Box::new(file))),
    }
}
