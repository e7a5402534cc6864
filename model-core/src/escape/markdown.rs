//! Markdown, which the documentation of Rust is: words stay words. A fence or an indented line of it would be code that a test
//! runs.

use std::borrow::Cow;

use super::letters::{is_unseen, lines, replaced};

/// A text as Markdown that shows it: no heading, list, link, element or block of code begins in it. Pairs of backquotes around code
/// on one line stay.
///
/// Source: CommonMark 0.31.2, sections 2.4 (escapes), 4.4 and 4.5 (code blocks), 6.1 (code spans).
#[must_use]
pub fn markdown(text: &str) -> String {
    let shown: Vec<String> = lines(text).iter().map(|line| one_line(line)).collect();
    shown.join("\n")
}

fn one_line(line: &str) -> String {
    // Without runs of blanks nothing is indented, neither at the start nor behind a list's mark.
    let words = line.split_whitespace().collect::<Vec<_>>().join(" ");
    let is_paired = !words.contains("``") && words.matches('`').count() % 2 == 0;
    let mut out = String::with_capacity(words.len() + 8);
    let mut in_code = false;
    let letters: Vec<char> = words.chars().collect();
    for (at, &letter) in letters.iter().enumerate() {
        let between_letters = || {
            let is_word =
                |at: Option<usize>| at.and_then(|at| letters.get(at)).is_some_and(|c| c.is_alphanumeric());
            is_word(at.checked_sub(1)) && is_word(Some(at + 1))
        };
        // What begins a list or underlines a heading does so at the start of its line.
        let begins = match letter {
            '+' | '-' | '=' => at == 0,
            '.' | ')' => at > 0 && letters[..at].iter().all(char::is_ascii_digit),
            _ => false,
        };
        let is_mark = match letter {
            '`' if is_paired => {
                in_code = !in_code;
                false
            }
            _ if in_code => false,
            '_' => !between_letters(),
            '`' | '\\' | '*' | '[' | ']' | '<' | '>' | '#' | '~' | '|' | '&' | '!' => true,
            _ => begins,
        };
        match letter {
            // Not every reader of Markdown takes a backslash before it.
            '<' if is_mark => out.push_str("&lt;"),
            letter if is_mark => out.extend(['\\', letter]),
            letter => out.push(letter),
        }
    }
    out
}

/// A text as code between backquotes, on one line of a table's cell or of a paragraph.
#[must_use]
pub fn markdown_code(text: &str) -> Cow<'_, str> {
    replaced(
        text,
        |letter| is_unseen(letter) || "`|".contains(letter),
        |out, letter| match letter {
            '`' => out.push('\''),
            '|' => out.push_str("\\|"),
            '\n' | '\t' | '\r' => out.push(' '),
            letter => out.push_str(&format!("<U+{:04X}>", u32::from(letter))),
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_words() {
        for (text, shown) in [
            ("```\npanic!()\n```", "\\`\\`\\`\npanic\\!()\n\\`\\`\\`"),
            ("    panic!()", "panic\\!()"),
            ("-      panic!()", "\\- panic\\!()"),
            ("> ~~~\n1.     x", "\\> \\~\\~\\~\n1\\. x"),
            ("> \tcode", "\\> code"),
            ("the `axis[0]` of dx_1", "the `axis[0]` of dx_1"),
            ("a ` b", "a \\` b"),
            ("<script> [x](y) **b** _c_", "&lt;script\\> \\[x\\](y) \\*\\*b\\*\\* \\_c\\_"),
            ("===", "\\==="),
            ("é\u{202e}", "é&lt;U+202E\\>"),
            ("Tilt about x, 0.5 m away.", "Tilt about x, 0.5 m away."),
        ] {
            assert_eq!(markdown(text), shown, "{text:?}");
        }
    }
}
