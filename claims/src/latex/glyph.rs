//! A letter with what is set around it: `\theta_{y1}^0`. A printed symbol is one glyph or several: `\Delta\theta_{y1}^0`.
//!
//! Glyphs are in one normal form, whatever the order of the indices and with or without braces and typefaces, so
//! that equal print gives equal glyphs.

use std::ops::Range;

use super::Unreadable;
use super::commands::{DETERMINANT, FRACTIONS, FUNCTIONS, RAMP, refusal};
use super::token::{Kind, Token};
use super::typed::TYPED;
use model_core::mistake::Mistake;

/// One letter, with accents in its base, and its indices; empty where there is none.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Glyph {
    pub base: String,
    pub lower: String,
    pub upper: String,
    /// The indices on its left, with their marks: `^0_1`.
    pub left: String,
    /// Whether it is set in bold type.
    pub bold: bool,
}

impl Glyph {
    /// A letter without anything around it.
    pub fn bare(base: impl Into<String>) -> Self {
        let nothing = String::new;
        Self { base: base.into(), lower: nothing(), upper: nothing(), left: nothing(), bold: false }
    }
}

/// A glyph as it stands in a text.
#[derive(Debug, Clone)]
pub(super) struct ReadGlyph {
    pub glyph: Glyph,
    /// Byte range in the text.
    pub place: Range<usize>,
    /// Number of tokens it takes.
    pub tokens: usize,
}

/// Control words that set a mark on the letter behind them, or another alphabet, whose letters are others: `R` is no `\mathcal{R}`.
const ACCENTS: [&str; 12] = [
    "hat", "bar", "tilde", "dot", "ddot", "vec", "overline", "widehat", "mathcal", "mathscr", "mathfrak",
    "mathbb",
];

/// Control words that are no symbols.
const OPERATORS: [&str; 4] = ["sqrt", "degree", "top", RAMP];

/// Whether a control word can be (part of) a symbol.
fn is_symbol(command: &str) -> bool {
    !FUNCTIONS.contains(&command)
        && !FRACTIONS.contains(&command)
        && !OPERATORS.contains(&command)
        && command != DETERMINANT
        && refusal(command).is_none()
}

/// Whether a control word is a letter by itself: no accent, no function, no operator.
pub(super) fn is_letter(command: &str) -> bool {
    is_symbol(command) && !ACCENTS.contains(&command)
}

/// Whether a symbol starts with this token.
pub(super) fn starts(kind: &Kind) -> bool {
    match kind {
        Kind::Word(_) | Kind::Left => true,
        Kind::Command(command) => is_symbol(command),
        _ => false,
    }
}

/// Reads the glyph at the start of `tokens`; `None` where none stands.
pub(super) fn read(tokens: &[Token]) -> Result<Option<ReadGlyph>, Unreadable> {
    let mut used = 0;
    let mut left = String::new();
    if let Some(Token { kind: Kind::Left, place, .. }) = tokens.first() {
        used = 1;
        while let Some(Token { kind: Kind::Mark(mark @ ('^' | '_')), place, .. }) = tokens.get(used) {
            let (inside, length) = argument(&tokens[used + 1..], place)?;
            left.push(*mark);
            left.push_str(&inside);
            used += 1 + length;
        }
        if !tokens.get(used).is_some_and(|token| token.kind != Kind::Left && starts(&token.kind)) {
            return Err(Mistake::new(place.clone(), "an index without its letter"));
        }
    }
    let Some(first) = tokens.get(used).filter(|token| starts(&token.kind)) else {
        return Ok(None);
    };
    used += 1;
    let base = match &first.kind {
        Kind::Word(word) => word.clone(),
        Kind::Command(accent) if ACCENTS.contains(&accent.as_str()) => {
            let (inside, length) = argument(&tokens[used..], &first.place)?;
            used += length;
            format!("\\{accent}{{{inside}}}")
        }
        Kind::Command(command) => format!("\\{command}"),
        _ => return Ok(None),
    };
    let mut glyph = Glyph { left, bold: first.bold, ..Glyph::bare(base) };
    while let Some(token) = tokens.get(used) {
        let index = match token.kind {
            Kind::Mark('_') => &mut glyph.lower,
            Kind::Mark('^') => {
                // A degree sign or a transposition mark ends a glyph; neither is an index.
                let next = tokens.get(used + 1).map(|next| &next.kind);
                if matches!(next, Some(Kind::Command(command)) if !is_symbol(command)) {
                    break;
                }
                &mut glyph.upper
            }
            Kind::Mark('\'') => {
                glyph.upper.push('\'');
                used += 1;
                continue;
            }
            _ => break,
        };
        if !index.is_empty() {
            return Err(Mistake::new(token.place.clone(), "a second index at the same place")
                .with_help("put braces or parentheses around what it belongs to"));
        }
        let (inside, length) = argument(&tokens[used + 1..], &token.place)?;
        *index = inside;
        used += 1 + length;
    }
    let start = tokens.first().map_or(first.place.start, |token| token.place.start);
    let place = start..tokens[used - 1].place.end;
    Ok(Some(ReadGlyph { glyph, place, tokens: used }))
}

