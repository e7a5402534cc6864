//! Reading formulas as papers print them: LaTeX text → [`Expr`], every node with its byte range in the text.
//!
//! The pipeline is lexer (`token`) → what print sets around formulas (`layout`) → symbols (`glyph`, [`PrintedSymbols`]) →
//! Pratt parser (`parser`). What is read is the notation of printed closed forms: products by juxtaposition,
//! `\sin^2\beta`, `\frac{1}{2}`, `\left( \right)`, indices in any order and with or without braces, vectors in brackets or
//! as a matrix, sums and products of those. What cannot be read is an [`Unreadable`] with its place; nothing is guessed,
//! and what could be read in two ways is refused. Whether a formula is right is the checker's concern.
//!
//! Conventions of print that have to be settled:
//!
//! * a function without parentheses takes the numbers and the one symbol behind it: `\sin 2\beta \cos\alpha` is
//!   `sin(2*beta)*cos(alpha)`;
//! * `/` and juxtaposition bind equally, from left to right: `1/2 \beta` is `(1/2)*beta`;
//! * an upper index is part of a symbol if the symbol is known with it, and a power if it is not;
//! * an error with its joint in parentheses, `\delta_x(x)`, is the error.

mod commands;
mod glyph;
mod layout;
mod parser;
mod printed;
mod token;
mod typed;
mod unknown;

#[cfg(test)]
mod decorated;
#[cfg(test)]
mod tests;

use std::ops::Range;

use layout::Row;
use model_core::expr::Expr;
use model_core::mistake::Mistake;
use parser::{Parser, Value};
use token::Kind;

pub use printed::PrintedSymbols;

/// Why and where a formula cannot be read: bytes of its text.
pub type Unreadable = Mistake<Range<usize>>;

/// A formula as written, with byte ranges.
type Formula = Expr<Range<usize>>;

/// The primes whose square roots formulas may hold; they are read as the symbols of [`root_name`].
pub const ROOTS: [i64; 4] = [2, 3, 5, 7];

/// The name of the square root of a prime in an expression: `√2`. No declaration can use it.
#[must_use]
pub fn root_name(prime: i64) -> String {
    format!("√{prime}")
}

/// Reads one formula, one component of a printed vector. What stands on the left of `=` is its name.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_formula(text: &str, symbols: &PrintedSymbols) -> Result<Formula, Unreadable> {
    component(text, symbols, None)
}

/// Reads the formula of one component (0, 1, 2 for x, y, z); a name on the left of `=` may not say another one.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_component(text: &str, symbols: &PrintedSymbols, axis: usize) -> Result<Formula, Unreadable> {
    component(text, symbols, Some(axis))
}

fn component(text: &str, symbols: &PrintedSymbols, axis: Option<usize>) -> Result<Formula, Unreadable> {
    let mut rows = layout::rows(text, token::tokens(text)?, false)?.into_iter();
    let Some(row) = rows.next() else {
        return Err(Mistake::new(0..text.len(), "a formula is missing"));
    };
    if let Some(second) = rows.next() {
        let place =
            second.name.first().or(second.formula.first()).map_or(second.end, |token| token.place.clone());
        return Err(Mistake::new(place, "a second formula, where one component stands"));
    }
    check_name(text, &row, axis)?;
    value(text, &row, symbols)?.scalar()
}

/// Reads a printed vector, `[a, b, c]^T`, `\begin{bmatrix} a \\ b \\ c \end{bmatrix}`, three rows, or sums and products of
/// vectors and matrices, into its components.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_vector(text: &str, symbols: &PrintedSymbols) -> Result<Vec<Formula>, Unreadable> {
    let rows = layout::rows(text, token::tokens(text)?, true)?;
    let mut components = Vec::with_capacity(rows.len());
    let alone = rows.len() == 1;
    for (axis, row) in rows.iter().enumerate() {
        check_name(text, row, (!alone).then_some(axis))?;
        match value(text, row, symbols)? {
            Value::Matrix(matrix) if alone && matrix.is_vector() => components.extend(matrix.entries),
            value => components.push(value.scalar()?),
        }
    }
    Ok(components)
}

