//! What a study or a command line may say of data files: where seeing it from the header would fail, and how much memory their
//! rows may take.

use super::{DataError, Site};

/// What is said of data files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The separator of separated values; seen from the header if `None`.
    pub separator: Option<u8>,
    /// Lines of separated values that begin with this are comments, below the header too. Above it, those that begin with
    /// `#` are in any case.
    pub comment: Option<u8>,
    /// How much memory what is held of one file may take, in bytes.
    pub memory_bytes: u64,
    /// Where the instrument stands, for files that give a time and no place.
    pub site: Option<Site>,
}

impl Default for Options {
    fn default() -> Self {
        Self { separator: None, comment: None, memory_bytes: 2 << 30, site: None }
    }
}

impl Options {
    /// Refuses what takes more memory than it may.
    ///
    /// # Errors
    /// `bytes` are beyond the budget.
    pub fn holds(&self, bytes: usize, file: &str) -> Result<(), DataError> {
        if u64::try_from(bytes).is_ok_and(|bytes| bytes <= self.memory_bytes) {
            return Ok(());
        }
        Err(DataError::TooLarge { file: file.to_string(), budget_bytes: self.memory_bytes })
    }
}
