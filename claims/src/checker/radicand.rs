//! What a print puts below a root: the square of a total error.

use std::ops::Range;

use super::PrintedVector;
use super::lowering::{self, Sines};
use crate::latex::{self, PrintedSymbols};
use model_core::chain::{Chain, ObservableId};
use model_core::expr::Expr;
use model_core::mistake::Mistake;
use model_core::symbol::SymbolId;

/// That the length of the first-order error is the root of this.
#[derive(Debug, Clone)]
pub struct Total {
    /// Of which observable.
    pub observable: ObservableId,
    /// The errors that are not zero, in order.
    pub kept: Vec<SymbolId>,
    /// What stands below the root.
    pub radicand: Radicand,
}

/// What stands below a printed root.
#[derive(Debug, Clone)]
pub struct Radicand {
    /// As written; places are byte ranges of the text.
    pub expression: Expr<Range<usize>>,
    pub(super) value: PrintedVector,
}

impl Radicand {
    /// Reads `\sqrt{…}` over the symbols of an [extended](super::extended) chain.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(chain: &Chain, symbols: &PrintedSymbols, text: &str) -> Result<Self, Mistake<Range<usize>>> {
        let expression = latex::read_total(text, symbols)?;
        let value = lowering::fraction(chain, &expression, Sines::Angles)?;
        let value = PrintedVector::of_one(chain, &expression, value)
            .map_err(|error| Mistake::new(expression.place.clone(), error.to_string()))?;
        Ok(Self { expression, value })
    }
}