/// Reads a printed matrix of three rows and three columns, row after row; nothing if the text is something else.
#[must_use]
pub fn read_square(text: &str, symbols: &PrintedSymbols) -> Option<[Formula; 9]> {
    let rows = layout::rows(text, token::tokens(text).ok()?, true).ok()?;
    let [row] = rows.as_slice() else { return None };
    match value(text, row, symbols).ok()? {
        Value::Matrix(matrix) if matrix.rows == 3 && matrix.columns == 3 => matrix.entries.try_into().ok(),
        _ => None,
    }
}

/// Reads `\sqrt{…}`, a total error, and returns what stands below the root.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_total(text: &str, symbols: &PrintedSymbols) -> Result<Formula, Unreadable> {
    let rows = layout::rows(text, token::tokens(text)?, false)?;
    let [row] = rows.as_slice() else {
        return Err(Mistake::new(0..text.len(), "one formula is wanted"));
    };
    let mut parser = Parser::new(text, &row.formula, row.end.clone(), symbols);
    let radicand = parser.radicand()?;
    parser.expect_end()?;
    Ok(radicand)
}

fn value(text: &str, row: &Row, symbols: &PrintedSymbols) -> Result<Value, Unreadable> {
    let mut parser = Parser::new(text, &row.formula, row.end.clone(), symbols);
    let value = parser.formula()?;
    parser.expect_end()?;
    Ok(value)
}

/// A name is symbols and functions of them; one that ends in x, y or z says which component it is.
fn check_name(text: &str, row: &Row, axis: Option<usize>) -> Result<(), Unreadable> {
    let Some(first) = row.name.first() else { return Ok(()) };
    let mut depth = 0;
    for token in &row.name {
        match token.kind {
            Kind::Mark('{' | '(') => depth += 1,
            Kind::Mark('}' | ')') => depth -= 1,
            Kind::Mark('+' | '-' | '/') if depth == 0 => {
                return Err(Mistake::new(
                    token.place.clone(),
                    "what stands on the left of `=` is more than a name",
                )
                .with_help("give the right-hand side alone"));
            }
            _ => {}
        }
    }
    if matches!(first.kind, Kind::Digit(_)) {
        return Err(Mistake::new(first.place.clone(), "a number stands on the left of `=`")
            .with_help("give the right-hand side alone"));
    }
    let said = named_axis(row);
    match (axis, said) {
        (Some(axis), Some(said)) if axis != said => {
            let letters = ["x", "y", "z"];
            let place = first.place.start..row.name.last().unwrap_or(first).place.end;
            let shown = &text[place.clone()];
            Err(Mistake::new(
                place,
                format!(
                    "`{shown}` is named as component {}, and stands where {} belongs",
                    letters[said],
                    letters.get(axis).unwrap_or(&"none")
                ),
            )
            .with_help("write the components in the order x, y, z"))
        }
        _ => Ok(()),
    }
}

/// The component that a name ends in: `\Delta x`, `e_y`.
fn named_axis(row: &Row) -> Option<usize> {
    let mut last = None;
    let mut at = 0;
    while let Some(rest) = row.name.get(at..).filter(|rest| !rest.is_empty()) {
        match glyph::read(rest) {
            Ok(Some(read)) => {
                at += read.tokens;
                last = Some(read.glyph);
            }
            // An argument in parentheses ends the name.
            _ => break,
        }
    }
    let axis = |letter: &str| ["x", "y", "z"].iter().position(|axis| letter.eq_ignore_ascii_case(axis));
    let last = last?;
    axis(&last.base).filter(|_| last.lower.is_empty()).or_else(|| axis(&last.lower))
}
