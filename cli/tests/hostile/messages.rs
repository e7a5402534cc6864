//! Messages: of declarations that are mistaken, of tables, of files by their names, of arguments.

use std::fs;

use super::seen::{run, run_in};
use super::{MOUNT, cell, joined, toml};
use crate::support::Folder;

/// What fits into a cell that a message shows.
const CELL: usize = 55;

#[test]
fn declarations() {
    let folder = Folder::new("hostile-declarations");
    for text in joined(300) {
        let quoted: String = text.chars().flat_map(char::escape_default).collect();
        for chain in [
            format!("chain {text} {{ }}"),
            format!("chain X {{ body b on ground {{ motion: {text}; }} }}"),
            format!(
                "chain X {{ body b on ground {{ motion: Rz(q); }} symbol q = \"{quoted}\"; observe p: direction({text}) of b; }}"
            ),
            format!("chain X {{ symbol q = r##\"{text}\"##; }}"),
        ] {
            folder.write("x.chain", &chain);
            assert_eq!(run(&folder, &["derive", "x.chain"]).code, 2, "{chain:?}");
        }
    }
}

#[test]
fn a_line_of_a_declaration_is_pointed_at() {
    let folder = Folder::new("hostile-pointed");
    folder.write("x.chain", "chain M { /*\u{1b}[31m\u{202e}*/ body b on ground { motion: Rw(q); } }");
    let said = run(&folder, &["derive", "x.chain"]).stderr;
    let lines: Vec<&str> = said.lines().collect();
    let at = lines.iter().position(|line| line.starts_with("1 | ")).unwrap_or_else(|| panic!("{said}"));
    let (source, carets) = (lines[at], lines[at + 1]);
    assert!(source.contains(r"/*\u{1b}[31m\u{202e}*/"), "{said}");
    let first = carets.chars().position(|letter| letter == '^').expect("a caret");
    let width = carets.matches('^').count();
    assert_eq!(source.chars().skip(first).take(width).collect::<String>(), "Rw", "{said}");
}

#[test]
fn tables() {
    let folder = Folder::new("hostile-tables");
    folder.write("m.chain", MOUNT).write("e.toml", "tilt = \"3 arcsec\"\n");
    let evaluate = ["eval", "m.chain", "--errors", "e.toml", "--data", "d.csv", "--out", "x.csv"];
    for text in joined(CELL) {
        let cell = cell(&text);
        for table in [
            format!("turn [deg],far [m]\n{cell},1\n"),
            format!("{cell},far [m]\n1,1\n"),
            format!("turn [deg],far [m],{cell},{cell}\n1,1,1,1\n"),
            format!("turn {cell},far [m]\n1,1\n"),
            format!("turn [deg],far [m]\n1,1\n{cell}\n"),
        ] {
            folder.write("d.csv", table);
            run(&folder, &evaluate);
            run(&folder, &["init", "d.csv", "--out", "begun.toml"]);
            let _ = fs::remove_file(folder.0.join("begun.toml"));
            let _ = fs::remove_file(folder.0.join("begun.chain"));
        }
        // Columns that are passed on stay as they are in the file, and the terminal gets none of them.
        folder.write("d.csv", format!("turn [deg],far [m],note\n1,1,{cell}\n"));
        assert_eq!(run(&folder, &evaluate).code, 0, "{text:?}");
    }
    let long = "x".repeat(10_000_000);
    folder.write("d.csv", format!("turn [deg],far [m],{long},{long}\n{long},1,1,1\n"));
    let said = run(&folder, &evaluate);
    assert!(said.code == 2 && said.stderr.len() < 10_000, "{} bytes", said.stderr.len());
}

#[test]
fn values_of_errors() {
    let folder = Folder::new("hostile-errors");
    folder.write("m.chain", MOUNT).write("d.csv", "turn [deg],far [m]\n1,1\n");
    for text in joined(200) {
        let text = toml(&text);
        for errors in [
            format!("{text} = 1"),
            format!("tilt = {text}"),
            format!("[{text}]\ntilt = 1"),
            format!("tilt = 1 {text}"),
        ] {
            folder.write("e.toml", errors);
            for command in
                ["eval m.chain --errors e.toml --data d.csv --out x.csv", "bound m.chain --sizes e.toml"]
            {
                assert_eq!(run(&folder, &command.split(' ').collect::<Vec<_>>()).code, 2, "{text}");
            }
        }
    }
}

