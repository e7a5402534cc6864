//! Vectors whose entries are parted by spaces, `[x\ y\ z]^T`: the transposition says that it is no product.

use super::token::{Kind, Token};

/// Spaces that part entries, wide ones first; a thin one does where there is no other.
const SPACES: [&[&str]; 2] =
    [&["\\ ", "\\;", "\\:", "\\>", "~", "\\quad", "\\qquad", "\\enspace", "\\hspace"], &["\\,"]];

/// Entries that such a list may have.
const MOST: usize = 6;

/// The tokens with commas between the entries of such lists.
pub(super) fn with_commas(text: &str, mut tokens: Vec<Token>) -> Vec<Token> {
    let mut at = 0;
    while at < tokens.len() {
        if matches!(tokens[at].kind, Kind::Mark('(' | '['))
            && let Some(close) = list_end(&tokens, at)
        {
            let wide = breaks(text, &tokens, at, close, SPACES[0]);
            let breaks = if wide.is_empty() { breaks(text, &tokens, at, close, SPACES[1]) } else { wide };
            if (1..MOST).contains(&breaks.len()) {
                for before in breaks.into_iter().rev() {
                    let place = tokens[before].place.start..tokens[before].place.start;
                    let comma = Token { kind: Kind::Mark(','), place, bold: false };
                    if tokens[before].kind == Kind::Wide {
                        tokens[before] = comma;
                    } else {
                        tokens.insert(before, comma);
                    }
                }
            }
        }
        at += 1;
    }
    tokens
}

/// Where the bracket at `open` closes, if it holds no commas and a transposition stands behind it.
fn list_end(tokens: &[Token], open: usize) -> Option<usize> {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.kind {
            Kind::Mark('(' | '[' | '{') | Kind::OpenBrace => depth += 1,
            Kind::Mark(')' | ']' | '}') | Kind::CloseBrace => depth -= 1,
            Kind::Mark(',' | ';' | '&' | '=') | Kind::Row | Kind::Begin(_) | Kind::End(_) | Kind::Math => {
                return None;
            }
            _ => {}
        }
        if depth == 0 {
            return is_transposed(&tokens[at + 1..]).then_some(at);
        }
    }
    None
}

fn is_transposed(behind: &[Token]) -> bool {
    let upper = match behind {
        [Token { kind: Kind::Mark('\''), .. }, ..] => return true,
        [Token { kind: Kind::Mark('^'), .. }, Token { kind: Kind::Mark('{'), .. }, upper, ..]
        | [Token { kind: Kind::Mark('^'), .. }, upper, ..] => upper,
        _ => return false,
    };
    match &upper.kind {
        Kind::Word(word) => word == "T",
        Kind::Command(command) => matches!(command.as_str(), "top" | "intercal"),
        _ => false,
    }
}

/// Before which tokens an entry begins behind a space.
fn breaks(text: &str, tokens: &[Token], open: usize, close: usize, spaces: &[&str]) -> Vec<usize> {
    let mut depth = 0;
    let mut found = Vec::new();
    let is_sign = |kind: &Kind| matches!(kind, Kind::Mark('+' | '-' | '*' | '×' | '/' | '^' | '_'));
    for at in open + 1..close {
        let (before, here) = (&tokens[at - 1], &tokens[at]);
        let is_inside = depth == 0 && at > open + 1 && !is_sign(&before.kind) && !is_sign(&here.kind);
        let gap = text.get(before.place.end..here.place.start).unwrap_or_default();
        let is_parted = here.kind == Kind::Wide || spaces.iter().any(|space| gap.contains(space));
        if is_inside && is_parted && before.kind != Kind::Wide {
            found.push(at);
        }
        match here.kind {
            Kind::Mark('(' | '[' | '{') | Kind::OpenBrace => depth += 1,
            Kind::Mark(')' | ']' | '}') | Kind::CloseBrace => depth -= 1,
            _ => {}
        }
    }
    found
}
