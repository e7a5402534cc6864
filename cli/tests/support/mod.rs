//! Running the whole command as a user would, from the root of the workspace.

#![allow(dead_code, clippy::expect_used, reason = "each suite uses a part, and a test may fail loudly")]

use std::fmt;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a run of the command gave.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// As a snapshot shows it.
impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "exit code {}\n----- stdout\n{}----- stderr\n{}", self.code, self.stdout, self.stderr)
    }
}

/// The root of the workspace, where the examples lie.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("cli lies in the workspace")
}

/// Runs `trueaxis` in the root of the workspace.
pub fn trueaxis(arguments: &[&str]) -> Run {
    run_in(root(), arguments, "")
}

/// Runs `trueaxis` in a folder, with a text on standard input.
pub fn run_in(folder: &Path, arguments: &[&str], stdin: &str) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(arguments)
        .current_dir(folder)
        .env_remove("CLICOLOR_FORCE")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut input = child.stdin.take().expect("piped");
    let output = std::thread::scope(|scope| {
        // Written beside the reading of what comes out, or both sides could wait for each other; a command that
        // stops early does not read its input.
        scope.spawn(move || input.write_all(stdin.as_bytes()));
        child.wait_with_output().expect("the command ends")
    });
    Run {
        code: output.status.code().expect("no signal ends the command"),
        stdout: String::from_utf8(output.stdout).expect("UTF-8"),
        stderr: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

/// A folder for one test, empty at its start.
pub struct Folder(pub PathBuf);

impl Folder {
    /// The folder of a test; the name must be the test's own.
    pub fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        if path.exists() {
            fs::remove_dir_all(&path).expect("an earlier run's folder goes");
        }
        fs::create_dir_all(&path).expect("a folder for the test");
        Self(path)
    }

    /// Writes a file into the folder.
    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) -> &Self {
        fs::write(self.0.join(name), text).expect("a file of the test");
        self
    }

    /// Copies a file of the workspace into the folder, under its own name.
    pub fn copy(&self, from_root: &str) -> &Self {
        let from = root().join(from_root);
        fs::copy(&from, self.0.join(from.file_name().expect("a file"))).expect("a file of the workspace");
        self
    }

    /// Reads a file of the folder.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).expect("a file that the command wrote")
    }

    /// The names in the folder, in order.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .expect("the folder is there")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs `trueaxis` in the folder.
    pub fn trueaxis(&self, arguments: &[&str]) -> Run {
        run_in(&self.0, arguments, "")
    }
}
