//! What print sets around formulas: numbers, dollars, punctuation, alignment, broken lines. It is taken away where it
//! cannot be anything else, and refused where it could.

mod environments;

use std::ops::Range;

use super::Unreadable;
use super::token::{Kind, Token};
use environments::is_display;
use model_core::mistake::Mistake;

pub(super) use environments::MATRICES;

/// One formula of a text: what is named on the left of `=`, and the formula.
#[derive(Debug)]
pub(super) struct Row {
    pub name: Vec<Token>,
    pub formula: Vec<Token>,
    /// Empty place behind the last token of the formula.
    pub end: Range<usize>,
}

/// Splits a text into its formulas: at ends of rows, and at commas where `list` is set. Rows that go on are joined.
pub(super) fn rows(text: &str, tokens: Vec<Token>, list: bool) -> Result<Vec<Row>, Unreadable> {
    let tokens = unwrapped(text, tokens)?;
    let end = tokens.last().map_or(text.len(), |token| token.place.end);
    let mut rows: Vec<Row> = Vec::new();
    for line in split(&tokens, |kind| *kind == Kind::Row) {
        let line = within_brackets(line)?;
        let pieces: Vec<Vec<Token>> = if list { split(&line, is_comma) } else { vec![line] };
        for piece in pieces {
            rows.push(named(piece, end)?);
        }
    }
    if rows.len() > 1 && rows.last().is_some_and(|row| row.formula.is_empty() && row.name.is_empty()) {
        rows.pop();
    }
    joined(rows, list)
}

/// What stands between the signs of equality of a display, whichever lines they begin.
pub(super) fn sides(text: &str, tokens: Vec<Token>) -> Result<Vec<Vec<Token>>, Unreadable> {
    let tokens = unwrapped(text, tokens)?;
    let sides = split(&tokens, |kind| *kind == Kind::Mark('='));
    let is_layout = |token: &&Token| matches!(token.kind, Kind::Row | Kind::Mark('&'));
    let trimmed = |side: Vec<Token>| {
        let end = side.iter().rposition(|token| !is_layout(&token)).map_or(0, |last| last + 1);
        side[..end].iter().skip_while(is_layout).cloned().collect()
    };
    Ok(sides.into_iter().map(trimmed).collect())
}

/// The lines of a display, with those that go on: with `=`, or with an operator and no `=` of their own.
pub(super) fn lines(text: &str, tokens: Vec<Token>) -> Result<Vec<Vec<Token>>, Unreadable> {
    let tokens = unwrapped(text, tokens)?;
    let mut lines: Vec<Vec<Token>> = Vec::new();
    for line in split(&tokens, |kind| *kind == Kind::Row) {
        let equals = |token: &Token| token.kind == Kind::Mark('=');
        let Some(first) = line.iter().find(|token| token.kind != Kind::Mark('&')) else { continue };
        let goes_on = equals(first) || (is_operator(first) && !line.iter().any(equals));
        match lines.last_mut() {
            Some(last) if goes_on || last.last().is_some_and(is_operator) => last.extend(line),
            _ => lines.push(line),
        }
    }
    Ok(lines)
}

/// The tokens without what print sets around all of them.
fn unwrapped(text: &str, mut tokens: Vec<Token>) -> Result<Vec<Token>, Unreadable> {
    without_numbers(&mut tokens)?;
    without_math(text, &mut tokens)?;
    without_wide_spaces(&mut tokens)?;
    without_wrapping(&mut tokens);
    without_punctuation(&mut tokens);
    Ok(tokens)
}

