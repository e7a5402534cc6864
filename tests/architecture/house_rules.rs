//! What no source file of a library may do, and how files look.

use crate::sources::{below, libraries};

/// Texts that are compiled here and also go, unchanged, into generated files.
const QUOTED: &[&str] = &[
    "codegen/src/vector/blocks.rs",
    "codegen/src/vector/kernel.rs",
    "codegen/src/vector/paths.rs",
    "codegen/src/vector/single.rs",
    "codegen/src/vector/wide.rs",
];

/// Longer files hold more than one concept.
const MOST_LINES: usize = 450;

/// Files that may hold `unsafe`: vector kernels behind a test of the processor.
const UNSAFE_ALLOWED_BELOW: &[&str] = &["codegen/src/"];

/// What only the command may do: read and write files, print, know a clock or the environment, start threads. A browser has none of them.
const OUTSIDE_WORLD: &[&str] = &[
    "std::fs",
    "std::env",
    "std::net",
    "std::process",
    "thread::",
    "File::",
    "SystemTime",
    "Instant",
    "stdin()",
    "stdout()",
    "stderr()",
    "println!",
    "eprintln!",
    "print!(",
    "eprint!(",
    "dbg!",
];

/// `chain_file!` reads the declaration that it expands, as a macro must; it finds the crate by its environment.
const READS_FILES: &str = "model-macros/src/";

#[test]
fn libraries_know_no_files_no_clock_no_terminal_and_start_no_thread() {
    for file in libraries().into_iter().filter(|file| !file.path.starts_with(READS_FILES)) {
        for (number, line) in file.code() {
            for outside in OUTSIDE_WORLD {
                let word = line.find(outside).is_some_and(|at| {
                    // `BatchFile::` is not `File::`.
                    !line[..at].ends_with(|before: char| before.is_alphanumeric() || before == '"')
                });
                assert!(!word, "{}:{number}: {outside}: only the command may; {line}", file.path);
            }
        }
    }
}

#[test]
fn unsafe_stands_only_in_vector_kernels_and_says_why_it_is_sound() {
    for file in libraries().into_iter().chain(below("cli/src")) {
        let uses: Vec<(usize, &str)> =
            file.code().filter(|(_, line)| line.contains("unsafe {") || line.contains("unsafe fn")).collect();
        if uses.is_empty() {
            continue;
        }
        let allowed = UNSAFE_ALLOWED_BELOW.iter().any(|folder| file.path.starts_with(folder));
        assert!(allowed, "{}:{}: `unsafe` is not allowed here", file.path, uses[0].0);
        let says_why = file.text.contains("SAFETY:") || file.text.contains("# Safety");
        assert!(says_why, "{}: `unsafe` without a SAFETY argument", file.path);
    }
}

#[test]
fn every_file_is_one_concept_and_says_which() {
    for file in libraries().into_iter().chain(below("cli/src")) {
        let lines = file.text.lines().count();
        assert!(lines <= MOST_LINES, "{}: {lines} lines; split it by concept", file.path);
        // A text that goes into the middle of a generated file cannot begin with an inner comment.
        let comment = if QUOTED.contains(&file.path.as_str()) { "// " } else { "//!" };
        assert!(
            file.text.starts_with(comment),
            "{}: the first line must say what concept lives here",
            file.path
        );
    }
}
