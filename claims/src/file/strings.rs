//! Where a byte of a TOML string's value stands in the file: quotes, and escapes in basic strings, lie between.

use std::ops::Range;

/// The place in the file of a part of a string; `value` is the place of the whole string with its quotes, `inside`
/// a byte range of what it says.
#[must_use]
pub fn place_in_string(file: &str, value: Range<usize>, inside: Range<usize>) -> Range<usize> {
    let raw = file.get(value.clone()).unwrap_or_default();
    let (quotes, is_literal) = match raw.as_bytes() {
        [b'\'', b'\'', b'\'', ..] => (3, true),
        [b'"', b'"', b'"', ..] => (3, false),
        [b'\'', ..] => (1, true),
        [b'"', ..] => (1, false),
        _ => return value,
    };
    let mut start = quotes;
    if quotes == 3 {
        // A newline right behind the opening quotes is not part of the string.
        start += raw[start..].strip_prefix("\r\n").map_or(usize::from(raw[start..].starts_with('\n')), |_| 2);
    }
    let content = &raw[start..raw.len().saturating_sub(quotes).max(start)];
    let at = |byte: usize| {
        value.start + start + if is_literal { byte.min(content.len()) } else { raw_offset(content, byte) }
    };
    let end = at(inside.end);
    let mut begin = at(inside.start);
    if !is_literal {
        // Where a line goes on in the next one, the part begins there.
        begin += line_continuation(file.get(begin..end).unwrap_or_default());
    }
    begin..end
}

/// The length of a backslash at the end of a line with the blanks after it; zero if there is none at the start.
fn line_continuation(text: &str) -> usize {
    match text.strip_prefix('\\') {
        Some(rest) if rest.starts_with(char::is_whitespace) => text.len() - rest.trim_start().len(),
        _ => 0,
    }
}

/// Where the byte of an escaped text's value stands in the text.
fn raw_offset(content: &str, byte: usize) -> usize {
    let mut decoded = 0;
    let mut raw = 0;
    while decoded < byte {
        let Some(next) = content[raw..].chars().next() else { break };
        if next != '\\' {
            raw += next.len_utf8();
            decoded += next.len_utf8();
            continue;
        }
        let escape = &content[raw + 1..];
        let digits = match escape.chars().next() {
            Some('x') => 2,
            Some('u') => 4,
            Some('U') => 8,
            Some(c) if c.is_whitespace() => {
                raw += line_continuation(&content[raw..]);
                continue;
            }
            Some(c) => {
                raw += 1 + c.len_utf8();
                decoded += 1;
                continue;
            }
            None => break,
        };
        let code = escape.get(1..=digits).and_then(|code| u32::from_str_radix(code, 16).ok());
        decoded += code.and_then(char::from_u32).map_or(1, char::len_utf8);
        raw = (raw + 2 + digits).min(content.len());
    }
    raw
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What stands at the place of `part` of the first string of a file.
    fn found(file: &str, value: &str, part: &str) -> String {
        let span = file.find(['\'', '"']).unwrap_or(0)..file.len();
        let start = value.find(part).unwrap_or(0);
        file[place_in_string(file, span, start..start + part.len())].to_owned()
    }

    #[test]
    fn a_part_of_a_string_is_found_in_the_file() {
        assert_eq!(found(r"x = '\sin\beta + y'", r"\sin\beta + y", r"\beta"), r"\beta");
        assert_eq!(found(r#"x = "\\sin\\beta + y""#, r"\sin\beta + y", r"\beta"), r"\\beta");
        assert_eq!(found("x = \"\\u03b1 + \\\"y\"", "α + \"y", "\"y"), "\\\"y");
        assert_eq!(found("x = '''\nab'''", "ab", "b"), "b");
        assert_eq!(found("x = \"\"\"\na\\\n   b\"\"\"", "ab", "b"), "b");
    }
}
