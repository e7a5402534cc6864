//! A folder of results: its files appear together. A new folder is renamed when it is complete; in one that is there
//! already the files are replaced together, and what else lies in it stays.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::{Batch, Partial};
use crate::failure::Failure;

/// A folder that is being filled.
pub struct Folder {
    path: PathBuf,
    filling: Filling,
}

enum Filling {
    New(Partial),
    There(Batch),
}

impl Folder {
    /// Starts to fill a folder; the folders above it are made if they are not there.
    ///
    /// # Errors
    /// It cannot be made, or a file has its name.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        let fail = |error: io::Error| Failure::write(path, &error);
        let filling = match fs::metadata(path) {
            Ok(place) if place.is_dir() => Filling::There(Batch::default()),
            Ok(_) => return Err(fail(io::Error::other("a file has this name; name a folder"))),
            Err(_) => {
                if let Some(file) = path.ancestors().skip(1).find(|above| above.is_file()) {
                    let why = format!("`{}` is a file; name a folder", file.display());
                    return Err(fail(io::Error::other(why)));
                }
                if let Some(above) = path.parent() {
                    fs::create_dir_all(above).map_err(fail)?;
                }
                Filling::New(Partial::folder(path).map_err(fail)?)
            }
        };
        Ok(Self { path: path.to_owned(), filling })
    }

    /// Writes a file of the folder.
    ///
    /// # Errors
    /// It cannot be written, or `write` failed; the folder is then as it was.
    pub fn write(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let path = self.path.join(name);
        match &mut self.filling {
            Filling::There(batch) => batch.write(&path, write),
            Filling::New(partial) => {
                let fail = |error: io::Error| Failure::write(&path, &error);
                let mut file = BufWriter::new(fs::File::create_new(partial.path().join(name)).map_err(fail)?);
                write(&mut file)?;
                file.into_inner().map_err(|error| fail(error.into_error()))?.sync_all().map_err(fail)
            }
        }
    }

    /// Writes a text of the folder.
    ///
    /// # Errors
    /// As [`Folder::write`].
    pub fn write_text(&mut self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.path.join(name);
        self.write(name, |file| {
            file.write_all(text.as_bytes()).map_err(|error| Failure::write(&path, &error))
        })
    }

    /// Takes a file of an earlier run away, which this run has nothing for.
    pub fn remove(&mut self, name: &str) {
        if let Filling::There(batch) = &mut self.filling {
            batch.remove(&self.path.join(name));
        }
    }

    /// Lets everything appear.
    ///
    /// # Errors
    /// The folder, or a file in it, cannot be put in its place; it is then as it was.
    pub fn finish(self) -> Result<(), Failure> {
        match self.filling {
            Filling::There(batch) => batch.finish(),
            Filling::New(mut partial) => {
                partial.take_name(&self.path).map_err(|error| Failure::write(&self.path, &error))
            }
        }
    }
}
