//! Mistakes in a text that a person wrote: where, what is wrong, what to write instead; and how they are shown.
//!
//! The same shape serves the parser, the checker of declarations and every other reader of a file: `S` is a
//! token's span while a macro may still point at it, and a [`Place`] once it is counted in lines and columns.

use std::fmt;
use std::ops::Range;

/// The longest line that is shown whole, in letters.
const LONGEST_LINE: usize = 160;
/// Letters before the fault that are shown of a longer one.
const LETTERS_BEFORE: usize = 60;

/// One thing that is wrong, where, and what to write instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake<S = Place> {
    /// Where: the token or the range of bytes at fault.
    pub place: S,
    /// What is wrong, as one clause without a full stop: ``unknown axis `Rw` ``.
    pub message: String,
    /// What to write instead, in the same style.
    pub help: Option<String>,
}

impl<S> Mistake<S> {
    /// A mistake without advice.
    pub fn new(place: S, message: impl Into<String>) -> Self {
        Self { place, message: message.into(), help: None }
    }

    /// The same mistake with advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// A place in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The bytes at fault.
    pub bytes: Range<usize>,
    /// Line of the first of them, counted from 1.
    pub line: usize,
    /// Column of the first of them, in characters, counted from 1.
    pub column: usize,
}

/// Every mistake of one text, sorted by place; never empty.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct Mistakes {
    mistakes: Vec<Mistake<Place>>,
}

impl Mistakes {
    /// Counts lines and columns of byte ranges in `text`, and sorts by place.
    #[must_use]
    pub fn locate(text: &str, mistakes: impl IntoIterator<Item = Mistake<Range<usize>>>) -> Self {
        let line_starts: Vec<usize> =
            std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        let mut located: Vec<Mistake<Place>> = mistakes
            .into_iter()
            .map(|mistake| Mistake {
                place: place(text, &line_starts, mistake.place),
                message: mistake.message,
                help: mistake.help,
            })
            .collect();
        located.sort_by_key(|mistake| (mistake.place.bytes.start, mistake.place.bytes.end));
        located.dedup();
        Self { mistakes: located }
    }

    /// The mistakes, sorted by place.
    pub fn iter(&self) -> std::slice::Iter<'_, Mistake<Place>> {
        self.mistakes.iter()
    }

    /// How a terminal shows them: message, file, line, column, the line itself with carets, and the advice.
    #[must_use]
    pub fn render(&self, file: &str, text: &str) -> String {
        let shown: Vec<String> = self.mistakes.iter().map(|mistake| mistake.render(file, text)).collect();
        shown.join("\n")
    }
}

impl<'a> IntoIterator for &'a Mistakes {
    type Item = &'a Mistake<Place>;
    type IntoIter = std::slice::Iter<'a, Mistake<Place>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, Mistake { place, message, help }) in self.mistakes.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{}:{}: {message}", place.line, place.column)?;
            if let Some(help) = help {
                write!(f, "; {help}")?;
            }
        }
        Ok(())
    }
}

impl Mistake<Place> {
    /// One mistake as a terminal shows it, the last line ended.
    #[must_use]
    pub fn render(&self, file: &str, text: &str) -> String {
        let Self { place: Place { bytes, line, column }, message, help } = self;
        let source = text.lines().nth(line - 1).unwrap_or_default();
        // Of a line that no terminal holds, the part around the fault.
        let skipped = (column - 1).saturating_sub(LETTERS_BEFORE);
        let cut = source.chars().count() > LONGEST_LINE;
        let (source, column_shown): (String, usize) = if cut {
            (source.chars().skip(skipped).take(LONGEST_LINE).collect(), column - skipped)
        } else {
            (source.to_owned(), *column)
        };
        let margin = " ".repeat(line.to_string().len());
        // A tab stays a tab in the padding, so that the caret stands below its character in any terminal.
        let padding: String =
            source.chars().take(column_shown - 1).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let fault = text.get(bytes.clone()).unwrap_or_default().lines().next().unwrap_or_default();
        let carets = "^".repeat(fault.chars().count().clamp(1, LONGEST_LINE));
        let mut shown = format!(
            "error: {message}\n{margin}--> {file}:{line}:{column}\n{margin} |\n{line} | {source}\n{margin} | {padding}{carets}\n"
        );
        if let Some(help) = help {
            shown.push_str(&format!("{margin} = help: {help}\n"));
        }
        shown
    }
}

/// The line and column of the first byte of a range, which is clamped to the text.
fn place(text: &str, line_starts: &[usize], bytes: Range<usize>) -> Place {
    let mut start = bytes.start.min(text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let line = line_starts.partition_point(|&first| first <= start);
    let line_start = line_starts[line - 1];
    let column = text[line_start..start].chars().count() + 1;
    Place { bytes: start..bytes.end.clamp(start, text.len()), line, column }
}
