//! Why a text has no tokens: a parenthesis without its other one, a quote that nothing closes, or a sign of no language.

use std::ops::Range;

use crate::mistake::Mistake;

/// What is wrong with a text that the lexer gave up on at a place.
pub fn why(text: &str, given_up: Range<usize>) -> Mistake<Range<usize>> {
    without_its_other(text).unwrap_or_else(|| {
        let sign = text.get(given_up.start..).and_then(|rest| rest.chars().next());
        let message = sign
            .map_or_else(|| "this cannot be read".to_owned(), |sign| format!("`{sign}` cannot be read here"));
        Mistake::new(given_up, message).with_help("leave it out, or write `//` in front of a comment")
    })
}

/// The first parenthesis, brace, bracket or quote that has no other one.
fn without_its_other(text: &str) -> Option<Mistake<Range<usize>>> {
    let mut open: Vec<(usize, char)> = Vec::new();
    let mut at = 0;
    while let Some(letter) = text[at..].chars().next() {
        let rest = &text[at..];
        let place = at;
        at += match (comment(rest), quoted(rest)) {
            (Some(length), _) | (None, Some(Some(length))) => length,
            (None, Some(None)) => return Some(not_closed(place, "a text in quotes", '"')),
            (None, None) => letter.len_utf8(),
        };
        match letter {
            '(' | '[' | '{' => open.push((place, letter)),
            ')' | ']' | '}' => match open.pop() {
                Some((_, opener)) if other(opener) == letter => {}
                // Braces are around parentheses, and no parenthesis ends a block.
                Some((opened, opener)) if opener != '{' => {
                    return Some(not_closed(opened, "what it encloses", opener));
                }
                _ => {
                    let message = format!("`{letter}` closes nothing");
                    return Some(Mistake::new(place..place + 1, message).with_help("leave it out"));
                }
            },
            _ => {}
        }
    }
    let (opened, opener) = open.pop()?;
    let what = if opener == '{' { "this block, or of a block in it" } else { "what it encloses" };
    Some(not_closed(opened, what, opener))
}

fn not_closed(opened: usize, what: &str, opener: char) -> Mistake<Range<usize>> {
    Mistake::new(opened..opened + 1, format!("`{opener}` is not closed"))
        .with_help(format!("write `{}` at the end of {what}", other(opener)))
}

fn other(opener: char) -> char {
    match opener {
        '(' => ')',
        '[' => ']',
        '{' => '}',
        other => other,
    }
}

/// The length of a comment that begins here.
fn comment(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    rest.starts_with("/*").then(|| rest.find("*/").map_or(rest.len(), |end| end + 2))
}

/// The length of a text in quotes that begins here, itself absent where nothing closes it.
fn quoted(rest: &str) -> Option<Option<usize>> {
    let raw = rest.strip_prefix('r').map(|behind| behind.trim_start_matches('#'));
    if let Some(inside) = raw.and_then(|behind| behind.strip_prefix('"')) {
        let opening = rest.len() - inside.len();
        let end = format!("\"{}", "#".repeat(opening - 2));
        return Some(inside.find(&end).map(|found| opening + found + end.len()));
    }
    let inside = rest.strip_prefix('"')?;
    let mut is_escaped = false;
    let end = inside.char_indices().find(|&(_, letter)| {
        let ends = letter == '"' && !is_escaped;
        is_escaped = letter == '\\' && !is_escaped;
        ends
    });
    Some(end.map(|(place, _)| place + 2))
}

#[cfg(test)]
mod tests {
    use super::why;

    fn told(text: &str) -> (usize, String, String) {
        let mistake = why(text, 0..1);
        (mistake.place.start, mistake.message, mistake.help.unwrap_or_default())
    }

    #[test]
    fn what_has_no_other_one_is_named_where_it_opens() {
        for (text, place, message, help) in [
            ("chain A { x: Rx(a; }", 15, "`(` is not closed", "write `)` at the end of what it encloses"),
            ("chain A { x: Rx(a)); }", 18, "`)` closes nothing", "leave it out"),
            (
                "chain A { body b { }",
                8,
                "`{` is not closed",
                "write `}` at the end of this block, or of a block in it",
            ),
            ("symbol a = \"x;\n}", 11, "`\"` is not closed", "write `\"` at the end of a text in quotes"),
            // What stands in comments and quotes opens nothing.
            (
                "// (\n/* { */ r#\"(\"#, \"\\\"(\", r\"\\\" 'a'",
                0,
                "`/` cannot be read here",
                "leave it out, or write `//` in front of a comment",
            ),
        ] {
            assert_eq!(told(text), (place, message.to_owned(), help.to_owned()), "{text}");
        }
    }
}
