//! Files that one hands to another: instrument files, files of telescope observations, lists of a class and what students hand in.

use std::fs;

use super::seen::{is_seen, run};
use super::{cell, joined, toml};
use crate::support::{Folder, root};
use testkit::hostile;

/// An instrument file that somebody calibrated.
fn instrument() -> String {
    fs::read_to_string(root().join("cli/tests/instrument/version-1.toml")).expect("a file of the tests")
}

const DATA: &str = "Az,zenith,pier\n-100,60,1\n";

/// The commands that take an instrument file.
const TAKING: [&str; 6] = [
    "apply instrument.toml --data new.csv --out out.csv",
    "eval instrument.toml --data new.csv --out out.csv",
    "identify instrument.toml",
    "bound instrument.toml",
    "budget instrument.toml",
    "generate instrument.toml --language rust --out out.rs",
];

#[test]
fn there_are_two_hundred_strings() {
    assert_eq!(hostile().len(), 200);
}

#[test]
fn instrument_files_whose_words_are_hostile() {
    let folder = Folder::new("hostile-instrument");
    let whole = instrument();
    for text in joined(400) {
        let heading: String = text.chars().filter(|letter| !letter.is_control()).collect();
        let words: String = text.split(['\n', '\r', '\0']).map(|line| format!("/// {line}\n")).collect();
        // A chain in a literal string of several lines: what no such string may hold stays out.
        let words: String = words.replace("'''", "' ' '");
        let words: String = words.chars().filter(|&letter| letter == '\n' || !letter.is_control()).collect();
        let written = whole
            .replace("/// A mount.\n", &words)
            .replace("column = \"Az\"", &format!("column = {}", toml(&format!("Az {heading}"))))
            .replace("data = \"stars.csv\"", &format!("data = {}", toml(&text)))
            .replace("heading = \"true el\"", &format!("heading = {}", toml(&text)))
            .replace("command = \"trueaxis", &format!("other = {}\ncommand = \"trueaxis", toml(&text)));
        folder.write("instrument.toml", written);
        folder.write("new.csv", DATA.replace("Az", &cell(&format!("Az {heading}"))));
        for command in TAKING {
            let said = run(&folder, &command.split(' ').collect::<Vec<_>>());
            assert!(
                said.code < 2 || !command.starts_with("generate"),
                "{text:?}: {command}: {}",
                said.stderr
            );
        }
        is_seen(&folder.read("out.rs"), "out.rs");
    }
}

/// Each text of an instrument file in turn is a hostile one: it is taken, or refused with its place.
#[test]
fn instrument_files_that_are_mistaken() {
    let folder = Folder::new("hostile-instrument-mistaken");
    folder.write("new.csv", DATA);
    let whole = instrument();
    let lines: Vec<&str> = whole.lines().collect();
    let mut refused = 0;
    for text in joined(1500) {
        for (at, line) in lines.iter().enumerate() {
            let Some((key, _)) = line.split_once(" = ").filter(|(_, value)| value.starts_with('"')) else {
                continue;
            };
            for mistaken in [format!("{key} = {}", toml(&text)), format!("{} = 1", toml(&text))] {
                let mut lines = lines.clone();
                lines[at] = &mistaken;
                folder.write("instrument.toml", lines.join("\n"));
                let said =
                    run(&folder, &["apply", "instrument.toml", "--data", "new.csv", "--out", "out.csv"]);
                refused += usize::from(said.code == 2);
            }
        }
    }
    assert!(refused > 20, "{refused}");
}

