//! The gallery of published formula sets, all of it in one go: every verdict as the independent scripts beside it have it.

#[path = "../support/mod.rs"]
mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use support::{root, trueaxis};

fn files(ending: &str) -> Vec<PathBuf> {
    let folder = root().join("examples/gallery");
    let entries = fs::read_dir(folder).expect("the gallery is there");
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    files
}

fn name(path: &std::path::Path) -> String {
    path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// What trueaxis says of each claim of a set.
fn verdicts(set: &str) -> Vec<(String, String)> {
    let run = trueaxis(&["check", &format!("examples/gallery/{set}.toml"), "--format", "json"]);
    assert!(run.code < 2, "{set}: {}", run.stderr);
    let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let claims = json["claims"].as_array().expect("claims");
    claims.iter().map(|claim| (text(&claim["name"]), text(&claim["verdict"]))).collect()
}

/// What the script beside a set said of its claims.
fn reference(set: &str) -> BTreeMap<String, String> {
    let text =
        fs::read_to_string(root().join(format!("examples/gallery/{set}.txt"))).expect("the script's output");
    let lines = text.lines().filter_map(|line| line.rsplit_once(": "));
    lines.map(|(name, verdict)| (name.to_owned(), verdict.to_owned())).collect()
}

#[test]
fn every_verdict_is_that_of_the_independent_derivation() {
    let sets = files("toml");
    assert!(sets.len() >= 21, "{} sets", sets.len());
    let mut compared = 0;
    for set in sets.iter().map(|path| name(path)) {
        let verdicts = verdicts(&set);
        let mut reference = reference(&set);
        for (claim, verdict) in &verdicts {
            if let Some(expected) = reference.remove(claim) {
                assert_eq!(*verdict, expected, "{set}: {claim}");
                compared += 1;
            } else {
                // Counts and sizes follow from the declaration's own text, or are held elsewhere.
                assert_eq!(verdict, "holds", "{set}: {claim}");
            }
        }
        assert!(reference.is_empty(), "{set}: claims that only the script knows: {reference:?}");
    }
    assert!(compared >= 50, "{compared} verdicts");
}

/// Each set has a place in the book, and says where it is from.
#[test]
fn every_set_names_its_source_and_has_its_page() {
    let summary = fs::read_to_string(root().join("docs/src/SUMMARY.md")).expect("the book");
    for path in files("toml") {
        let set = name(&path);
        let text = fs::read_to_string(&path).expect("a claims file");
        assert!(text.contains("Source") || text.contains("Written from"), "{set} names no source");
        assert!(root().join(format!("examples/gallery/{set}.py")).exists(), "{set} has no script");
        let page = root().join("docs/src/gallery").join(format!("{}.md", page_of(&set)));
        let page = fs::read_to_string(&page).unwrap_or_else(|error| panic!("{set} has no page: {error}"));
        assert!(page.contains(&format!("gallery/{set}.toml")), "the page of {set} does not show it");
        assert!(summary.contains(&format!("gallery/{}.md", page_of(&set))), "{set} is not in the summary");
    }
}

/// Two files of a total station share a page.
fn page_of(set: &str) -> &str {
    set.strip_suffix("-sight").unwrap_or(set)
}

/// Where SymPy is there, the scripts still say what is kept beside them.
#[test]
fn the_scripts_say_what_is_kept_of_them() {
    let Some(python) = testkit::tool(testkit::SYMPY) else { return };
    // The quickest of them; the others run the same way.
    for set in ["mobile-lidar", "total-station"] {
        let output = Command::new(&python)
            .arg(format!("{set}.py"))
            .current_dir(root().join("examples/gallery"))
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .output()
            .expect("Python runs");
        let said = String::from_utf8(output.stdout).expect("UTF-8");
        let kept = fs::read_to_string(root().join(format!("examples/gallery/{set}.txt"))).expect("kept");
        assert_eq!(said, kept, "{set}: {}", String::from_utf8_lossy(&output.stderr));
    }
}
