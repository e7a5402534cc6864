//! Output files: each appears whole or not at all, and those of one command together. `-` is standard output.

mod folder;
mod interrupted;
mod partial;
mod place;
mod seen;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

use crate::failure::Failure;
pub use folder::Folder;
use interrupted::TAKING_NAMES;
pub use interrupted::clean_up_when_interrupted;
use partial::Partial;
use place::Place;
pub use place::refuse_to_replace;
use seen::Seen;

/// Writes a whole text; `-` prints it.
///
/// # Errors
/// The place cannot be written.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let mut batch = Batch::default();
    batch.write_text(path, text)?;
    batch.finish()
}

/// Writes a file by way of a neighbour that takes its name only when complete; `-` is standard output.
///
/// # Errors
/// The place cannot be written, or `write` failed; nothing has changed there then.
pub fn write_with<T>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let mut batch = Batch::default();
    let written = batch.write(path, write)?;
    batch.finish()?;
    Ok(written)
}

/// Writes a file as [`write_with`] does, whose beginning is known last: what `write` gets can go back, as no stream can.
///
/// # Errors
/// The place cannot be written or is no file, or `write` failed; nothing has changed there then.
#[cfg(feature = "point-clouds")]
pub fn write_file_with(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut batch = Batch::default();
    match Place::of(path).map_err(|error| Failure::write(path, &error))? {
        Place::File(target) => batch.write_file(path, target, write)?,
        Place::StandardOutput | Place::Stream(_) => {
            let why = "its beginning is written last, which a stream does not allow: write a file".to_owned();
            return Err(Failure::Write { path: path.to_owned(), why });
        }
    }
    batch.finish()
}

/// Files that appear together: all of them, or none.
#[derive(Default)]
pub struct Batch {
    staged: Vec<Staged>,
}

/// What is to happen at one place.
struct Staged {
    /// The file as the user named it.
    named: PathBuf,
    /// The file that changes: where links lead.
    target: PathBuf,
    /// What takes its name; none removes what stands there.
    new: Option<Partial>,
    /// What stood there, under a second name until all is done.
    old: Option<Partial>,
}

impl Batch {
    /// Writes a file that appears when the batch is finished. Standard output, a pipe or a device is written at once.
    ///
    /// # Errors
    /// The place cannot be written, or `write` failed.
    pub fn write<T>(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let fail = |error: io::Error| Failure::write(path, &error);
        match Place::of(path).map_err(fail)? {
            Place::StandardOutput => {
                let mut out = BufWriter::new(Seen::new(io::stdout().lock()));
                let written = write(&mut out)?;
                out.flush().map_err(fail)?;
                Ok(written)
            }
            Place::Stream(stream) => {
                let file = File::options().append(true).open(stream).map_err(fail)?;
                let mut file = BufWriter::new(Seen::new(file));
                let written = write(&mut file)?;
                file.flush().map_err(fail)?;
                Ok(written)
            }
            Place::File(target) => self.write_file(path, target, |file| write(file)),
        }
    }

    fn write_file<T>(
        &mut self,
        path: &Path,
        target: PathBuf,
        write: impl FnOnce(&mut BufWriter<File>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let fail = |error: io::Error| Failure::write(path, &error);
        let (partial, file) = Partial::file(&target).map_err(fail)?;
        let mut file = BufWriter::new(file);
        let written = write(&mut file)?;
        file.into_inner().map_err(|error| fail(error.into_error()))?.sync_all().map_err(fail)?;
        self.staged.push(Staged { named: path.to_owned(), target, new: Some(partial), old: None });
        Ok(written)
    }

    /// Writes a text, as [`Batch::write`] does.
    ///
    /// # Errors
    /// The place cannot be written.
    pub fn write_text(&mut self, path: &Path, text: &str) -> Result<(), Failure> {
        self.write(path, |file| file.write_all(text.as_bytes()).map_err(|error| Failure::write(path, &error)))
    }

    /// Removes a file, if it is there, when the batch is finished.
    fn remove(&mut self, path: &Path) {
        if fs::symlink_metadata(path).is_ok() {
            let (named, target) = (path.to_owned(), path.to_owned());
            self.staged.push(Staged { named, target, new: None, old: None });
        }
    }

    /// Puts every file in its place. If one cannot be, those before it get back what they held.
    ///
    /// # Errors
    /// A place cannot be written.
    pub fn finish(mut self) -> Result<(), Failure> {
        let _whole = TAKING_NAMES.lock().unwrap_or_else(PoisonError::into_inner);
        // One file alone needs no second name for what it replaces: renaming is one step.
        let alone = self.staged.len() == 1;
        for at in 0..self.staged.len() {
            let staged = &mut self.staged[at];
            if let Err(error) = staged.finish(alone) {
                let failure = Failure::write(&staged.named, &error);
                self.staged[..at].iter_mut().rev().for_each(Staged::take_back);
                return Err(failure);
            }
        }
        Ok(())
    }
}

impl Staged {
    fn finish(&mut self, alone: bool) -> io::Result<()> {
        if !alone && fs::symlink_metadata(&self.target).is_ok() {
            self.old = Some(Partial::second_name(&self.target)?);
        }
        match &mut self.new {
            Some(partial) => partial.take_name(&self.target),
            None => fs::remove_file(&self.target),
        }
    }

    /// Undoes [`Staged::finish`], as far as the system lets it: there is a failure to tell already.
    fn take_back(&mut self) {
        let _ = match &mut self.old {
            Some(old) => old.take_name(&self.target),
            None => fs::remove_file(&self.target),
        };
    }
}
