//! Runs of the command with colours, as a terminal gets them, in which every letter must be seen.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::support::Folder;

/// What the command itself switches on and off: bold, colours of words, and plain again.
const STYLES: [&str; 7] =
    ["\u{1b}[0m", "\u{1b}[1m", "\u{1b}[4m", "\u{1b}[31m", "\u{1b}[32m", "\u{1b}[33m", "\u{1b}[1m\u{1b}[4m"];

/// What a run gave, without styles.
pub struct Seen {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// A run in which nothing acts on the terminal and no line pretends to be a message.
pub fn run(folder: &Folder, arguments: &[&str]) -> Seen {
    run_in(&folder.0, arguments)
}

pub fn run_in(folder: &Path, arguments: &[&str]) -> Seen {
    let output = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(arguments)
        .current_dir(folder)
        .env("CLICOLOR_FORCE", "1")
        .env_remove("NO_COLOR")
        .stdin(Stdio::null())
        .output()
        .expect("the command starts");
    let text = |bytes: Vec<u8>| {
        let mut text = String::from_utf8(bytes).expect("UTF-8");
        STYLES.iter().for_each(|style| text = text.replace(style, ""));
        text
    };
    let seen = Seen {
        code: output.status.code().unwrap_or_else(|| panic!("{arguments:?}: ended by a signal")),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    };
    for said in [&seen.stdout, &seen.stderr] {
        is_seen(said, &format!("{arguments:?}"));
        // The longest answer is half a page of feedback for each of 200 students.
        assert!(said.len() < 600_000, "{arguments:?}: {} bytes", said.len());
    }
    for line in seen.stderr.lines() {
        assert!(
            !line.starts_with("error: injected") && !line.starts_with("warning: injected"),
            "{arguments:?}: {line}"
        );
        assert!(!line.starts_with("  --> injected"), "{arguments:?}: {line}");
    }
    seen
}

/// Every letter of a text is seen.
pub fn is_seen(text: &str, what: &str) {
    if let Some(at) = text.find(testkit::acts_on_a_screen) {
        let before: String =
            text[..at].chars().rev().take(60).collect::<Vec<_>>().into_iter().rev().collect();
        panic!("{what}: {:?} behind {before:?}", text[at..].chars().next());
    }
}
