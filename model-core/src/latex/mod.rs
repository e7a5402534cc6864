//! Reading formulas as papers print them: LaTeX text → [`Expr`], every node with its byte range in the text.
//!
//! The pipeline is lexer (`token`) → symbols (`glyph`, [`PrintedSymbols`]) → Pratt parser (`parser`). What is read
//! is the notation of printed closed forms: products by juxtaposition, `\sin^2\beta`, `\frac{1}{2}`, `\left( \right)`,
//! indices in any order and with or without braces, vectors in brackets or as a matrix of one column. What cannot be
//! read is an [`Unreadable`] with its place; nothing is guessed. Whether a formula is right is the checker's concern.
//!
//! Three conventions of print that have to be settled:
//!
//! * a function without parentheses takes the numbers and the one symbol behind it: `\sin 2\beta \cos\alpha` is
//!   `sin(2*beta)*cos(alpha)`;
//! * `/` and juxtaposition bind equally, from left to right: `1/2 \beta` is `(1/2)*beta`;
//! * an upper index is part of a symbol if the symbol is known with it, and a power if it is not.

mod glyph;
mod parser;
mod printed;
mod token;
mod vector;

#[cfg(test)]
mod tests;

use std::ops::Range;

use crate::expr::Expr;
use crate::mistake::Mistake;

pub use printed::PrintedSymbols;

/// Why and where a formula cannot be read: bytes of its text.
pub type Unreadable = Mistake<Range<usize>>;

/// Reads one formula, one component of a printed vector.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_formula(text: &str, symbols: &PrintedSymbols) -> Result<Expr<Range<usize>>, Unreadable> {
    let tokens = token::tokens(text)?;
    let mut parser = parser::Parser::new(text, &tokens, symbols);
    let formula = parser.formula()?;
    parser.expect_end()?;
    Ok(formula)
}

/// Reads a printed vector, `[a, b, c]^T` or `\begin{bmatrix} a \\ b \\ c \end{bmatrix}`, into its components.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_vector(text: &str, symbols: &PrintedSymbols) -> Result<Vec<Expr<Range<usize>>>, Unreadable> {
    let tokens = token::tokens(text)?;
    vector::read(&mut parser::Parser::new(text, &tokens, symbols))
}
