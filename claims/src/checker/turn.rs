//! How a body is turned, as papers print it: the matrix of a small rotation, each of its nine entries against the rotation
//! vector ω that the chain implies.
//!
//! To first order the matrix is 1 + ω×, or ω× where only what is added to the identity is printed:
//! below and above its diagonal stand the components of ω, each once with each sign.

use std::ops::Range;

use super::formula::valued;
use super::written::in_text;
use super::{Equality, Order, PrintedVector, TextPlace, series};
use crate::latex::{self, Notes, PrintedSymbols};
use model_core::algebra::{Fraction, Poly, Rational};
use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolKind;

/// A printed matrix of a small rotation.
#[derive(Debug, Clone)]
pub struct PrintedTurn {
    /// Entries 32, 13 and 21: x, y and z of ω.
    pub plain: PrintedVector,
    /// Entries 23, 31 and 12 with the other sign: x, y and z again.
    pub negated: PrintedVector,
    /// The three entries of the diagonal, each said to be 1, or all 0.
    pub diagonal: [Equality; 3],
}

/// Entries that slips may spoil where a matrix is still one of a small rotation.
const MOST_MISFITS: usize = 2;

impl PrintedTurn {
    /// Reads a matrix of three rows and three columns; nothing if the text is something else.
    ///
    /// # Errors
    /// Entries that say nothing, each with its place.
    pub fn read(
        chain: &Chain,
        symbols: &PrintedSymbols,
        text: &str,
    ) -> Option<Result<Self, Vec<Mistake<TextPlace>>>> {
        let matrix = latex::read_matrix(text, symbols).ok()?;
        let notes = matrix.notes;
        let entries = <[_; 9]>::try_from(matrix.entries).ok().filter(|_| matrix.rows == 3)?;
        Some(Self::of_entries(chain, entries, notes))
    }

    fn of_entries(
        chain: &Chain,
        entries: [Expr<Range<usize>>; 9],
        notes: Notes,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let bare = without_errors(chain, &entries, notes)?;
        let number = |entry: &Fraction| {
            [Poly::zero(), Poly::one()].iter().position(|value| *entry == Fraction::whole(value.clone()))
        };
        let found: Vec<Option<usize>> = bare.iter().map(number).collect();
        let misfits = |diagonal: usize| {
            let fits =
                |(at, found): (usize, &Option<usize>)| *found == Some(if at % 4 == 0 { diagonal } else { 0 });
            9 - found.iter().enumerate().filter(|entry| fits(*entry)).count()
        };
        // What is added to the identity has zeros where the rotation has ones.
        let is_added = misfits(0) < misfits(1);
        if misfits(0).min(misfits(1)) > MOST_MISFITS {
            let place = entries[0].place.start..entries[8].place.end;
            let message = "without errors this matrix is far from the identity and from zero, so it is of no small rotation";
            return Err(vec![in_text(
                0,
                Mistake::new(place, message).with_help("claim how the body stands: `frame = '…'`"),
            )]);
        }
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = entries;
        let negated = |entry: Expr<Range<usize>>| {
            let place = entry.place.clone();
            Expr { node: Node::Neg(Box::new(entry)), place }
        };
        let said = |entry: Expr<Range<usize>>| {
            let number = if is_added { Rational::ZERO } else { Rational::ONE };
            let place = entry.place.clone();
            Equality::of_expressions(chain, [entry, Expr { node: Node::Number(number), place }], notes)
        };
        Ok(Self {
            plain: PrintedVector::of_expressions(chain, [zy, xz, yx], notes)?,
            negated: PrintedVector::of_expressions(chain, [yz, zx, xy].map(negated), notes)?,
            diagonal: [said(xx)?, said(yy)?, said(zz)?],
        })
    }
}

/// The entries where the errors are zero.
fn without_errors(
    chain: &Chain,
    entries: &[Expr<Range<usize>>; 9],
    notes: Notes,
) -> Result<Vec<Fraction>, Vec<Mistake<TextPlace>>> {
    let mut values = Vec::with_capacity(9);
    let mut mistakes = Vec::new();
    let errors: Vec<_> = chain.symbols_of(SymbolKind::Error).collect();
    for entry in entries {
        let value = valued(chain, entry, notes, Order::UpTo(1)).and_then(|value| {
            let value = series::at_zero(&value, &errors);
            value.map_err(|error| Mistake::new(entry.place.clone(), error.to_string()))
        });
        match value {
            Ok(value) => values.push(value),
            Err(mistake) => mistakes.push(in_text(0, mistake)),
        }
    }
    if mistakes.is_empty() { Ok(values) } else { Err(mistakes) }
}
