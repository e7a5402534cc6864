//! Why a command could not do its work: always something that the user can mend, and exit code 2.

use std::io;
use std::path::{Path, PathBuf};

use init::NotBegun;
use model_core::Mistakes;
use model_core::escape::message;
use report::NotJson;
use service::Refusal;

/// Why a command could not do its work. `Display` is what the user reads, without the leading
/// `error: `: one line, but for mistakes shown with theirs, in which every letter is seen.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A file could not be read.
    #[error("cannot read `{}`: {}", message(&path.to_string_lossy()), message(why))]
    Read {
        /// The file as the user named it.
        path: PathBuf,
        /// What stood in the way, with what to do instead.
        why: String,
    },
    /// A file could not be written.
    #[error("cannot write `{}`: {}", message(&path.to_string_lossy()), message(why))]
    Write {
        /// The file as the user named it.
        path: PathBuf,
        /// What stood in the way.
        why: String,
    },
    /// Mistakes in a text, with their places; rendered with the lines they stand on.
    #[error("{rendered}")]
    Mistakes {
        /// As people read them.
        rendered: String,
        /// As programs do.
        mistakes: Mistakes,
    },
    /// Whoever read standard output has gone away, as `head` does; no fault of anybody's.
    #[error("standard output is closed")]
    ReaderGone,
    /// Anything else, in words that say what to write instead.
    #[error("{}", message(.0))]
    Input(String),
    /// The same with a list below, a line each.
    #[error("{}{}", message(why), below.iter().map(|line| format!("\n  {}", message(line))).collect::<String>())]
    Listed {
        /// What is wrong.
        why: String,
        /// The lines of the list.
        below: Vec<String>,
    },
}

impl Failure {
    /// A file that could not be read, with the reason in plain words.
    pub fn read(path: &Path, error: &io::Error) -> Self {
        Self::Read { path: path.to_owned(), why: reason(error) }
    }

    /// A file that could not be written, with the reason in plain words.
    pub fn write(path: &Path, error: &io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return Self::ReaderGone;
        }
        let why = match error.kind() {
            io::ErrorKind::NotFound => "the folder it would lie in is not there; create it first".to_owned(),
            _ => reason(error),
        };
        Self::Write { path: path.to_owned(), why }
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Mistakes { rendered, mistakes } => Self::Mistakes { rendered, mistakes },
            Refusal::Input(why) => Self::Input(why),
        }
    }
}

impl From<NotJson> for Failure {
    fn from(error: NotJson) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<NotBegun> for Failure {
    fn from(NotBegun { why, offered }: NotBegun) -> Self {
        Self::Listed { why, below: offered }
    }
}

/// The reason in words that are the same on every system.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file or folder".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder; name a file in it".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "it is read-only; name another file".to_owned(),
        io::ErrorKind::InvalidData => "it is not UTF-8 text; save it as such".to_owned(),
        _ => error.to_string(),
    }
}
