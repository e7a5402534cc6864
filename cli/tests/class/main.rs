//! A class from the list of names to the marks, as a teacher and students run it.
#![allow(clippy::expect_used, reason = "a test may fail loudly")]

#[path = "../support/mod.rs"]
mod support;

use std::fs;

use serde_json::Value;
use support::{Folder, Run};

const SEED: &str = "a phrase that nobody guesses";

fn new(folder: &Folder, level: &str, out: &str, more: &[&str]) -> Run {
    let plain = ["class", "new", "--students", "names.csv", "--seed", SEED, "--level", level, "--out", out];
    folder.trueaxis(&[&plain, more].concat())
}

fn grade(folder: &Folder, more: &[&str]) -> Run {
    folder.trueaxis(&[&["class", "grade", "class", "--key", "class.key.toml"], more].concat())
}

#[test]
fn a_class_is_made_answered_and_graded() {
    let folder = Folder::new("class-whole");
    folder.write("names.csv", "name,group\nAda,1\n\"Schmidt, Bo\",2\n=cmd(),2\n");
    let made = new(&folder, "1", "class", &[]);
    assert_eq!(made.code, 0, "{made}");
    assert!(made.stderr.contains("Wrote 3 folders into `class`. The key is `class.key.toml`."), "{made}");
    let path = folder.0.join("class/001-ada");
    let names = ["answer.toml", "data.csv", "instrument.chain", "pose.csv", "sheet.md", "study.toml"];
    assert!(
        names.iter().all(|name| path.join(name).is_file())
            && names.len() == fs::read_dir(&path).expect("it").count()
    );
    // The product finds the secret, and its own amended declaration is graded as right.
    let run = |arguments: &[&str]| support::run_in(&path, arguments, "");
    let found = run(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(found.code, 0, "{found}");
    fs::copy(path.join("result/amended.chain"), path.join("amended.chain")).expect("amended");
    let predicted =
        run(&["eval", "amended.chain", "--errors", "result/errors.toml", "--data", "pose.csv", "--out", "-"]);
    assert_eq!(predicted.code, 0, "{predicted}");
    // The second hands in the first one's file, the third nothing at all.
    let theirs = fs::read_to_string(path.join("answer.toml")).expect("an empty answer");
    folder.write("class/002-schmidt-bo/answer.toml", theirs);
    fs::remove_file(folder.0.join("class/003-cmd/answer.toml")).expect("gone");
    fs::create_dir(folder.0.join("class/renamed")).expect("another folder");
    let graded = grade(&folder, &["--format", "json", "--out", "marks"]);
    assert_eq!(graded.code, 0, "{graded}");
    assert!(graded.stderr.contains("the folder \"renamed\" belongs to no student"), "{graded}");
    let report: Value = serde_json::from_str(&graded.stdout).expect("JSON");
    let points = |item: &str| {
        let grades = report["students"][0]["grades"].as_array().expect("grades");
        grades.iter().find(|grade| grade["item"] == item).expect("the item")["points"].as_f64()
    };
    assert_eq!(
        [points("place"), points("unseen"), points("cause")],
        [Some(5.0), Some(3.0), Some(0.0)],
        "{graded}"
    );
    let why = |at: usize| report["students"][at]["not_graded"].clone();
    assert_eq!(why(1), "the answer carries the mark of the sheet of Ada (001-ada)");
    assert_eq!(why(2), "there is no `answer.toml`");
    let marks = folder.read("marks/marks.csv");
    assert!(marks.contains("\n'=cmd(),003-cmd,0,"), "{marks}");
    for name in ["001-ada.md", "002-schmidt-bo.md", "003-cmd.md"] {
        assert!(folder.read(&format!("marks/{name}")).contains("## The secret"));
    }
    let table = grade(&folder, &[]);
    assert!(table.stdout.contains("\nSchmidt, Bo "), "{table}");
}

#[test]
fn nothing_is_overwritten_and_bad_lists_are_refused() {
    let folder = Folder::new("class-refused");
    folder.write("names.csv", "name\nAda\n");
    let warned = folder.trueaxis(&[
        "class",
        "new",
        "--students",
        "names.csv",
        "--seed",
        "7",
        "--level",
        "2",
        "--out",
        "class",
    ]);
    assert_eq!(warned.code, 0, "{warned}");
    assert!(warned.stderr.contains("the seed has fewer than 12 letters"), "{warned}");
    let sealed = folder.read("class.key.toml");
    let again = new(&folder, "1", "class", &[]);
    assert!(again.code == 2 && again.stderr.contains("is not empty"), "{again}");
    fs::remove_dir_all(folder.0.join("class")).expect("gone");
    let again = new(&folder, "1", "class", &[]);
    assert!(again.code == 2 && again.stderr.contains("is there already"), "{again}");
    assert_eq!(folder.read("class.key.toml"), sealed);
    folder.write("names.csv", "name\nZoë Łukasik\n\nBo\nBo\n");
    let twins = new(&folder, "1", "twins", &[]);
    assert!(
        twins.code == 0
            && twins.stderr.contains("the list has \"Bo\" 2 times. Their folders begin with 002, 003."),
        "{twins}"
    );
    assert!(folder.0.join("twins/001-zoe-lukasik/sheet.md").is_file());
    for (list, why) in [
        ("Ada\nBo\n", "has no column `name`"),
        ("name\n", "the list has no names"),
        ("", "the file is empty"),
        ("name,group\nAda,1\n,2\n", "row 2 of the list has no name"),
    ] {
        folder.write("names.csv", list);
        let refused = new(&folder, "1", "other", &[]);
        assert!(refused.code == 2 && refused.stderr.contains(why), "{list:?}: {refused}");
        assert!(!folder.0.join("other").exists() && !folder.0.join("other.key.toml").exists());
    }
    folder.write("names.csv", "name\nAda\n");
    let refused = new(&folder, "5", "other", &[]);
    assert!(refused.code == 2 && refused.stderr.contains("there is no level 5"), "{refused}");
    let inside = new(&folder, "1", "other", &["--key", "other/key.toml"]);
    assert!(inside.code == 2 && inside.stderr.contains("would lie among the folders"), "{inside}");
    for (answers, key, why) in [
        (".", "names.csv", "this is no key"),
        (".", "missing.toml", "there is no such file"),
        ("missing", "class.key.toml", "is no folder"),
    ] {
        let refused = folder.trueaxis(&["class", "grade", answers, "--key", key]);
        assert!(refused.code == 2 && refused.stderr.contains(why), "{refused}");
    }
}

/// A link could lead to the file of somebody else.
#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    let folder = Folder::new("class-links");
    folder.write("names.csv", "name\nAda\nBo\n");
    assert_eq!(new(&folder, "1", "class", &[]).code, 0);
    let answer = folder.0.join("class/001-ada/answer.toml");
    fs::remove_file(&answer).expect("gone");
    std::os::unix::fs::symlink(folder.0.join("class.key.toml"), &answer).expect("a link");
    let graded = grade(&folder, &[]);
    assert!(graded.stdout.contains("`answer.toml` is reached by a link"), "{graded}");
}
