//! Output files: each appears whole or not at all. `-` is standard output.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::terminal;

/// Writes a whole text; `-` prints it.
///
/// # Errors
/// The place cannot be written.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    if path == Path::new("-") {
        return terminal::print(text);
    }
    write_with(path, |file| file.write_all(text.as_bytes()))
}

/// Writes a file by way of a neighbour that takes its name only when complete.
///
/// # Errors
/// The place cannot be written; nothing has appeared there then.
pub fn write_with(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<(), Failure> {
    let fail = |error| Failure::write(path, &error);
    // A device or a pipe is written to as it is: it has no name to take over.
    if fs::metadata(path).is_ok_and(|place| !place.is_file() && !place.is_dir()) {
        let mut file = BufWriter::new(File::options().write(true).open(path).map_err(fail)?);
        return write(&mut file).and_then(|()| file.flush()).map_err(fail);
    }
    if path.is_dir() {
        return Err(fail(std::io::ErrorKind::IsADirectory.into()));
    }
    let partial = Partial(partial_name(path));
    let mut file = BufWriter::new(File::create(&partial.0).map_err(fail)?);
    write(&mut file).and_then(|()| file.flush()).map_err(fail)?;
    file.into_inner().map_err(|error| fail(error.into_error()))?.sync_all().map_err(fail)?;
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
