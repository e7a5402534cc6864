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

mod collect;
mod commands;
mod glyph;
mod layout;
mod left;
mod lookup;
mod mathml;
mod naming;
mod parser;
mod printed;
pub mod program;
mod signs;
mod spaced;
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
use parser::{Matrix, Parser, Value};

pub use collect::{
    Derivative, definition_of, derivative_of, derivatives_of, equal_sides, equalities_of, equations_beside,
    is_derivative, lines_of, named_component, rows_of, shown_axis, symbols_in, variables_in,
};
pub use mathml::mathml;
pub use naming::NameOf;
pub use parser::Notes;
pub use printed::{PrintedSymbols, Turned};
pub(crate) use token::closing;

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
    read_component(text, symbols, NameOf::Formula).map(|(formula, _)| formula)
}

/// Reads the formula of one number; a name on the left of `=` may not say that it is another one.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_component(
    text: &str,
    symbols: &PrintedSymbols,
    name_of: NameOf,
) -> Result<(Formula, Notes), Unreadable> {
    let mut rows = layout::rows(text, left::tokens(text)?, false)?.into_iter();
    let Some(row) = rows.next() else {
        return Err(Mistake::new(0..text.len(), "a formula is missing"));
    };
    if let Some(second) = rows.next() {
        let place =
            second.name.first().or(second.formula.first()).map_or(second.end, |token| token.place.clone());
        return Err(Mistake::new(place, "a second formula, where one component stands"));
    }
    let (value, notes) = value(text, &row, symbols)?;
    Ok((naming::named(text, &row, symbols, name_of, value)?.scalar()?, notes))
}

/// Reads a printed vector, `[a, b, c]^T`, `\begin{bmatrix} a \\ b \\ c \end{bmatrix}`, three rows, or sums and products of
/// vectors and matrices, into its components. `names` says what each row's name on the left of `=` is the name of.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_vector(
    text: &str,
    symbols: &PrintedSymbols,
    names: &[NameOf],
) -> Result<(Vec<Formula>, Notes), Unreadable> {
    let rows = layout::rows(text, left::tokens(text)?, true)?;
    let mut components = Vec::with_capacity(rows.len());
    let mut notes = Notes::default();
    let alone = rows.len() == 1;
    for (at, row) in rows.iter().enumerate() {
        let (value, own) = value(text, row, symbols)?;
        notes.join(&own);
        let name_of = NameOf::in_row(names, at, alone);
        match naming::named(text, row, symbols, name_of, value)? {
            Value::Matrix(matrix) if alone && matrix.is_vector() => components.extend(matrix.entries),
            value => components.push(value.scalar()?),
        }
    }
    Ok((components, notes))
}

/// A printed matrix.
#[derive(Debug, Clone)]
pub struct PrintedMatrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row after row; places are byte ranges of the text.
    pub entries: Vec<Expr<Range<usize>>>,
    /// What reading it took for granted.
    pub notes: Notes,
}

/// Reads a printed matrix, a product of matrices included; what is no matrix is one of one entry.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_matrix(text: &str, symbols: &PrintedSymbols) -> Result<PrintedMatrix, Unreadable> {
    let rows = layout::rows(text, left::tokens(text)?, false)?;
    let [row] = rows.as_slice() else {
        return Err(Mistake::new(0..text.len(), "one matrix is wanted"));
    };
    let (value, notes) = value(text, row, symbols)?;
    if naming::is_derivative(&row.name) {
        return PrintedMatrix::of(value, notes);
    }
    PrintedMatrix::of(naming::named(text, row, symbols, NameOf::Formula, value)?, notes)
}

impl PrintedMatrix {
    fn of(value: Value, notes: Notes) -> Result<Self, Unreadable> {
        Ok(match value {
            Value::Matrix(Matrix { rows, columns, entries, .. }) => Self { rows, columns, entries, notes },
            value => Self { rows: 1, columns: 1, entries: vec![value.scalar()?], notes },
        })
    }
}

/// Reads `\sqrt{…}`, a total error, and returns what stands below the root.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_total(text: &str, symbols: &PrintedSymbols) -> Result<Formula, Unreadable> {
    let rows = layout::rows(text, left::tokens(text)?, false)?;
    let [row] = rows.as_slice() else {
        return Err(Mistake::new(0..text.len(), "one formula is wanted"));
    };
    naming::is_name_alone(text, row, symbols)?;
    let mut parser = Parser::new(text, &row.formula, row.end.clone(), symbols);
    let radicand = parser.radicand()?;
    parser.expect_end()?;
    Ok(radicand)
}

/// The mistake that amounts stand around a name in a way that cannot be solved for it.
fn more_than_a_name(place: Range<usize>) -> Unreadable {
    Mistake::new(place, "what stands on the left of `=` is more than a name")
        .with_help("give the right-hand side alone")
}

fn value(text: &str, row: &Row, symbols: &PrintedSymbols) -> Result<(Value, Notes), Unreadable> {
    let mut parser = Parser::new(text, &row.formula, row.end.clone(), symbols);
    let value = parser.formula()?;
    parser.expect_end()?;
    Ok((value, parser.notes))
}
