//! A calibration of files: what `calibrate` reads, with checksums and dates, and what it may not replace.

use std::fs;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};

use calibration::calibrate::Stage;
use report::FileRead;
use service::report_files::file_names;
use service::{Calibrated, Made, Measured, Source, Studied};
use tables::formats::sha256;

use crate::failure::Failure;
use crate::table_files::Files;
use crate::{date, output, source, table_files, terminal};

/// Resolves a study with the declaration that it names, a file beside it.
///
/// # Errors
/// What is wrong with either, each with its place.
pub fn studied(study: Source) -> Result<Studied, Failure> {
    Studied::read(study, &terminal::warn, source::read_beside)
}

/// Where the tables of a study are, if they are files.
#[must_use]
pub fn table_files(studied: &Studied) -> Vec<PathBuf> {
    studied.tables().map(|path| studied.study.beside(Path::new(path))).collect()
}

/// Refuses to write the files of a calibration over what the study reads.
///
/// # Errors
/// One of them is a file that the study reads, by whatever names.
pub fn refuse_to_replace(studied: &Studied, folder: &Path) -> Result<(), Failure> {
    let tables = table_files(studied);
    let read = || tables.iter().chain([&studied.study.path, &studied.chain.path]).map(PathBuf::as_path);
    file_names(&studied.plan).try_for_each(|name| output::refuse_to_replace(&folder.join(name), read()))
}

/// Runs the loop, of today; `command` says in the report how it was asked for, `files` are those that the tables were read from, and `tell`
/// hears of each stage.
///
/// # Errors
/// The study asks for something that cannot be fitted; a file has changed since it was read.
pub fn calibrate(
    measured: Measured,
    files: &Files,
    command: String,
    tell: &(dyn Fn(Stage) + Sync),
) -> Result<Calibrated, Failure> {
    let made = Made { version: env!("CARGO_PKG_VERSION"), command, date: date::today() };
    let studied = measured.studied.clone();
    let (calibrated, read) = std::thread::scope(|scope| {
        // Checksums of large files take as long as some of the loop, which does not use every processor all the time.
        let read = scope.spawn(|| files_read(&studied, files));
        let calibrated = measured.calibrate(made, tell);
        (calibrated, read.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    let mut calibrated = calibrated?;
    calibrated.was_read_from(read?);
    Ok(calibrated)
}

/// The study, the declaration and the data with their checksums. What is no file, a pipe or a table in memory, has been
/// read already.
fn files_read(studied: &Studied, files: &Files) -> Result<Vec<FileRead>, Failure> {
    let study = (studied.study.path.display().to_string(), studied.study.path.clone());
    let chain = (studied.chain_file.clone(), studied.chain.path.clone());
    let tables = studied.tables().map(str::to_owned).zip(table_files(studied));
    let read = |(path, place): (String, PathBuf)| {
        if !fs::metadata(&place).is_ok_and(|metadata| metadata.is_file()) {
            return Ok(FileRead { path, sha256: None });
        }
        let digest = fs::File::open(&place).and_then(sha256::hex);
        let digest = digest.map_err(|error| source::not_readable(&place, &error))?;
        Ok(FileRead { path, sha256: Some(digest) })
    };
    let read: Vec<FileRead> =
        [study, chain].into_iter().chain(tables).map(read).collect::<Result<_, Failure>>()?;
    // A checksum is that of what was calibrated with.
    studied.tables().try_for_each(|path| files.check(path)).map_err(table_files::failure)?;
    Ok(read)
}
