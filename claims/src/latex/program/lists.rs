//! Lists and calls of programs as the tokens of matrices and products.

use std::ops::Range;

use super::super::Unreadable;
use super::super::token::{Kind, Token};
use model_core::mistake::Mistake;

/// Lists as matrices, calls of functions as what they compute.
pub(super) fn marked(tokens: Vec<Token>) -> Result<Vec<Token>, Unreadable> {
    let mut found = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        match &token.kind {
            Kind::Mark('[') => {
                let close = closing(&tokens, at)?;
                found.extend(list(&tokens[at..=close])?);
                at = close + 1;
            }
            Kind::Command(command) if command == "sqrt" || command.starts_with("call ") => {
                let close = closing(&tokens, at + 1)?;
                let inside = &tokens[at + 2..close];
                let name = command.strip_prefix("call ").unwrap_or(command);
                found.extend(call(name, token, inside)?);
                at = close + 1;
            }
            _ => {
                found.push(token.clone());
                at += 1;
            }
        }
    }
    Ok(found)
}

/// Where the bracket closes that opens at a token.
fn closing(tokens: &[Token], open: usize) -> Result<usize, Unreadable> {
    let opens = tokens.get(open).is_some_and(|token| matches!(token.kind, Kind::Mark('(' | '[')));
    if !opens {
        let place = tokens.get(open).or(tokens.last()).map_or(0..0, |token| token.place.clone());
        return Err(Mistake::new(place, "a function needs its argument in brackets, as in `sqrt(x)`"));
    }
    let mut depth = 0usize;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.kind {
            Kind::Mark('(' | '[') => depth += 1,
            Kind::Mark(')' | ']') => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return Ok(at);
        }
    }
    let place = tokens.get(open).map_or(0..0, |token| token.place.clone());
    Err(Mistake::new(place, "this bracket is never closed"))
}

/// The parts between marks outside of brackets.
fn parts<'a>(tokens: &'a [Token], marks: &[char]) -> Vec<&'a [Token]> {
    let mut depth = 0i32;
    let mut start = 0;
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Mark('(' | '[' | '{') => depth += 1,
            Kind::Mark(')' | ']' | '}') => depth -= 1,
            Kind::Mark(mark) if depth == 0 && marks.contains(&mark) => {
                found.push(&tokens[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    if start < tokens.len() {
        found.push(&tokens[start..]);
    }
    found
}

/// `[a, b, c]`, `[[a, b], [c, d]]`, `[a, b; c, d]`: a column, or rows.
fn list(tokens: &[Token]) -> Result<Vec<Token>, Unreadable> {
    let place = tokens[0].place.start..tokens[tokens.len() - 1].place.end;
    let inside = &tokens[1..tokens.len() - 1];
    let rows: Vec<Vec<&[Token]>> = match parts(inside, &[';']).as_slice() {
        [only] => {
            let entries = parts(only, &[',']);
            let nested = |entry: &&[Token]| {
                let first = entry.first().is_some_and(|token| token.kind == Kind::Mark('['));
                first && closing(entry, 0).is_ok_and(|close| close + 1 == entry.len())
            };
            match entries.as_slice() {
                [single] if nested(single) => return list(single),
                many if many.iter().all(nested) => {
                    many.iter().map(|entry| parts(&entry[1..entry.len() - 1], &[','])).collect()
                }
                many => many.iter().map(|entry| vec![*entry]).collect(),
            }
        }
        rows => rows.iter().map(|row| parts(row, &[','])).collect(),
    };
    let mark = |kind| Token { kind, place: place.clone(), bold: false };
    let mut found = vec![mark(Kind::Begin("matrix".to_owned()))];
    for (nth, row) in rows.into_iter().enumerate() {
        if nth > 0 {
            found.push(mark(Kind::Row));
        }
        for (nth, entry) in row.into_iter().enumerate() {
            if nth > 0 {
                found.push(mark(Kind::Mark('&')));
            }
            found.extend(marked(entry.to_vec())?);
        }
    }
    found.push(mark(Kind::End("matrix".to_owned())));
    Ok(found)
}

/// A call of a function of the language.
fn call(name: &str, token: &Token, inside: &[Token]) -> Result<Vec<Token>, Unreadable> {
    let place: Range<usize> = token.place.clone();
    let mark = |kind| Token { kind, place: place.clone(), bold: false };
    let arguments: Vec<Vec<Token>> =
        parts(inside, &[',']).into_iter().map(|part| marked(part.to_vec())).collect::<Result<_, _>>()?;
    let group = |tokens: &[Token], [open, close]: [char; 2]| {
        let mut found = vec![mark(Kind::Mark(open))];
        found.extend_from_slice(tokens);
        found.push(mark(Kind::Mark(close)));
        found
    };
    let round = |tokens: &[Token]| group(tokens, ['(', ')']);
    match (name, arguments.as_slice()) {
        ("sqrt", [only]) => {
            Ok([vec![mark(Kind::Command("sqrt".to_owned()))], group(only, ['{', '}'])].concat())
        }
        ("array" | "matrix" | "asarray" | "mat" | "vec3" | "vector", [only]) => Ok(round(only)),
        ("pow" | "power", [base, power]) => {
            Ok([round(base), vec![mark(Kind::Mark('^'))], group(power, ['{', '}'])].concat())
        }
        ("cross", [a, b]) => Ok(round(&[round(a), vec![mark(Kind::Mark('×'))], round(b)].concat())),
        ("dot" | "matmul", [a, b]) => Ok(round(&[round(a), vec![mark(Kind::Mark('*'))], round(b)].concat())),
        ("inv", [only]) => {
            let power =
                ['{', '-', '1', '}'].map(|c| mark(if c == '1' { Kind::Digit(c) } else { Kind::Mark(c) }));
            Ok([round(only), vec![mark(Kind::Mark('^'))], power.to_vec()].concat())
        }
        ("transpose", [only]) => Ok([round(only), vec![mark(Kind::Mark('\''))]].concat()),
        ("eye", [size, ..]) => {
            let letter = mark(Kind::Word("I".to_owned()));
            Ok([vec![letter, mark(Kind::Mark('_'))], group(size, ['{', '}'])].concat())
        }
        ("square", [only]) => Ok([round(only), vec![mark(Kind::Mark('^')), mark(Kind::Digit('2'))]].concat()),
        _ => Err(Mistake::new(place, format!("the function `{name}` is not known"))
            .with_help("sines, cosines, tangents, roots, powers, arrays, cross and dot products are")),
    }
}
