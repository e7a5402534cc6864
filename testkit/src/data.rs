//! The files that tests read: the workspace, and data that others measured. Their licences differ from the project's own, so that they
//! lie beside it.

use std::path::{Path, PathBuf};

use crate::skipped::skip;

/// The root of the workspace.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a folder of the workspace")
}

/// A file of measured data; `None`, with a word on standard error, where it is missing.
///
/// # Panics
///
/// Where the file is missing, `CI` is set, and `TESTS_WITHOUT` does not name `data`.
pub fn measured(file: &str) -> Option<PathBuf> {
    let path = root().join("../shared/data").join(file);
    if path.exists() {
        return Some(path);
    }
    skip("data", "measured by others, in ../shared/data beside the project");
    None
}
