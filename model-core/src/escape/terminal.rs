//! A terminal: what is shown there commands nothing, and a message is one line.

use std::borrow::Cow;
use std::fmt;

use super::letters::{by_number, is_unseen, replaced};

/// Letters that a message has at most.
const LONGEST: usize = 4000;
/// Of a longer one, those at its end that are shown.
const END: usize = 500;
/// Letters that a message shows of a cell or a name.
const CLIPPED: usize = 60;

/// A text on one line, every letter seen: a line break is `\n`, a mark of direction `\u{202e}`.
#[must_use]
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, is_unseen, by_number)
}

/// A whole message on one line, as [`line()`]; the middle of a very long one is left out.
#[must_use]
pub fn message(text: &str) -> Cow<'_, str> {
    // No more is read than may be shown, however long the text.
    let Some((cut, _)) = text.char_indices().nth(LONGEST) else { return line(text) };
    let start = &text[..cut];
    let end = text.char_indices().rev().nth(END - 1).map_or("", |(at, _)| &text[at..]);
    let start = start.char_indices().nth(LONGEST - END).map_or(start, |(at, _)| &start[..at]);
    Cow::Owned(format!("{} […] {}", line(start), line(end)))
}

/// The start of a cell or a name, as a message shows it.
#[must_use]
pub fn clipped(text: &str) -> String {
    match text.char_indices().nth(CLIPPED) {
        Some((end, _)) => format!("{}…", line(&text[..end])),
        None => line(text).into_owned(),
    }
}

/// An answer for a terminal. What is written to it is escaped but for line breaks and tabs; styles come by
/// [`Screen::styled`] alone.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Screen(String);

impl Screen {
    /// Words between what switches a style on and off.
    pub fn styled(&mut self, [on, off]: [&dyn fmt::Display; 2], words: &str) {
        self.0.push_str(&format!("{on}{}{off}", on_lines(words)));
    }

    /// The same words laid out anew by `lay_out`, which must not add any.
    #[must_use]
    pub fn laid_out(&self, lay_out: impl FnOnce(&str) -> String) -> String {
        lay_out(&self.0)
    }

    /// Another answer behind this one.
    pub fn append(&mut self, other: &Self) {
        self.0.push_str(&other.0);
    }

    /// What the terminal gets.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Write for Screen {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.push_str(&on_lines(text));
        Ok(())
    }
}

impl<T: AsRef<str>> From<T> for Screen {
    fn from(text: T) -> Self {
        Self(on_lines(text.as_ref()).into_owned())
    }
}

/// Every letter seen but line breaks and tabs.
fn on_lines(text: &str) -> Cow<'_, str> {
    replaced(text, |letter| is_unseen(letter) && letter != '\n' && letter != '\t', by_number)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;

    #[test]
    fn a_message_is_one_line_that_commands_nothing() {
        assert_eq!(message("`a\u{1b}]0;x\u{7}`\nerror: b"), r"`a\u{1b}]0;x\u{7}`\nerror: b");
        assert_eq!(
            message("\u{9b}31m\u{202e}\u{200b}\u{2028}\r\t"),
            r"\u{9b}31m\u{202e}\u{200b}\u{2028}\r\t"
        );
        assert_eq!(message("Δθ_y1 = 3″, weiß, 日本, e\u{301}"), "Δθ_y1 = 3″, weiß, 日本, e\u{301}");
        // What is shown is shown the same when it passes again.
        assert_eq!(message(&message("\u{1b}")), message("\u{1b}"));
    }

    #[test]
    fn a_long_message_keeps_its_start_and_its_end() {
        let long = format!("start {} end", "é".repeat(10_000_000));
        let short = message(&long);
        assert!(short.chars().count() < 4100, "{}", short.chars().count());
        assert!(short.starts_with("start é") && short.ends_with("é end"), "{short}");
        assert_eq!(clipped(&"\u{1b}".repeat(100)), format!("{}…", r"\u{1b}".repeat(60)));
    }

    #[test]
    fn a_screen_has_no_style_but_ours() {
        let mut screen = Screen::default();
        screen.styled([&"\u{1b}[1m", &"\u{1b}[0m"], "a \u{1b}[31mheading");
        let cell = "cell\u{1b}[2J\r";
        let _ = write!(screen, "\n\t{cell}");
        assert_eq!(screen.as_str(), "\u{1b}[1ma \\u{1b}[31mheading\u{1b}[0m\n\tcell\\u{1b}[2J\\r");
    }
}
