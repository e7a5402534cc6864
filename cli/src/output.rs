//! Output files: each appears whole or not at all. `-` is standard output.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Writes a whole text; `-` prints it.
///
/// # Errors
/// The place cannot be written.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    write_with(path, |file| file.write_all(text.as_bytes()).map_err(|error| Failure::write(path, &error)))
}

/// Writes a file by way of a neighbour that takes its name only when complete; `-` is standard output.
///
/// # Errors
/// The place cannot be written, or `write` failed; nothing has appeared there then.
pub fn write_with(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let fail = |error: io::Error| Failure::write(path, &error);
    if path == Path::new("-") {
        let mut out = BufWriter::new(io::stdout().lock());
        write(&mut out)?;
        return out.flush().map_err(fail);
    }
    // A device or a pipe is written to as it is: it has no name to take over.
    if fs::metadata(path).is_ok_and(|place| !place.is_file() && !place.is_dir()) {
        let mut file = BufWriter::new(File::options().write(true).open(path).map_err(fail)?);
        write(&mut file)?;
        return file.flush().map_err(fail);
    }
    if path.is_dir() {
        return Err(fail(io::ErrorKind::IsADirectory.into()));
    }
    let partial = Partial(partial_name(path));
    let mut file = BufWriter::new(File::create(&partial.0).map_err(fail)?);
    write(&mut file)?;
    let file = file.into_inner().map_err(|error| fail(error.into_error()))?;
    file.sync_all().map_err(fail)?;
    fs::rename(&partial.0, path).map_err(fail)
}

/// A file that is removed again unless it was renamed.
struct Partial(PathBuf);

impl Drop for Partial {
    fn drop(&mut self) {
        // After the renaming there is nothing under this name, and that is as it should be.
        let _ = fs::remove_file(&self.0);
    }
}

/// A name beside `path`, in the same folder so that renaming is one step.
fn partial_name(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.partial", std::process::id()));
    path.with_file_name(name)
}
