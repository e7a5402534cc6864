//! The project's own Rust sources, as the rules read them.

use std::fs;
use std::path::{Path, PathBuf};

/// Where the sources of the library crates are.
pub const LIBRARIES: &[&str] = &[
    "src",
    "model-core/src",
    "claims/src",
    "proof/src",
    "model-macros/src",
    "codegen/src",
    "parallel/src",
    "tables/src",
    "observe/src",
    "effects/src",
    "fit/src",
    "network/src",
    "study/src",
    "calibration/src",
    "evidence/src",
    "class/src",
    "report/src",
    "service/src",
    "init/src",
    "web/src",
];

/// One source file: its path from the root of the workspace, with `/`, and its text.
pub struct SourceFile {
    pub path: String,
    pub text: String,
}

/// The root of the workspace.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Rust file below a folder of the workspace, in order of its path.
pub fn below(folder: &str) -> Vec<SourceFile> {
    let mut paths = Vec::new();
    collect(&root().join(folder), &mut paths);
    paths.sort();
    let files: Vec<SourceFile> = paths
        .into_iter()
        .map(|path| SourceFile {
            text: fs::read_to_string(&path).expect("a source file is UTF-8 text"),
            path: path.strip_prefix(root()).expect("below the root").to_string_lossy().replace('\\', "/"),
        })
        .collect();
    assert!(!files.is_empty(), "{folder} holds no Rust file");
    files
}

/// The sources of every library crate: everything but the command, benchmarks and tests.
pub fn libraries() -> Vec<SourceFile> {
    LIBRARIES.iter().copied().flat_map(below).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("a readable folder").path();
        if path.is_dir() {
            collect(&path, paths);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            paths.push(path);
        }
    }
}

impl SourceFile {
    /// The lines before the unit tests, without comments, numbered from 1.
    pub fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        (1..)
            .zip(self.text.lines())
            .take_while(|(_, line)| line.trim_end() != "#[cfg(test)]")
            .map(|(number, line)| (number, line.split("//").next().unwrap_or_default()))
    }
}
