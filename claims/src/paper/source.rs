//! Where equations stand in a source.

use std::ops::Range;

/// What a source is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// LaTeX.
    Tex,
    /// Markdown with mathematics.
    Markdown,
}

/// An equation of a source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Equation {
    /// The line that it begins in, counted from 1.
    pub line: usize,
    /// What stands between its delimiters.
    pub text: String,
    /// Whether it stands on lines of its own.
    pub is_display: bool,
    /// Where it stands in the source, delimiters included.
    pub place: Range<usize>,
}

/// Environments of displayed equations.
const DISPLAYS: [&str; 9] =
    ["equation", "align", "gather", "multline", "eqnarray", "displaymath", "flalign", "alignat", "dmath"];
/// Environments whose text is no mathematics.
const VERBATIM: [&str; 4] = ["verbatim", "lstlisting", "minted", "comment"];

/// Every equation, in order.
pub(super) fn equations(source: &str, kind: Kind) -> Vec<Equation> {
    let text = match kind {
        Kind::Tex => without_comments(source),
        Kind::Markdown => without_code(source),
    };
    let mut found = Vec::new();
    let mut at = match (kind, text.find(r"\begin{document}")) {
        (Kind::Tex, Some(start)) => start,
        _ => 0,
    };
    let end = if kind == Kind::Tex { text.find(r"\end{document}").unwrap_or(text.len()) } else { text.len() };
    while at < end {
        let rest = &text[at..end];
        let Some((open, close, is_display, inner)) = opening(rest, kind) else {
            at += rest.chars().next().map_or(1, char::len_utf8);
            continue;
        };
        let inside = at + open;
        let Some(length) = text[inside..end].find(close.as_str()) else {
            at = inside;
            continue;
        };
        let (from, to) = if inner { (inside, inside + length) } else { (at, inside + length + close.len()) };
        let content = text[from..to].trim();
        if !content.is_empty() && inner | DISPLAYS.iter().any(|name| rest[..open].contains(name)) {
            let line = source[..at].matches('\n').count() + 1;
            let place = at..inside + length + close.len();
            found.push(Equation { line, text: content.to_owned(), is_display, place });
        }
        at = inside + length + close.len();
    }
    found
}

/// What opens at the start of a text: the length of the delimiter, what closes it, whether it is displayed, and whether only
/// what stands inside is the equation.
fn opening(rest: &str, kind: Kind) -> Option<(usize, String, bool, bool)> {
    if let Some(name) = rest.strip_prefix(r"\begin{").and_then(|rest| rest.split('}').next()) {
        let open = r"\begin{}".len() + name.len();
        let close = format!(r"\end{{{name}}}");
        let bare = name.trim_end_matches('*');
        if DISPLAYS.contains(&bare) || VERBATIM.contains(&bare) {
            return Some((open, close, true, false));
        }
        return None;
    }
    if kind == Kind::Markdown && rest.starts_with("```math") {
        return Some((7, "```".to_owned(), true, true));
    }
    if kind == Kind::Markdown && rest.starts_with(r"\\[") {
        return Some((3, r"\\]".to_owned(), true, true));
    }
    for (open, close, display) in
        [("$$", "$$", true), (r"\[", r"\]", true), (r"\(", r"\)", false), ("$", "$", false)]
    {
        if rest.starts_with(open) {
            return Some((open.len(), close.to_owned(), display, true));
        }
    }
    // An escaped dollar is one.
    None
}

/// The text with comments as blanks, so that every byte stays where it is.
fn without_comments(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    for line in source.split_inclusive('\n') {
        let mut escaped = false;
        let comment = line.char_indices().find_map(|(at, c)| {
            let starts = c == '%' && !escaped;
            escaped = c == '\\' && !escaped;
            starts.then_some(at)
        });
        blanked(&mut out, line, comment.unwrap_or(line.len()));
    }
    out.replace(r"\$", "  ")
}

/// Markdown with code as blanks, fences of mathematics apart.
fn without_code(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    let mut in_code = false;
    let mut in_math = false;
    for line in source.split_inclusive('\n') {
        let fence = line.trim_start().starts_with("```") || line.trim_start().starts_with("~~~");
        if fence && !in_code && !in_math {
            in_math = line.trim_start().starts_with("```math");
            in_code = !in_math;
            blanked(&mut out, line, if in_math { line.len() } else { 0 });
            continue;
        }
        if fence {
            blanked(&mut out, line, if in_math { line.len() } else { 0 });
            (in_code, in_math) = (false, false);
            continue;
        }
        if in_code {
            blanked(&mut out, line, 0);
        } else {
            // Code within a line.
            let mut inside = false;
            for c in line.chars() {
                match c {
                    '`' if !in_math => {
                        inside = !inside;
                        out.push(' ');
                    }
                    c if inside && c != '\n' => (0..c.len_utf8()).for_each(|_| out.push(' ')),
                    c => out.push(c),
                }
            }
        }
    }
    out.replace(r"\$", "  ")
}

/// A line that is kept up to a byte, and blank behind.
fn blanked(out: &mut String, line: &str, keep: usize) {
    out.push_str(&line[..keep]);
    for c in line[keep..].chars() {
        if c == '\n' {
            out.push('\n');
        } else {
            (0..c.len_utf8()).for_each(|_| out.push(' '));
        }
    }
}
