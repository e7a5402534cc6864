//! Tables of more rows than are in memory at a time: the same bytes on any number of processors, and mistakes with their places.

use std::fmt::Write as _;
use std::process::Command;

use crate::support::Folder;
use crate::{done, words};

const ROWS: usize = 150_000;
const EVAL: &str = "eval shaft.chain --errors e.toml --quantity value --data in.csv --out";

/// A shaft over so many rows; a row in ten thousand has a quote, one a blank line behind it.
fn table(spoiled: Option<usize>) -> String {
    let mut text = String::from("name,q\r\n");
    for row in 1..=ROWS {
        let name = if row.is_multiple_of(10_000) { format!("\"a, {row}\"") } else { format!("n{row}") };
        let q = if spoiled == Some(row) { "x".to_owned() } else { format!("{}", row as f64 * 1e-5) };
        let _ = write!(text, "{name},{q}\r\n{}", if row == 70_000 { "\r\n" } else { "" });
    }
    text
}

fn shaft(name: &str, table: &str) -> Folder {
    let folder = Folder::new(name);
    let chain = "chain Shaft {
        body shaft on ground { motion: Rz(q); motion_error: Rz(index); }
        observe mark: direction(1, 0, 0) of shaft;
    }";
    folder.write("shaft.chain", chain).write("e.toml", "index = 1e-5\n").write("in.csv", table);
    folder
}

#[test]
fn the_number_of_processors_changes_no_byte() {
    let folder = shaft("many-rows", &table(None));
    for threads in ["1", "3"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
        let arguments = EVAL.split(' ').chain([if threads == "1" { "one.csv" } else { "three.csv" }]);
        let status =
            command.args(arguments).current_dir(&folder.0).env("RAYON_NUM_THREADS", threads).status();
        assert!(status.is_ok_and(|status| status.success()), "{threads} threads");
    }
    let [one, three] = ["one.csv", "three.csv"].map(|name| folder.read(name));
    assert!(one == three, "the bytes differ");
    let mut lines = one.lines();
    assert_eq!(lines.next(), Some("name,q,mark_x,mark_y,mark_z"));
    for (row, line) in (1..=ROWS).zip(lines.by_ref()) {
        let cells: Vec<&str> = line.rsplitn(5, ',').collect();
        let name = if row.is_multiple_of(10_000) { format!("\"a, {row}\"") } else { format!("n{row}") };
        assert_eq!(cells[4], name);
        let turned = row as f64 * 1e-5 + 1e-5;
        let [x, y]: [f64; 2] = [cells[2], cells[1]].map(|cell| cell.parse().unwrap_or(f64::NAN));
        assert!((x - turned.cos()).abs() < 1e-15 && (y - turned.sin()).abs() < 1e-15, "row {row}: {line}");
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn a_mistake_far_down_has_its_place() {
    // Behind the header, and behind the blank line.
    let folder = shaft("many-rows-spoiled", &table(Some(140_001)));
    let run = words(&folder, &format!("{EVAL} out.csv"));
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("in.csv: line 140003, row 140001, column `q`: `x` is no number"), "{run}");
    assert_eq!(folder.names(), ["e.toml", "in.csv", "shaft.chain"]);
}

#[test]
fn other_tables_than_expected_are_refused_or_read() {
    let folder = shaft("many-other", "");
    for (table, words_of) in
        [("", "empty"), ("name,q\n", "no rows"), ("name,q\r\n\r\n", "no rows"), ("\u{1f}\u{8b}\u{8}", "q")]
    {
        folder.write("in.csv", table);
        let run = words(&folder, &format!("{EVAL} out.csv"));
        assert_eq!(run.code, 2, "{table:?}: {run}");
        assert!(run.stderr.contains(words_of), "{table:?}: {run}");
    }
    for table in ["q,name\n0.5,a\n", "q,name\n0.5,a", "q,name\r0.5,a\r", "q,name\r\n0.5,a"] {
        folder.write("in.csv", table);
        done(&words(&folder, &format!("{EVAL} out.csv")));
        assert_eq!(folder.read("out.csv").lines().count(), 2, "{table:?}");
    }
}
