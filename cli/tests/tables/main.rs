//! Tables of data through every command: what one writes, the next reads as it was; what nobody computes leaves as it came; what
//! could be read in two ways is asked about.

#[path = "../support/mod.rs"]
mod support;

mod apply;
mod doubts;
mod kept;
mod many;
mod orders;
mod round_trip;
mod sexagesimal;
mod tpoint;

use support::{Folder, Run};

/// Runs the command with words that no blank stands in.
fn words(folder: &Folder, words: &str) -> Run {
    folder.trueaxis(&words.split(' ').collect::<Vec<_>>())
}

/// What a run that must succeed says on standard error.
fn done(run: &Run) -> &str {
    assert_eq!(run.code, 0, "{run}");
    &run.stderr
}

/// Cells of separated values, quotes taken off; for texts without line breaks in cells.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                cells.last_mut().expect("one").extend(letters.next())
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            other => cells.last_mut().expect("one").push(other),
        }
    }
    cells
}

/// A column of a table by the start of its name.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut lines = table.lines();
    let header = cells(lines.next().expect("a header"));
    let at =
        header.iter().position(|column| column == name).unwrap_or_else(|| panic!("{name} in {header:?}"));
    lines.map(|line| cells(line)[at].clone()).collect()
}
