//! Running Coq on certificates.

#![allow(clippy::expect_used, reason = "a test may fail loudly")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use proof::{LIBRARY, LIBRARY_FILE};

/// The folder with the library, compiled; `None` where there is no Coq.
pub fn folder() -> Option<&'static Path> {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    testkit::tool(testkit::COQ)?;
    let folder = FOLDER.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("certificates");
        fs::create_dir_all(&folder).expect("a folder for certificates");
        fs::write(folder.join(LIBRARY_FILE), LIBRARY).expect("the library");
        let output = coqc(&folder, LIBRARY_FILE);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        folder
    });
    Some(folder)
}

/// What Coq prints of a certificate that it accepts, and what it says of one that it refuses.
pub fn check(folder: &Path, name: &str, text: &str) -> Result<String, String> {
    let file = format!("{name}.v");
    fs::write(folder.join(&file), text).expect("a certificate");
    let output = coqc(folder, &file);
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

fn coqc(folder: &Path, file: &str) -> Output {
    Command::new("coqc")
        .args(["-q", "-Q", ".", "TrueAxis", file])
        .current_dir(folder)
        .output()
        .expect("Coq starts")
}
