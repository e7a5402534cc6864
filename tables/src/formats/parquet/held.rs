//! How much memory the pages of a Parquet file take that are open at the same time, one of each column and its dictionary.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The memory of all open pages of a file, in bytes, about.
#[derive(Debug, Clone, Default)]
pub(super) struct Held(Arc<AtomicU64>);

impl Held {
    /// How much it is.
    pub fn bytes(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }

    /// What one column holds of it: nothing yet but what unpacks its pages.
    pub fn share(&self, bytes: u64) -> Share {
        let mut share = Share { all: self.clone(), fixed: 0, page: 0 };
        share.keep(bytes);
        share
    }
}

/// What one column holds, as long as it is open.
#[derive(Debug)]
pub(super) struct Share {
    all: Held,
    fixed: u64,
    page: u64,
}

impl Share {
    /// Takes in what stays until the column is closed.
    pub fn keep(&mut self, bytes: u64) {
        self.fixed += bytes;
        self.all.0.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Takes in a page in place of the last.
    pub fn page(&mut self, bytes: u64) {
        self.all.0.fetch_add(bytes, Ordering::Relaxed);
        self.all.0.fetch_sub(self.page, Ordering::Relaxed);
        self.page = bytes;
    }

    /// What all columns hold.
    pub fn of_all(&self) -> u64 {
        self.all.bytes()
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        self.all.0.fetch_sub(self.fixed + self.page, Ordering::Relaxed);
    }
}
