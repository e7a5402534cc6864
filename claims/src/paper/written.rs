//! How texts stand in a claims file, and in the list of what was not read.

use toml::Value;

use crate::latex;

/// A mistake and what to write instead.
pub(super) fn said(mistake: latex::Unreadable) -> String {
    mistake.help.map_or(mistake.message.clone(), |help| format!("{}; {help}", mistake.message))
}

pub(super) fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// An equation without what stands behind its last wide space: `\qquad k = 1, 2`.
pub(super) fn without_condition(text: &str) -> Option<String> {
    let at = text.rfind("\\qquad").or_else(|| text.rfind("\\quad"))?;
    let end = text[at..].find("\\end{").map_or(text.len(), |end| at + end);
    let is_condition = text[..at].contains('=') && !text[at..end].contains("\\\\");
    is_condition.then(|| format!("{}{}", &text[..at], &text[end..]))
}

/// A text as a key of TOML, which takes one line.
pub(super) fn key(text: &str) -> String {
    if !text.contains(|c: char| c == '\'' || c.is_control()) {
        return format!("'{text}'");
    }
    let escaped = text.chars().map(|letter| match letter {
        '"' | '\\' => format!("\\{letter}"),
        letter if letter.is_control() => format!("\\u{:04X}", u32::from(letter)),
        letter => letter.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}

/// A text as a string of TOML.
pub(super) fn quoted(text: &str) -> String {
    if text.contains("'''") || text.ends_with('\'') {
        return Value::String(text.to_owned()).to_string();
    }
    if text.contains(['\\', '\n', '"', '\'']) { format!("'''{text}'''") } else { format!("\"{text}\"") }
}