#[test]
fn studies() {
    let folder = Folder::new("hostile-studies");
    folder.write("m.chain", MOUNT).write("d.csv", "turn [deg],far [m]\n1,1\n");
    for text in joined(200) {
        let text = toml(&text);
        let study = |more: &str| format!("chain = \"m.chain\"\ndata = \"d.csv\"\n{more}\n");
        for study in [
            study(&format!("{text} = 1")),
            study(&format!("[columns]\nturn = {text}")),
            study(&format!("[columns]\n{text} = \"turn\"")),
            study(&format!("[observed]\nkind = {text}")),
            study(&format!("id = {text}\n[observed]\nkind = \"direction\"")),
            study(&format!("observable = {text}\n[observed]\nkind = \"direction\"")),
            study(&format!("[observed]\nkind = \"direction\"\n[fit]\nestimate = [{text}]")),
            study(&format!("[observed]\nkind = \"direction\"\n[noise]\nsigma = {text}")),
            format!("chain = {text}\ndata = \"d.csv\""),
            format!("chain = \"m.chain\"\ndata = {text}\n[observed]\nkind = \"direction\""),
            format!("chain = \"m.chain\"\ndata = [\"d.csv\", {text}]\n[observed]\nkind = \"direction\""),
        ] {
            folder.write("s.toml", &study);
            assert_eq!(run(&folder, &["calibrate", "s.toml"]).code, 2, "{study}");
        }
    }
}

#[test]
fn names_of_files_and_arguments() {
    let folder = Folder::new("hostile-names");
    folder
        .write("m.chain", MOUNT)
        .write("e.toml", "tilt = \"3 arcsec\"\n")
        .write("d.csv", "turn [deg],far [m]\n1,1\n");
    let mut short = joined(60);
    short.retain(|text| !text.is_empty());
    for text in short {
        let text = text.as_str();
        let option = format!("--{text}");
        for arguments in [
            &["derive", text][..],
            &["derive", "m.chain", "--observable", text],
            &["bound", "m.chain", "--sizes", "e.toml", "--range", text],
            &["budget", "m.chain", "--sizes", "e.toml", "--path", text],
            &["identify", "m.chain", "--candidate", text],
            &["generate", "m.chain", "--language", text, "--out", "x"],
            &["check", text],
            &["derive", "m.chain", &option],
            &["init", text],
            &[text],
        ] {
            assert_ne!(run(&folder, arguments).code, 0, "{arguments:?}");
        }
        if cfg!(windows) {
            // No file has such a name there.
            continue;
        }
        // As the name of files that are there, in a folder of that name.
        let name = text.replace('/', "_");
        let own = folder.0.join(&name);
        fs::create_dir_all(&own).unwrap_or_else(|error| panic!("{name:?}: {error}"));
        fs::write(own.join(&name), "chain X { }").expect("a file of the test");
        let path = format!("./{name}/{name}");
        for arguments in [
            &["derive", &path][..],
            &["calibrate", &path],
            &["eval", "m.chain", "--errors", "e.toml", "--data", &path, "--out", "x.csv"],
            &["eval", "m.chain", "--errors", &path, "--data", "d.csv", "--out", "x.csv"],
            &["eval", "m.chain", "--errors", "e.toml", "--data", "d.csv", "--out", &format!("{path}/x.csv")],
            &["generate", "m.chain", "--language", "c", "--out", &format!("{path}.c")],
            &["init", &path],
        ] {
            run(&folder, arguments);
        }
        // A misspelt name is answered with the nearest, which is hostile.
        let chars: String = name.chars().skip(1).collect();
        assert_eq!(run_in(&own, &["derive", if chars.is_empty() { "x" } else { &chars }]).code, 2);
    }
}
