//! What a table is read from: bytes front to back, or what has a length and places, such as a file, of which a format may read
//! whatever range it needs.

use std::io::{self, Cursor, Read, Seek, Stdin};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a table is read from.
pub enum Input<'r> {
    /// Bytes, front to back.
    Stream(Box<dyn Read + Send + 'r>),
    /// What may be read anywhere.
    Ranged(Ranged),
}

/// What may be read anywhere, and tells how far it has been.
pub struct Ranged {
    pub(super) source: Box<dyn ReadSeek>,
    pub(super) extent: Extent,
}

/// Bytes at any place.
pub(super) trait ReadSeek: Read + Seek + Send {}

impl<T: Read + Seek + Send> ReadSeek for T {}

/// How far something has been read, while it is.
#[derive(Debug, Clone)]
pub struct Extent {
    read: Arc<AtomicU64>,
    length: u64,
}

impl Extent {
    /// Length of the whole, in bytes.
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

    /// Says that `done` of `all` rows have been read, wherever they lie.
    #[cfg(feature = "parquet")]
    pub fn rows(&self, done: u64, all: u64) {
        let share = done as f64 / all.max(1) as f64;
        self.read.store((share * self.length as f64) as u64, Ordering::Relaxed);
    }
}

impl Read for Ranged {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(into)?;
        self.extent.add(count as u64);
        Ok(count)
    }
}

impl Ranged {
    fn of(source: impl Read + Seek + Send + 'static, length: u64) -> Self {
        Self { source: Box::new(source), extent: Extent { read: Arc::default(), length } }
    }

    /// Bytes in memory.
    #[cfg(feature = "parquet")]
    pub(super) fn held(bytes: Vec<u8>) -> Self {
        let length = bytes.len() as u64;
        Self::of(Cursor::new(bytes), length)
    }
}

impl Input<'_> {
    /// Something of a length that may be read anywhere, from its beginning on.
    pub fn ranged(source: impl Read + Seek + Send + 'static, length: u64) -> Self {
        Self::Ranged(Ranged::of(source, length))
    }

    /// How far it has been read; none of what comes as a stream.
    #[must_use]
    pub fn extent(&self) -> Option<Extent> {
        match self {
            Self::Stream(_) => None,
            Self::Ranged(own) => Some(own.extent.clone()),
        }
    }
}

impl<'r> Input<'r> {
    /// The bytes, front to back.
    pub(super) fn front_to_back(self) -> Box<dyn Read + Send + 'r> {
        match self {
            Self::Stream(reader) => reader,
            Self::Ranged(own) => Box::new(own),
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
