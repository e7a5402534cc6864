//! What a table is read from: bytes front to back, or a file, of which a format may read whatever range it needs.

use std::fs::File;
use std::io::{self, Cursor, Read, Stdin};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a table is read from.
pub enum Input<'r> {
    /// Bytes, front to back.
    Stream(Box<dyn Read + Send + 'r>),
    /// A regular file.
    File(InputFile),
}

/// A regular file that tells how far it has been read.
pub struct InputFile {
    pub(super) file: File,
    pub(super) extent: Extent,
}

/// How far a file has been read, while it is.
#[derive(Debug, Clone)]
pub struct Extent {
    read: Arc<AtomicU64>,
    length: u64,
}

impl Extent {
    /// Length of the file, in bytes.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The share that has been read.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.read.load(Ordering::Relaxed) as f64 / self.length.max(1) as f64
    }

    fn add(&self, bytes: u64) {
        self.read.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Says that `done` of `all` rows have been read, wherever in the file they lie.
    #[cfg(feature = "parquet")]
    pub(super) fn rows(&self, done: u64, all: u64) {
        let share = done as f64 / all.max(1) as f64;
        self.read.store((share * self.length as f64) as u64, Ordering::Relaxed);
    }
}

impl Read for InputFile {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(into)?;
        self.extent.add(count as u64);
        Ok(count)
    }
}

impl Input<'_> {
    /// How far a regular file has been read; none of anything else.
    #[must_use]
    pub fn extent(&self) -> Option<Extent> {
        match self {
            Self::Stream(_) => None,
            Self::File(file) => Some(file.extent.clone()),
        }
    }
}

impl<'r> Input<'r> {
    /// The bytes, front to back.
    pub(super) fn front_to_back(self) -> Box<dyn Read + Send + 'r> {
        match self {
            Self::Stream(reader) => reader,
            Self::File(file) => Box::new(file),
        }
    }
}

/// Pipes and devices are files too, but have no ranges.
impl From<File> for Input<'_> {
    fn from(file: File) -> Self {
        match file.metadata() {
            Ok(metadata) if metadata.is_file() => {
                let extent = Extent { read: Arc::default(), length: metadata.len() };
                Self::File(InputFile { file, extent })
            }
            _ => Self::Stream(Box::new(file)),
        }
    }
}

impl From<Stdin> for Input<'_> {
    fn from(input: Stdin) -> Self {
        Self::Stream(Box::new(input))
    }
}

impl<'r> From<&'r [u8]> for Input<'r> {
    fn from(bytes: &'r [u8]) -> Self {
        Self::Stream(Box::new(bytes))
    }
}

impl From<Vec<u8>> for Input<'_> {
    fn from(bytes: Vec<u8>) -> Self {
        Self::Stream(Box::new(Cursor::new(bytes)))
    }
}
