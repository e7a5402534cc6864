//! The tables of a study that are files: however often they are read, as they were the first time.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

use service::{Source, Studied};
use tables::formats::{self, DataError, Options, TableReader};

use super::open_beside;

/// Opens the tables of a study; copies know of each other what was read.
#[derive(Clone)]
pub struct Files {
    study: Source,
    /// Where the data are to be had, if they are not there.
    from: Option<String>,
    seen: Arc<Mutex<BTreeMap<PathBuf, Stamp>>>,
}

/// What tells one state of a file from another.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
}

impl Stamp {
    /// Of a regular file; what is none is read once.
    fn of(path: &Path) -> Option<Self> {
        let metadata = fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
        Some(Self { length: metadata.len(), modified: metadata.modified().ok() })
    }
}

impl Files {
    /// Those of a study.
    #[must_use]
    pub fn of(studied: &Studied) -> Self {
        Self::beside(studied.study.clone(), studied.plan.data_from.clone())
    }

    fn beside(study: Source, from: Option<String>) -> Self {
        Self { study, from, seen: Arc::default() }
    }

    /// Opens one by its path as the study writes it.
    ///
    /// # Errors
    /// It cannot be read, or is not what it was when it was read before.
    pub fn open(&self, path: &str, options: &Options) -> Result<Box<dyn TableReader>, DataError> {
        let input = open_beside(&self.study, path, self.from.as_deref())?;
        self.check(path)?;
        formats::open(input, path, options)
    }

    /// Refuses a file that is not what it was when it was first opened.
    ///
    /// # Errors
    /// It is another one.
    pub fn check(&self, path: &str) -> Result<(), DataError> {
        let place = self.study.beside(Path::new(path));
        let Some(now) = Stamp::of(&place) else { return Ok(()) };
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        if *seen.entry(place).or_insert(now) == now {
            return Ok(());
        }
        let why = "the file changed while it was read: run this again when nobody writes to it".to_owned();
        Err(DataError::Unreadable { file: path.to_owned(), why })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_changes_between_two_readings_is_refused() {
        let folder = std::env::temp_dir().join(format!("trueaxis-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let write = |text: &str| fs::write(folder.join("data.csv"), text).unwrap();
        let files = Files::beside(Source::of_text(folder.join("study.toml"), ""), None);
        let open = || files.clone().open("data.csv", &Options::default()).map(|_| ());
        write("a\n1\n");
        assert_eq!([open(), open(), files.check("data.csv")], [Ok(()), Ok(()), Ok(())]);
        write("a\n1\n2\n");
        let why = "the file changed while it was read: run this again when nobody writes to it".to_owned();
        let changed = Err(DataError::Unreadable { file: "data.csv".to_owned(), why });
        assert_eq!([open(), files.check("data.csv")], [changed.clone(), changed]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