/// The names in parentheses behind a symbol, `(\alpha, \beta)`, each in normal form, and the number of tokens; `None` if
/// anything but symbols stands there.
pub(super) fn arguments(tokens: &[Token]) -> Option<(Vec<Vec<Glyph>>, usize)> {
    if tokens.first()?.kind != Kind::Mark('(') {
        return None;
    }
    let mut used = 1;
    let mut found = Vec::new();
    loop {
        let mut glyphs = Vec::new();
        while let Ok(Some(read)) = read(tokens.get(used..)?) {
            used += read.tokens;
            glyphs.push(read.glyph);
        }
        if glyphs.is_empty() {
            return None;
        }
        found.push(glyphs);
        used += 1;
        match tokens.get(used - 1)?.kind {
            Kind::Mark(')') => return Some((found, used)),
            Kind::Mark(',') => {}
            _ => return None,
        }
    }
}

/// The argument of an index or an accent, one token or a group in braces, as text without spaces and inner braces;
/// and the number of its tokens.
fn argument(tokens: &[Token], after: &Range<usize>) -> Result<(String, usize), Unreadable> {
    let missing = || Mistake::new(after.clone(), "nothing stands behind this").with_help("`x_{1}`");
    let first = tokens.first().ok_or_else(missing)?;
    if first.kind != Kind::Mark('{') {
        return Ok((plain(&first.kind).ok_or_else(missing)?, 1));
    }
    let mut depth = 0usize;
    let mut text = String::new();
    for (index, token) in tokens.iter().enumerate() {
        match &token.kind {
            Kind::Mark('{') => depth += 1,
            Kind::Mark('}') => depth -= 1,
            kind => text.push_str(&plain(kind).ok_or_else(missing)?),
        }
        if depth == 0 {
            return if text.is_empty() { Err(missing()) } else { Ok((text, index + 1)) };
        }
    }
    Err(Mistake::new(first.place.clone(), "this brace is never closed").with_help("`}`"))
}

/// A token of an index as text.
fn plain(kind: &Kind) -> Option<String> {
    match kind {
        Kind::Word(word) => Some(word.clone()),
        Kind::Command(command) => Some(format!("\\{command}")),
        Kind::Digit(digit) => Some(digit.to_string()),
        Kind::Mark('}') => None,
        Kind::Mark(mark) => Some(mark.to_string()),
        _ => None,
    }
}

/// A sequence of glyphs as LaTeX in one normal form, for messages and suggestions.
pub(super) fn normal_text(glyphs: &[Glyph]) -> String {
    let mut text = String::new();
    for glyph in glyphs {
        if !glyph.left.is_empty() {
            text.push_str(&format!("{{}}{}", glyph.left));
        }
        if glyph.bold {
            text.push_str(&format!("\\mathbf{{{}}}", glyph.base));
        } else {
            text.push_str(&glyph.base);
        }
        for (mark, index) in [('_', &glyph.lower), ('^', &glyph.upper)] {
            if !index.is_empty() {
                text.push_str(&format!("{mark}{{{index}}}"));
            }
        }
    }
    text
}

/// A sequence of glyphs letter by letter, without markup, so that likeness can be measured.
pub(super) fn spelling(glyphs: &[Glyph]) -> String {
    let mut text: String = glyphs
        .iter()
        .flat_map(|glyph| [&glyph.base, &glyph.lower, &glyph.upper])
        .map(String::as_str)
        .collect();
    for (letter, command) in TYPED {
        text = text.replace(&format!("\\{command}"), &letter.to_string());
    }
    text
}
