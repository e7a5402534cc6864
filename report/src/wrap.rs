//! Text set to a width: words are never cut, lines after the first hang under it.
//!
//! Not `textwrap` 0.16, which counts `″` as two letters unless it brings the tables of `unicode-width`.

use std::fmt::Write;

/// How far what is left of a broken line hangs behind its start.
const HANGING: usize = 2;

/// Appends a paragraph: the first line after `first`, the others after as many blanks; `width` letters at most.
pub fn paragraph(text: &mut impl Write, first: &str, words: &str, width: usize) {
    set(text, first, first.chars().count(), words, width);
}

/// A text whose lines are broken where they are longer than `width`; what is left of one hangs under it. A line that marks
/// are set under stays whole.
#[must_use]
pub fn text(text: &str, width: usize) -> String {
    let mut out = String::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let marked = lines.peek().is_some_and(|next| is_of_marks(next));
        if letters(line) <= width || marked || is_of_marks(line) {
            let _ = writeln!(out, "{line}");
        } else {
            let blanks = line.len() - line.trim_start_matches(' ').len();
            set(&mut out, &line[..blanks], blanks + HANGING, line, width);
        }
    }
    out
}

/// Whether nothing stands on a line but what points at the line above.
fn is_of_marks(line: &str) -> bool {
    let line = anstream::adapter::strip_str(line).to_string();
    line.contains('^') && line.chars().all(|letter| matches!(letter, ' ' | '^' | '|'))
}

/// The letters of a text that are seen: without colours.
fn letters(text: &str) -> usize {
    anstream::adapter::strip_str(text).to_string().chars().count()
}

fn set(text: &mut impl Write, first: &str, indent: usize, words: &str, width: usize) {
    let mut line = first.to_owned();
    let mut empty = true;
    for word in words.split_whitespace() {
        let length = letters(&line) + usize::from(!empty) + letters(word);
        if !empty && length > width {
            let _ = writeln!(text, "{}", line.trim_end());
            line = " ".repeat(indent);
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    let _ = writeln!(text, "{}", line.trim_end());
}

#[cfg(test)]
mod tests {
    use super::{paragraph, text};

    #[test]
    fn lines_hang_under_the_first() {
        let mut text = String::new();
        paragraph(&mut text, "  - ", "the encoder of β sits off centre", 20);
        assert_eq!(text, "  - the encoder of β\n    sits off centre\n");
    }

    #[test]
    fn a_long_word_is_not_cut() {
        let mut text = String::new();
        paragraph(&mut text, "", "a incomprehensibilities b", 8);
        assert_eq!(text, "a\nincomprehensibilities\nb\n");
    }

    #[test]
    fn long_lines_are_broken_and_others_stay_as_they_are() {
        assert_eq!(
            text("name    value\n  without influence: dx1, dy1, dz1\n", 20),
            "name    value\n  without influence:\n    dx1, dy1, dz1\n"
        );
        // Colours take no room.
        let red = "\u{1b}[31mred\u{1b}[0m and blue";
        assert_eq!(text(red, 12), format!("{red}\n"));
    }

    #[test]
    fn what_is_pointed_at_stays_where_it_is() {
        let pointed = "    a long line that is pointed at\n           ^^^^\n";
        assert_eq!(text(pointed, 10), pointed);
    }
}
