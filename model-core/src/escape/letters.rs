//! Letters that nobody sees, and how they are written where they are to be seen.

use std::borrow::Cow;

/// Whether a letter shows nothing, moves or hides what stands beside it, or commands a terminal: control characters, marks of
/// direction, separators of lines, letters without width, and those that are none.
///
/// Source: Unicode Technical Report 36, sections 2.9 and 3.6; Boucher and Anderson, Trojan Source (2021).
#[must_use]
pub fn is_unseen(letter: char) -> bool {
    letter.is_control()
        || matches!(letter,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{3164}' | '\u{ffa0}'
            | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{fdd0}'..='\u{fdef}' | '\u{feff}' | '\u{fff0}'..='\u{fffb}' | '\u{e0000}'..='\u{e0fff}')
        || u32::from(letter) & 0xfffe == 0xfffe
}

/// A text in which `write` puts something else in the place of every letter that is `escaped`.
pub(super) fn replaced(
    text: &str,
    escaped: impl Fn(char) -> bool,
    write: impl Fn(&mut String, char),
) -> Cow<'_, str> {
    if !text.contains(&escaped) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if escaped(letter) {
            write(&mut out, letter);
        } else {
            out.push(letter);
        }
    }
    Cow::Owned(out)
}

/// `\u{202e}`, and `\n`, `\r` and `\t`.
pub(super) fn by_number(out: &mut String, letter: char) {
    match letter {
        '\n' | '\r' | '\t' => out.extend(letter.escape_default()),
        letter => out.extend(letter.escape_unicode()),
    }
}

/// The lines of a text: what ends a line in some language ends it here, and letters that nobody sees are written by their number,
/// without a backslash, which some languages obey in comments too.
#[must_use]
pub fn lines(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\r' if letters.peek() == Some(&'\n') => {}
            '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}' => {
                lines.push(std::mem::take(&mut line));
            }
            '\t' => line.push(' '),
            letter if is_unseen(letter) => {
                line.push_str(&format!("<U+{:04X}>", u32::from(letter)));
            }
            letter => line.push(letter),
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}