/// Equations that stand beside one another: parts between wide spaces, or between a comma and a column, that have each a sign of equality;
/// otherwise parts between commas that have.
pub(super) fn beside(text: &str, mut tokens: Vec<Token>) -> Result<Vec<Vec<Token>>, Unreadable> {
    without_numbers(&mut tokens)?;
    without_math(text, &mut tokens)?;
    without_wrapping(&mut tokens);
    if has_lines(&tokens) {
        return Ok(Vec::new());
    }
    // A column behind a comma parts as a wide space does.
    for at in 1..tokens.len() {
        if tokens[at].kind == Kind::Mark('&') && is_comma(&tokens[at - 1].kind) {
            tokens[at].kind = Kind::Wide;
        }
    }
    let equations = |parts: &dyn Fn(&Kind) -> bool| {
        let mut pieces = split(&tokens, parts);
        for piece in &mut pieces {
            let ends =
                |token: &Token| is_comma(&token.kind) || matches!(token.kind, Kind::Mark('.') | Kind::Wide);
            while piece.last().is_some_and(ends) {
                piece.pop();
            }
        }
        pieces.retain(|piece| !piece.is_empty());
        let is_equation = |piece: &Vec<Token>| split(piece, |kind| *kind == Kind::Mark('=')).len() > 1;
        if pieces.iter().all(is_equation) { pieces } else { Vec::new() }
    };
    let spaced = equations(&|kind| *kind == Kind::Wide);
    Ok(if spaced.len() > 1 { spaced } else { equations(&|kind| is_comma(kind) || *kind == Kind::Wide) })
}

/// A comma or a semicolon, which parts a list.
fn is_comma(kind: &Kind) -> bool {
    matches!(kind, Kind::Mark(',' | ';'))
}

/// Whether a comma stands outside all brackets: then these tokens are a list.
pub(super) fn is_list(tokens: &[Token]) -> bool {
    split(tokens, is_comma).len() > 1
}

/// Whether lines end within these tokens, outside all brackets and environments.
pub(super) fn has_lines(tokens: &[Token]) -> bool {
    split(tokens, |kind| *kind == Kind::Row).len() > 1
}

/// `\quad (6)`, `\hfill (A.2)`: the number of an equation behind a wide space, or behind the end of mathematics.
fn without_numbers(tokens: &mut Vec<Token>) -> Result<(), Unreadable> {
    let mut at = 0;
    while at < tokens.len() {
        let behind_space = at > 0
            && matches!(tokens[at - 1].kind, Kind::Wide | Kind::Math)
            && tokens[at].kind == Kind::Mark('(');
        let length = if behind_space { number_length(&tokens[at..]) } else { None };
        match length {
            Some(length) if is_end(tokens.get(at + length)) => {
                tokens.drain(at..at + length);
            }
            _ => at += 1,
        }
    }
    Ok(())
}

/// The tokens of `(6)`, `(12a)`, `(A.2)`, `(3-1)`.
fn number_length(tokens: &[Token]) -> Option<usize> {
    let close = tokens.iter().take(12).position(|token| token.kind == Kind::Mark(')'))?;
    let inside = &tokens[1..close];
    let fits = inside.iter().all(|token| match &token.kind {
        Kind::Digit(_) | Kind::Mark('.' | '-' | '\'' | '*') => true,
        Kind::Word(word) => word.chars().count() == 1,
        _ => false,
    });
    let has_digit = inside.iter().any(|token| matches!(token.kind, Kind::Digit(_)));
    (fits && has_digit).then_some(close + 1)
}

/// Whether a formula ends before this token.
fn is_end(token: Option<&Token>) -> bool {
    token.is_none_or(|token| {
        matches!(token.kind, Kind::Row | Kind::End(_) | Kind::Math | Kind::Wide | Kind::Mark('.' | ',' | ';'))
    })
}

/// Dollars around formulas, which stand at ends of formulas only.
fn without_math(text: &str, tokens: &mut Vec<Token>) -> Result<(), Unreadable> {
    let count = tokens.iter().filter(|token| token.kind == Kind::Math).count();
    if let Some(odd) = tokens.iter().find(|token| token.kind == Kind::Math && count % 2 == 1) {
        let shown = &text[odd.place.clone()];
        return Err(Mistake::new(odd.place.clone(), format!("`{shown}` without its partner")));
    }
    // Between two displays one formula ends.
    let marks: Vec<usize> = (0..tokens.len()).filter(|&at| tokens[at].kind == Kind::Math).collect();
    for pair in marks[1.min(marks.len())..].chunks(2) {
        if let [close, open] = *pair
            && open == close + 1
        {
            tokens[close].kind = Kind::Row;
            tokens[open].kind = Kind::Wide;
        }
    }
    for at in 0..tokens.len() {
        if tokens[at].kind != Kind::Math {
            continue;
        }
        let before = at.checked_sub(1).and_then(|before| tokens.get(before));
        let starts = before.is_none_or(|token| is_end(Some(token)) || matches!(token.kind, Kind::Begin(_)));
        if !starts && !is_end(tokens.get(at + 1)) {
            return Err(Mistake::new(
                tokens[at].place.clone(),
                "mathematics ends and begins within a formula",
            )
            .with_help("one formula stands between two dollars"));
        }
    }
    tokens.retain(|token| token.kind != Kind::Math);
    Ok(())
}

