//! The paper's own commands, written out.

use std::collections::BTreeMap;

use crate::latex::closing;

/// Commands that a source defines, with the number of their arguments.
#[derive(Debug, Default)]
pub(super) struct Macros {
    known: BTreeMap<String, (usize, String)>,
}

/// Characters that an equation may grow to, and rounds of writing out.
const LONGEST: usize = 50_000;
const DEEPEST: usize = 12;

impl Macros {
    /// The definitions of a source.
    pub fn of_source(source: &str) -> Self {
        let mut macros = Self::default();
        for word in ["\\newcommand", "\\renewcommand", "\\providecommand", "\\def", "\\DeclareMathOperator"] {
            for (at, _) in source.match_indices(word) {
                let rest = &source[at + word.len()..];
                if rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
                    continue;
                }
                let found = if word == "\\def" { defined(rest) } else { commanded(rest) };
                if let Some((name, count, body)) = found {
                    let body = if word == "\\DeclareMathOperator" {
                        format!("\\operatorname{{{body}}}")
                    } else {
                        body
                    };
                    macros.known.insert(name, (count, body));
                }
            }
        }
        macros
    }

    /// An equation with the commands written out.
    pub fn expanded(&self, text: &str) -> String {
        let mut text = text.to_owned();
        for _ in 0..DEEPEST {
            let next = self.once(&text);
            if next == text || next.len() > LONGEST {
                break;
            }
            text = next;
        }
        text
    }

    fn once(&self, text: &str) -> String {
        let mut out = String::with_capacity(text.len());
        let mut at = 0;
        while let Some(offset) = text[at..].find('\\') {
            out.push_str(&text[at..at + offset]);
            let start = at + offset;
            let rest = &text[start + 1..];
            let length = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
            let name = &rest[..length];
            at = start + 1 + length;
            if length == 0 {
                // `\\` and `\,` keep what stands behind the backslash.
                let skipped = rest.chars().next().map_or(0, char::len_utf8);
                out.push_str(&text[start..at + skipped]);
                at += skipped;
                continue;
            }
            let Some((count, body)) = self.known.get(name) else {
                out.push_str(&text[start..at]);
                continue;
            };
            let mut arguments = Vec::with_capacity(*count);
            let mut end = at;
            for _ in 0..*count {
                let Some((argument, length)) = argument(&text[end..]) else { break };
                arguments.push(argument);
                end += length;
            }
            if arguments.len() < *count {
                out.push_str(&text[start..at]);
                continue;
            }
            let mut written = body.clone();
            for (nth, argument) in arguments.iter().enumerate() {
                written = written.replace(&format!("#{}", nth + 1), argument);
            }
            out.push_str(&written);
            // `\x y` must not become one word.
            if written.ends_with(|c: char| c.is_ascii_alphabetic())
                && text[end..].starts_with(|c: char| c.is_ascii_alphabetic())
            {
                out.push(' ');
            }
            at = end;
        }
        out.push_str(&text[at..]);
        out
    }
}

/// `{\x}[2]{body}` or `\x{body}`, behind the word.
fn commanded(rest: &str) -> Option<(String, usize, String)> {
    let rest = rest.strip_prefix('*').unwrap_or(rest);
    let (name, length) = argument(rest)?;
    let name = name.trim().strip_prefix('\\')?.to_owned();
    let mut rest = rest[length..].trim_start();
    let mut count = 0;
    if let Some(inside) = rest.strip_prefix('[') {
        let close = inside.find(']')?;
        count = inside[..close].trim().parse().ok()?;
        rest = inside[close + 1..].trim_start();
        if rest.starts_with('[') {
            // A default for the first argument: not written out.
            return None;
        }
    }
    let (body, _) = argument(rest)?;
    Some((name, count, body))
}

/// `\x#1#2{body}`, behind `\def`.
fn defined(rest: &str) -> Option<(String, usize, String)> {
    let rest = rest.trim_start().strip_prefix('\\')?;
    let length = rest.find(|c: char| !c.is_ascii_alphabetic())?;
    let open = rest.find('{')?;
    let parameters = &rest[length..open];
    let count = parameters.matches('#').count();
    if parameters.chars().any(|c| !matches!(c, '#' | '0'..='9') && !c.is_whitespace()) {
        return None;
    }
    let (body, _) = argument(&rest[open..])?;
    Some((rest[..length].to_owned(), count, body))
}

/// A group in braces without them, or one command or character; and how many bytes it takes.
fn argument(text: &str) -> Option<(String, usize)> {
    let skipped = text.len() - text.trim_start().len();
    let rest = &text[skipped..];
    let first = rest.chars().next()?;
    if first == '\\' {
        let length = rest[1..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len() - 1).max(1);
        return Some((rest.get(..=length)?.to_owned(), skipped + 1 + length));
    }
    if first != '{' {
        return Some((first.to_string(), skipped + first.len_utf8()));
    }
    let close = closing(rest, 0)?;
    Some((rest[1..close].to_owned(), skipped + close + 1))
}