#[test]
fn observations_of_telescopes() {
    let folder = Folder::new("hostile-tpoint");
    folder.write(
        "alt.chain",
        "chain Alt { body base on ground { motion: Rz(-encoder_az); motion_error: Rz(-ia); }
         body tube on base { motion: Rx(encoder_el); motion_error: Rx(ie); }
         observe sight: azimuth(y, x), elevation of direction(0, 1, 0) of tube; }",
    );
    folder.write("e.toml", "ia = \"1 arcsec\"\n");
    for text in joined(300) {
        let line = text.replace(['\n', '\r'], " ");
        for data in [
            format!("{line}\n:ALTAZ\n31 41 19.6\n10.5 40.25 10.51 40.26\n"),
            format!("Caption\n:{line}\n31 41 19.6\n10.5 40.25 10.51 40.26\n"),
            format!("Caption\n:ALTAZ\n{line}\n10.5 40.25 10.51 40.26\n"),
            format!("Caption\n:ALTAZ\n31 41 19.6\n10.5 40.25 {line} 40.26\n"),
            format!("Caption\n:ALTAZ\n31 41 19.6\n10.5 40.25 10.51 40.26 {line}\n"),
        ] {
            folder.write("run.dat", data);
            run(
                &folder,
                &["eval", "alt.chain", "--errors", "e.toml", "--data", "run.dat", "--out", "out.csv"],
            );
            run(&folder, &["init", "run.dat", "--template", "alt-azimuth", "--out", "begun.toml"]);
            for begun in ["begun.toml", "begun.chain"] {
                if let Ok(text) = fs::read_to_string(folder.0.join(begun)) {
                    is_seen(&text, begun);
                    fs::remove_file(folder.0.join(begun)).expect("written");
                }
            }
        }
    }
}

#[test]
fn classes() {
    let folder = Folder::new("hostile-class");
    let names: Vec<String> = hostile().iter().map(|text| text.replace(['\n', '\r'], " ")).collect();
    let rows: String =
        names.iter().filter(|name| !name.trim().is_empty()).map(|name| cell(name) + "\n").collect();
    folder.write("names.csv", format!("name\n{rows}"));
    let made =
        ["class", "new", "--students", "names.csv", "--seed", "a phrase", "--level", "1", "--out", "class"];
    let said = run(&folder, &made);
    assert_eq!(said.code, 0, "{}", said.stderr);
    let folders: Vec<_> = fs::read_dir(folder.0.join("class")).expect("made").flatten().collect();
    for (at, student) in folders.iter().enumerate() {
        let sheet = fs::read_to_string(student.path().join("sheet.md")).expect("a sheet");
        is_seen(&sheet, "a sheet");
        assert!(!sheet.contains("<injected") && !sheet.contains("<script"), "{sheet}");
        // What students hand in.
        let text = &hostile()[at % hostile().len()];
        let answer = fs::read_to_string(student.path().join("answer.toml")).expect("an answer");
        let own = format!("{}\ncauses = [{}]\n", answer.replace("causes = []", ""), toml(text));
        fs::write(student.path().join("answer.toml"), own).expect("a file of the test");
        fs::write(student.path().join("amended.chain"), format!("/// {text}\nchain X {{ }}"))
            .expect("the same");
    }
    for format in ["text", "json"] {
        let graded = ["class", "grade", "class", "--key", "class.key.toml", "--format", format];
        let said = run(&folder, &graded);
        assert_eq!(said.code, 0, "{}", said.stderr);
        assert!(format != "json" || serde_json::from_str::<serde_json::Value>(&said.stdout).is_ok());
    }
    let said = run(&folder, &["class", "grade", "class", "--key", "class.key.toml", "--out", "marks"]);
    assert_eq!(said.code, 0, "{}", said.stderr);
    for mark in fs::read_dir(folder.0.join("marks")).expect("made").flatten() {
        let text = fs::read_to_string(mark.path()).expect("a text");
        is_seen(&text, "marks");
        let shown = outside_of_code(&text);
        let is_markdown = mark.path().extension().is_some_and(|extension| extension == "md");
        assert!(!is_markdown || !shown.contains("<injected") && !shown.contains("<script"), "{text}");
    }
}

/// What a reader of Markdown takes for more than letters: a run of backticks up to the next as long as it is code.
fn outside_of_code(text: &str) -> String {
    let (mut rest, mut outside) = (text, String::new());
    while let Some(at) = rest.find('`') {
        outside.push_str(&rest[..at]);
        let ticks = rest[at..].len() - rest[at..].trim_start_matches('`').len();
        let behind = &rest[at + ticks..];
        let ends = behind.match_indices('`').filter(|&(end, _)| !behind[..end].ends_with('`'));
        let mut ends =
            ends.map(|(end, _)| (end, behind[end..].len() - behind[end..].trim_start_matches('`').len()));
        rest = ends.find(|&(_, run)| run == ticks).map_or(behind, |(end, run)| &behind[end + run..]);
    }
    outside + rest
}