/// A wide space beside an operator, a relation or an end means nothing; between factors it is no product.
fn without_wide_spaces(tokens: &mut Vec<Token>) -> Result<(), Unreadable> {
    let is_loose = |token: Option<&Token>| {
        is_end(token)
            || token.is_some_and(|token| {
                matches!(
                    token.kind,
                    Kind::Mark('+' | '-' | '*' | '×' | '/' | '=' | '&') | Kind::Begin(_) | Kind::Wide
                )
            })
    };
    for at in 0..tokens.len() {
        if tokens[at].kind != Kind::Wide {
            continue;
        }
        let before = at.checked_sub(1).and_then(|before| tokens.get(before));
        if !is_loose(before) && !is_loose(tokens.get(at + 1)) {
            return Err(Mistake::new(
                tokens[at].place.clone(),
                "a wide space parts two formulas, or a formula from its number",
            )
            .with_help(r"leave out what does not belong to the formula; between factors write `\,`"));
        }
    }
    tokens.retain(|token| token.kind != Kind::Wide);
    Ok(())
}

/// `\begin{align} … \end{align}` around everything; an array of equations is one such, and so is the brace before or behind it.
fn without_wrapping(tokens: &mut Vec<Token>) {
    loop {
        without_punctuation(tokens);
        let holds_equations = tokens.iter().any(|token| token.kind == Kind::Mark('='));
        let has = |kind: &Kind| tokens.iter().any(|token| token.kind == *kind);
        let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return };
        if holds_equations && first.kind == Kind::OpenBrace && !has(&Kind::CloseBrace) {
            tokens.remove(0);
            continue;
        }
        if holds_equations && last.kind == Kind::CloseBrace && !has(&Kind::OpenBrace) {
            tokens.pop();
            continue;
        }
        let (Kind::Begin(name), Kind::End(end)) = (&first.kind, &last.kind) else { return };
        let is_wrapping = is_display(name) || (MATRICES.contains(&name.as_str()) && holds_equations);
        if name != end || !is_wrapping || closing(tokens, 0) != Some(tokens.len() - 1) {
            return;
        }
        tokens.pop();
        tokens.remove(0);
    }
}

