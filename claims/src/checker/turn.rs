//! How a body is turned, as papers print it: the matrix of a small rotation, each of its nine entries against the rotation
//! vector ω that the chain implies.
//!
//! To first order the matrix is 1 + ω×, or ω× where only what is added to the identity is printed:
//! below and above its diagonal stand the components of ω, each once with each sign.

use std::ops::Range;

use super::{Equality, PrintedVector, TextPlace};
use crate::latex::{self, PrintedSymbols};
use model_core::algebra::Rational;
use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

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
        latex::read_square(text, symbols).map(|entries| Self::of_entries(chain, entries))
    }

    fn of_entries(chain: &Chain, entries: [Expr<Range<usize>>; 9]) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = entries;
        let negated = |entry: Expr<Range<usize>>| {
            let place = entry.place.clone();
            Expr { node: Node::Neg(Box::new(entry)), place }
        };
        // What is added to the identity has zeros where the rotation has ones.
        let is_added = [&xx, &yy, &zz]
            .iter()
            .all(|entry| !matches!(&entry.node, Node::Number(number) if *number == Rational::ONE));
        let said = |entry: Expr<Range<usize>>| {
            let number = if is_added { Rational::ZERO } else { Rational::ONE };
            let place = entry.place.clone();
            Equality::of_expressions(chain, [entry, Expr { node: Node::Number(number), place }])
        };
        Ok(Self {
            plain: PrintedVector::of_expressions(chain, [zy, xz, yx])?,
            negated: PrintedVector::of_expressions(chain, [yz, zx, xy].map(negated))?,
            diagonal: [said(xx)?, said(yy)?, said(zz)?],
        })
    }
}
