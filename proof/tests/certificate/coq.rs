//! Running Coq on certificates.

#![allow(
    clippy::expect_used,
    clippy::print_stderr,
    reason = "a test may fail loudly, and says when it is skipped"
)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use proof::{LIBRARY, LIBRARY_FILE};

/// The folder with the library, compiled; `None` where there is no Coq.
///
/// Whoever accepts changes has Coq: there (where `CI` is set) its absence is a failure.
pub fn folder() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    FOLDER
        .get_or_init(|| {
            if Command::new("coqc").arg("--version").output().is_err() {
                assert!(std::env::var_os("CI").is_none(), "Coq is not installed");
                eprintln!("skipped: Coq is not installed (on Debian and Ubuntu: apt-get install coq)");
                return None;
            }
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("certificates");
            fs::create_dir_all(&folder).expect("a folder for certificates");
            fs::write(folder.join(LIBRARY_FILE), LIBRARY).expect("the library");
            let output = coqc(&folder, LIBRARY_FILE);
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(folder)
        })
        .as_deref()
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