/// Where the bracket or environment that opens at `open` closes.
fn closing(tokens: &[Token], open: usize) -> Option<usize> {
    let mut depth = 0i32;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        depth += step(&token.kind);
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// How much deeper a token leads.
fn step(kind: &Kind) -> i32 {
    match kind {
        Kind::Mark('(' | '[' | '{') | Kind::OpenBrace | Kind::Begin(_) => 1,
        Kind::Mark(')' | ']' | '}') | Kind::CloseBrace | Kind::End(_) => -1,
        _ => 0,
    }
}

/// Full stops and commas at the ends of formulas.
fn without_punctuation(tokens: &mut Vec<Token>) {
    let mut at = tokens.len();
    while at > 0 {
        at -= 1;
        let ends = matches!(
            tokens.get(at + 1).map(|token| &token.kind),
            None | Some(Kind::Row | Kind::End(_) | Kind::Mark(']'))
        );
        if ends && matches!(tokens[at].kind, Kind::Mark('.' | ',' | ';')) {
            tokens.remove(at);
        }
    }
}

/// The parts of a list of tokens between those that part it outside all brackets.
fn split(tokens: &[Token], parts: impl Fn(&Kind) -> bool) -> Vec<Vec<Token>> {
    let mut depth = 0;
    let mut pieces = vec![Vec::new()];
    for token in tokens {
        depth += step(&token.kind);
        if depth <= 0 && parts(&token.kind) {
            pieces.push(Vec::new());
        } else if let Some(last) = pieces.last_mut() {
            last.push(token.clone());
        }
    }
    pieces
}

/// A line broken inside brackets goes on with an operator; marks of alignment outside matrices mean nothing.
fn within_brackets(line: Vec<Token>) -> Result<Vec<Token>, Unreadable> {
    let mut environments: Vec<&str> = Vec::new();
    let mut kept = Vec::with_capacity(line.len());
    for (at, token) in line.iter().enumerate() {
        match &token.kind {
            Kind::Begin(name) => environments.push(name),
            Kind::End(_) => {
                environments.pop();
            }
            _ => {}
        }
        let in_matrix = environments.last().is_some_and(|name| MATRICES.contains(name));
        match token.kind {
            Kind::Mark('&') if !in_matrix => {
                let beside = |token: Option<&Token>| {
                    token.is_none_or(|token| is_operator(token) || token.kind == Kind::Row)
                };
                let before = at.checked_sub(1).and_then(|before| line.get(before));
                if !beside(before) && !beside(line.get(at + 1)) {
                    return Err(Mistake::new(token.place.clone(), "`&` between two factors")
                        .with_help("it aligns rows at `=`, `+` and `-`, and parts the entries of a matrix"));
                }
            }
            Kind::Row if !in_matrix => {
                let before = kept.last();
                let next = line[at + 1..].iter().find(|token| token.kind != Kind::Mark('&'));
                if !before.is_some_and(is_operator) && !next.is_some_and(is_operator) {
                    return Err(Mistake::new(token.place.clone(), "a line ends within brackets")
                        .with_help("the next one has to go on with `+` or `-`"));
                }
            }
            _ => kept.push(token.clone()),
        }
    }
    Ok(kept)
}

fn is_operator(token: &Token) -> bool {
    matches!(token.kind, Kind::Mark('+' | '-' | '*' | '×' | '/' | '='))
}

/// A line with what stands on the left of its `=`.
fn named(line: Vec<Token>, end: usize) -> Result<Row, Unreadable> {
    let end = line.last().map_or(end, |token| token.place.end);
    let pieces = split(&line, |kind| *kind == Kind::Mark('='));
    let place = end..end;
    match <[Vec<Token>; 2]>::try_from(pieces) {
        Ok([name, formula]) => Ok(Row { name, formula, end: place }),
        Err(pieces) if pieces.len() == 1 => Ok(Row { name: Vec::new(), formula: line, end: place }),
        Err(_) => {
            let second = line.iter().filter(|token| token.kind == Kind::Mark('=')).nth(1);
            let place = second.map_or(place, |token| token.place.clone());
            Err(Mistake::new(place, "two formulas are said to be equal here")
                .with_help("give one of them; the other is a claim of its own"))
        }
    }
}

/// Joins rows that go on: behind a named row, one without a name that begins with an operator.
fn joined(rows: Vec<Row>, list: bool) -> Result<Vec<Row>, Unreadable> {
    let any_named = rows.iter().any(|row| !row.name.is_empty());
    let mut joined: Vec<Row> = Vec::new();
    for row in rows {
        let first = row.formula.first();
        let begins = first.is_some_and(is_operator);
        let plus = first.is_some_and(|token| matches!(token.kind, Kind::Mark('+' | '*' | '×' | '/')));
        let Some(last) = joined.last_mut().filter(|_| row.name.is_empty()) else {
            joined.push(row);
            continue;
        };
        let open = last.formula.last().is_some_and(is_operator) || last.formula.is_empty();
        if plus || open || (begins && (any_named || !list)) {
            last.formula.extend(row.formula);
            last.end = row.end;
        } else if any_named || !list {
            let place = first.map_or(row.end.clone(), |token| token.place.clone());
            return Err(Mistake::new(place, "a row without `=` that does not go on with `+` or `-`")
                .with_help("give each component its `=`, or write `\\cdot` if the product goes on"));
        } else {
            joined.push(row);
        }
    }
    Ok(joined)
}
