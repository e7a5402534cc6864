//! What a run of tests left out: a word where it happens, and one line at the end.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Where the tests of one run of `cargo test` note what they skip: each is a process of its own, and cargo is the parent of all.
fn note() -> Option<PathBuf> {
    #[cfg(unix)]
    let run = std::os::unix::process::parent_id();
    #[cfg(not(unix))]
    let run = 0;
    let program = std::env::current_exe().ok()?;
    let built = program.ancestors().find(|folder| folder.ends_with("deps"))?.parent()?;
    Some(built.join(format!("skipped-tests-{run}")))
}

/// Says that a test is skipped, and how it would not be. Where `CI` is set the test fails, unless `TESTS_WITHOUT` names what is missing.
pub(crate) fn skip(missing: &str, install: &str) {
    let without = std::env::var("TESTS_WITHOUT").unwrap_or_default();
    let may = std::env::var_os("CI").is_none() || without.split(',').any(|name| name == missing);
    assert!(may, "{missing} is missing, CI is set and TESTS_WITHOUT does not name {missing}: {install}");
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    let line = format!("{missing}\t{install}\t{test}");
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if !SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(line.clone()) {
        return;
    }
    // Past what the harness keeps of a test that passes. A word that cannot be written changes no result.
    let _ = writeln!(std::io::stderr(), "skipped: {test} needs {missing} ({install})");
    let noted = note().and_then(|path| OpenOptions::new().create(true).append(true).open(path).ok());
    if let Some(mut file) = noted {
        let _ = writeln!(file, "{line}");
    }
}

/// The line that ends a run, and an end to its notes.
#[must_use]
pub fn last_line() -> String {
    let Some(path) = note() else { return String::new() };
    let notes = fs::read_to_string(&path).unwrap_or_default();
    let _ = fs::remove_file(path);
    told(&notes)
}

fn told(notes: &str) -> String {
    let mut tests = BTreeSet::new();
    let mut missing: BTreeMap<&str, (BTreeSet<&str>, BTreeSet<&str>)> = BTreeMap::new();
    for line in notes.lines() {
        let [name, install, test] = [0, 1, 2].map(|at| line.split('\t').nth(at).unwrap_or_default());
        let (installs, own) = missing.entry(name).or_default();
        installs.insert(install);
        own.insert(test);
        tests.insert(test);
    }
    if tests.is_empty() {
        return "No test was skipped.".to_owned();
    }
    let each = missing.iter().map(|(name, (installs, tests))| {
        let list = |set: &BTreeSet<&str>| set.iter().copied().collect::<Vec<_>>().join(", ");
        format!("for want of {name} ({}): {}", list(installs), list(tests))
    });
    format!("Skipped, in part or whole, {} tests, {}.", tests.len(), each.collect::<Vec<_>>().join("; "))
}

#[cfg(test)]
mod tests {
    use super::told;

    #[test]
    fn one_line_says_what_was_skipped_and_what_to_install() {
        let notes = "node\tapt-get install nodejs\tjavascript\nnode\tapt-get install nodejs\twords\n\
                     coq\tapt-get install coq\twords\n";
        assert_eq!(
            told(notes),
            "Skipped, in part or whole, 2 tests, for want of coq (apt-get install coq): words; \
             for want of node (apt-get install nodejs): javascript, words."
        );
        assert_eq!(told(""), "No test was skipped.");
    }
}
