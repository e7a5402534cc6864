//! Grades as people and programs read them: a table, a table of values, and half a page each.

use std::fmt::Write as _;

use model_core::escape::{line, markdown};
use tables::formats::write_row;

use crate::grade::Marked;
use crate::rubric::{RUBRIC, full};

/// Characters of a name in the table.
const WIDTH: usize = 24;

/// A table for a terminal, with the reason behind what could not be graded.
#[must_use]
pub fn table(marked: &[Marked]) -> String {
    let heads: Vec<String> =
        RUBRIC.iter().map(|(item, points)| format!("{} /{points}", item.word())).collect();
    let all = format!("all /{}", full());
    let mut text = format!("{:WIDTH$}  {}  {all}\n", "name", heads.join("  "));
    for own in marked {
        let mut name = line(&own.name).into_owned();
        if name.chars().count() > WIDTH {
            name = name.chars().take(WIDTH - 1).chain(['…']).collect();
        }
        let _ = write!(text, "{name:WIDTH$}");
        if let Some(why) = &own.not_graded {
            let _ = writeln!(text, "  0, not graded: {}", line(why));
            continue;
        }
        for (grade, head) in own.grades.iter().zip(&heads) {
            let _ = write!(text, "  {:>width$}", grade.points, width = head.len());
        }
        let _ = writeln!(text, "  {:>width$}", own.points, width = all.len());
    }
    text
}

/// The same as separated values. A cell that a spreadsheet would take for a formula gets an apostrophe before it.
#[must_use]
pub fn csv(marked: &[Marked]) -> String {
    let words = RUBRIC.iter().map(|(item, _)| item.word().to_owned());
    let head = ["name", "folder"].map(str::to_owned).into_iter().chain(words);
    let head: Vec<String> = head.chain(["all", "not_graded"].map(str::to_owned)).collect();
    let row = |own: &Marked| {
        let points =
            (0..RUBRIC.len()).map(|at| own.grades.get(at).map_or(0.0, |grade| grade.points).to_string());
        let cells = [harmless(&own.name), own.folder.clone()].into_iter().chain(points);
        cells
            .chain([own.points.to_string(), harmless(own.not_graded.as_deref().unwrap_or_default())])
            .collect()
    };
    let mut bytes = Vec::new();
    for cells in std::iter::once(head).chain(marked.iter().map(row)) {
        write_row(&mut bytes, cells.iter().map(String::as_str))
            .unwrap_or_else(|_| unreachable!("memory can be written"));
    }
    String::from_utf8(bytes).unwrap_or_else(|_| unreachable!("texts were written"))
}

/// What a student reads: every item with its points and the reason, and the secret.
#[must_use]
pub fn feedback(own: &Marked) -> String {
    let mut text = format!("# {}: {} of {} points\n\n", markdown(&line(&own.name)), own.points, full());
    if let Some(why) = &own.not_graded {
        let _ = writeln!(text, "Nothing was graded: {}.\n", markdown(&line(why)));
    }
    for grade in &own.grades {
        let why = line(&grade.why);
        let _ = writeln!(text, "- **{}, {} of {}.** {why}", grade.item.word(), grade.points, grade.of);
    }
    for key in &own.left_out {
        let _ = writeln!(text, "- `answer.toml` asks for no {}. It was left out.", markdown(&line(key)));
    }
    text.push_str("\n## The secret\n\n");
    for secret in &own.secret {
        let _ = writeln!(text, "- {secret}");
    }
    text
}

fn harmless(text: &str) -> String {
    let text = line(text);
    if text.trim_start().starts_with(['=', '+', '-', '@']) { format!("'{text}") } else { text.into_owned() }
}
