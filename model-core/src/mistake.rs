//! Mistakes in a text that a person wrote: where, what is wrong, what to write instead; and how they are shown.
//!
//! The same shape serves the parser, the checker of declarations and every other reader of a file: `S` is a
//! token's span while a macro may still point at it, and a [`Place`] once it is counted in lines and columns.

use std::fmt;
use std::ops::Range;

use crate::escape::message as shown;

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
            write!(f, "{}:{}: {}", place.line, place.column, shown(message))?;
            if let Some(help) = help {
                write!(f, "; {}", shown(help))?;
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
        let (message, file) = (shown(message), shown(file));
        let source = text.lines().nth(line - 1).unwrap_or_default();
        let margin = " ".repeat(line.to_string().len());
        let fault = text.get(bytes.clone()).unwrap_or_default().lines().next().unwrap_or_default();
        let Excerpt { shown: source, padding, width } =
            Excerpt::new(source, column - 1, fault.chars().count());
        let carets = "^".repeat(width);
        let mut rendered = format!(
            "error: {message}\n{margin}--> {file}:{line}:{column}\n{margin} |\n{line} | {source}\n{margin} | {padding}{carets}\n"
        );
        if let Some(help) = help {
            rendered.push_str(&format!("{margin} = help: {}\n", shown(help)));
        }
        rendered
    }
}

/// The stretch of a line around a place, as far as a reader takes it in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// The stretch, with `…` where the line goes on.
    pub shown: String,
    /// Blanks as wide as what stands in front of the place; a tab stays a tab, so that a caret below them stands below
    /// its character in any terminal.
    pub padding: String,
    /// How many characters the place takes of the stretch as it is shown, at least one.
    pub width: usize,
}

impl Excerpt {
    /// Characters that are shown of a longer line.
    const WIDEST: usize = 160;
    /// Of these, those in front of the place.
    const BEFORE: usize = 60;

    /// The place is `width` characters behind the first `before`.
    #[must_use]
    pub fn new(line: &str, before: usize, width: usize) -> Self {
        let width = width.max(1);
        let fits = line.chars().take(Self::WIDEST + 1).count() <= Self::WIDEST;
        let (skipped, taken) =
            if fits { (0, Self::WIDEST) } else { (before.saturating_sub(Self::BEFORE), Self::WIDEST) };
        // Letters that nobody sees are written by their number, which takes more room than one letter.
        let seen = |letter: char| match letter {
            '\t' => "\t".to_owned(),
            letter => crate::escape::line(letter.encode_utf8(&mut [0; 4])).into_owned(),
        };
        let stretch: Vec<String> = line.chars().skip(skipped).take(taken).map(seen).collect();
        let room = |letters: &[String]| letters.iter().map(|letters| letters.chars().count()).sum::<usize>();
        let (front, place) = stretch.split_at((before - skipped).min(stretch.len()));
        let width = room(&place[..width.min(place.len())]).max(1);
        let mut shown = stretch.concat();
        let blank = |letters: &String| {
            if letters == "\t" { letters.clone() } else { " ".repeat(letters.chars().count()) }
        };
        let mut padding: String = front.iter().map(blank).collect();
        if skipped > 0 {
            shown.insert_str(0, "… ");
            padding.insert_str(0, "  ");
        }
        if !fits && line.chars().nth(skipped + taken).is_some() {
            shown.push_str(" …");
        }
        Self { shown, padding, width }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_clipped_around_the_place() {
        let line = format!("{}WRONG{}", "a".repeat(50_000), "b".repeat(50_000));
        let excerpt = Excerpt::new(&line, 50_000, 5);
        assert!(excerpt.shown.chars().count() < 200 && excerpt.shown.starts_with("… a"), "{excerpt:?}");
        let below: String =
            excerpt.shown.chars().skip(excerpt.padding.chars().count()).take(excerpt.width).collect();
        assert_eq!(below, "WRONG");
        // A place that is wider than what is shown.
        let excerpt = Excerpt::new(&line, 10, 90_000);
        assert_eq!((excerpt.padding.len(), excerpt.width), (10, 150));
        assert!(excerpt.shown.ends_with(" …"));
        // The end of a line, and behind it.
        for before in [100_004, 100_005] {
            let excerpt = Excerpt::new(&line, before, 3);
            assert_eq!(excerpt.width, 1);
            assert!(excerpt.padding.chars().count() <= excerpt.shown.chars().count());
        }
    }

    #[test]
    fn what_nobody_sees_is_shown_and_pointed_at() {
        let line = "a\u{1b}[31m \u{202e}\tWRO\u{200b}NG \r";
        let before = line.find("WRO").map_or(0, |at| line[..at].chars().count());
        let Excerpt { shown, padding, width } = Excerpt::new(line, before, 6);
        assert_eq!(shown, "a\\u{1b}[31m \\u{202e}\tWRO\\u{200b}NG \\r");
        let below: String = shown.chars().skip(padding.chars().count()).take(width).collect();
        assert_eq!((below.as_str(), padding.matches('\t').count()), ("WRO\\u{200b}NG", 1));
        let mistakes = Mistakes::locate(
            "a\nb\u{9b}c",
            [Mistake::new(5..6, "no \u{1b}[2J\nerror: forged").with_help("x\ry")],
        );
        let rendered = mistakes.render("f\n\u{202e}", "a\nb\u{9b}c");
        assert_eq!(
            rendered,
            "error: no \\u{1b}[2J\\nerror: forged\n --> f\\n\\u{202e}:2:3\n  |\n2 | b\\u{9b}c\n  |        ^\n  = help: x\\ry\n"
        );
        assert_eq!(mistakes.to_string(), "2:3: no \\u{1b}[2J\\nerror: forged; x\\ry");
    }

    #[test]
    fn a_short_line_is_shown_as_it_is() {
        let excerpt = Excerpt::new("\tab\tc", 3, 1);
        assert_eq!((excerpt.shown.as_str(), excerpt.padding.as_str(), excerpt.width), ("\tab\tc", "\t  ", 1));
    }
}
