//! Indices that stand on the left of their letter: `{}^0\mathbf{p}`, `^bR_s`, `\prescript{0}{1}{T}`.

use super::Unreadable;
use super::glyph;
use super::spaced;
use super::token::{self, Kind, Token};

/// Splits a text into tokens, with indices on the left marked, and commas where a list has spaces.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, Unreadable> {
    Ok(spaced::with_commas(text, as_set(text)?))
}

/// The same tokens as a text has them, without commas that it has not.
pub(super) fn as_set(text: &str) -> Result<Vec<Token>, Unreadable> {
    Ok(marked(token::tokens(text)?))
}

/// The same tokens with [`Kind::Left`] in front of indices on the left.
fn marked(tokens: Vec<Token>) -> Vec<Token> {
    let tokens = without_prescripts(tokens);
    let mut marked: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let kind = |offset: usize| tokens.get(at + offset).map(|token| &token.kind);
        let is_script = |kind: Option<&Kind>| matches!(kind, Some(Kind::Mark('^' | '_')));
        let empty = token.kind == Kind::Mark('{') && kind(1) == Some(&Kind::Mark('}'));
        let is_index = is_script(marked.last().map(|last| &last.kind));
        if empty && is_script(kind(2)) && !is_index {
            marked.push(Token { kind: Kind::Left, ..token.clone() });
            at += 2;
            continue;
        }
        // `{+}`: without the space around it.
        if token.kind == Kind::Mark('{')
            && matches!(kind(1), Some(Kind::Mark('+' | '-' | '*' | '×' | '/' | '=')))
            && kind(2) == Some(&Kind::Mark('}'))
            && marked.last().is_none_or(|last| !takes_group(&last.kind) || last.kind == Kind::Mark('}'))
        {
            marked.extend(tokens.get(at + 1).cloned());
            at += 3;
            continue;
        }
        // `{}+`: nothing, for the sake of the space before a sign.
        if empty && !is_index && marked.last().is_none_or(|last| !takes_group(&last.kind)) {
            at += 2;
            continue;
        }
        if token.kind == Kind::Mark('{')
            && kind(1)
                .is_some_and(|kind| matches!(kind, Kind::Word(_) | Kind::Command(_)) && glyph::starts(kind))
            && kind(2) == Some(&Kind::Mark('}'))
            && marked.last().is_none_or(|last| !takes_group(&last.kind))
        {
            marked.extend(tokens.get(at + 1).cloned());
            at += 3;
            continue;
        }
        // `[\omega]_\times^2`: what stands in an index begins nothing.
        let in_index = marked.len() > 1 && is_script(marked.get(marked.len() - 2).map(|token| &token.kind));
        if token.kind == Kind::Mark('^')
            && !in_index
            && marked.last().is_none_or(|last| begins_operand(&last.kind))
        {
            marked.push(Token { kind: Kind::Left, place: token.place.start..token.place.start, bold: false });
        }
        marked.push(token.clone());
        at += 1;
    }
    marked
}

/// Whether a group behind this token is its argument, or may be.
fn takes_group(kind: &Kind) -> bool {
    match kind {
        Kind::Mark(mark) => matches!(mark, '^' | '_' | '}'),
        Kind::Command(command) => !glyph::is_letter(command),
        _ => false,
    }
}

/// Whether an operand begins behind this token.
fn begins_operand(kind: &Kind) -> bool {
    matches!(
        kind,
        Kind::Mark('+' | '-' | '*' | '×' | '/' | '=' | '(' | '[' | '{' | '&' | ',' | ';')
            | Kind::OpenBrace
            | Kind::Row
            | Kind::Begin(_)
            | Kind::Math
            | Kind::Wide
    )
}

/// `\prescript{a}{b}{X}` as `{}^{a}_{b}X`.
fn without_prescripts(tokens: Vec<Token>) -> Vec<Token> {
    let mut found = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        at += 1;
        let is_prescript = matches!(&token.kind, Kind::Command(command) if command == "prescript");
        let groups = is_prescript.then(|| {
            let upper = group(&tokens, at)?;
            Some((upper, group(&tokens, at + upper)?))
        });
        let Some(Some((upper, lower))) = groups else {
            found.push(token.clone());
            continue;
        };
        let letter = group(&tokens, at + upper + lower);
        let mark = |kind| Token { kind, place: token.place.clone(), bold: false };
        found.extend([mark(Kind::Mark('{')), mark(Kind::Mark('}'))]);
        for (sign, range) in [('^', at..at + upper), ('_', at + upper..at + upper + lower)] {
            if range.len() > 2 {
                found.push(mark(Kind::Mark(sign)));
                found.extend_from_slice(&tokens[range]);
            }
        }
        at += upper + lower;
        if let Some(letter) = letter {
            found.extend_from_slice(&tokens[at + 1..at + letter - 1]);
            at += letter;
        }
    }
    found
}

/// The number of tokens of the group in braces that begins at `start`.
fn group(tokens: &[Token], start: usize) -> Option<usize> {
    let mut depth = 0usize;
    for (offset, token) in tokens.get(start..)?.iter().enumerate() {
        match token.kind {
            Kind::Mark('{') => depth += 1,
            Kind::Mark('}') if depth > 0 => depth -= 1,
            _ if depth == 0 => return None,
            _ => {}
        }
        if depth == 0 {
            return Some(offset + 1);
        }
    }
    None
}
