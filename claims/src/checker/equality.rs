//! That two printed formulas say the same at all values of their symbols: two ways of printing one thing.

use std::ops::Range;

use super::algebraic;
use super::lowering::{self, Sines};
use super::written::in_text;
use super::{CheckError, Checker, PrintedComponent, PrintedVector, TextPlace};
use crate::latex::{self, Notes, PrintedSymbols};
use model_core::algebra::{Fraction, Rational};
use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;

/// That two formulas are equal wherever both are defined.
#[derive(Debug, Clone)]
pub struct Equality {
    /// The two as x and y, so that both are said in the same terms; z is zero.
    printed: PrintedVector,
}

/// What is said of an equality.
#[derive(Debug, Clone, PartialEq)]
pub struct EqualityVerdict {
    /// The first formula less the second. The claim holds if it is zero.
    pub difference: Fraction,
    /// Whether both are roots, and the difference is that of their squares.
    pub of_squares: bool,
}

impl Equality {
    /// Reads two formulas, each in LaTeX or in the plain syntax of amounts. Errors may stand in sines and cosines.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: [&str; 2],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        PrintedVector::read_pair(chain, symbols, texts).map(|printed| Self { printed })
    }

    /// Reads two matrices, entry by entry, each with its row and column; `None` where the two are no matrices of one shape.
    ///
    /// # Errors
    /// What says nothing, with its place.
    #[must_use]
    #[allow(clippy::type_complexity, reason = "labelled entries or the mistakes of all")]
    pub fn read_entries(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: [&str; 2],
    ) -> Option<Result<Vec<(String, Self)>, Vec<Mistake<TextPlace>>>> {
        let symbols = symbols.reading(&texts);
        let [first, second] = texts.map(|text| latex::read_matrix(text, &symbols));
        let (first, second) = (first.ok()?, second.ok()?);
        let mut notes = first.notes;
        notes.join(&second.notes);
        if [first.rows, first.columns] != [second.rows, second.columns] || first.entries.len() < 2 {
            return None;
        }
        if notes.truncates || notes.dropped.is_some() {
            let place = first.entries[0].place.clone();
            let mistake =
                Mistake::new(place, "a product of matrices with errors is equal to some order only")
                    .with_help("claim how the body stands: `frame = '…'` with its `order`");
            return Some(Err(vec![in_text(0, mistake)]));
        }
        let columns = first.columns;
        let pairs = first.entries.into_iter().zip(second.entries).enumerate();
        let read = pairs.map(|(at, (first, second))| {
            let valued = |text_index: usize, expression: Expr<Range<usize>>| match lowering::fraction(
                chain,
                &expression,
                Sines::Series,
            ) {
                Ok(value) => Ok(PrintedComponent { text_index, expression, value }),
                Err(mistake) => Err(vec![in_text(text_index, mistake)]),
            };
            let pair = [valued(0, first)?, valued(1, second)?];
            let printed = PrintedVector::of_pair(chain, pair, false, notes)?;
            Ok((format!("entry {}, {}", at / columns + 1, at % columns + 1), Self { printed }))
        });
        Some(read.collect())
    }

    /// Two formulas that were read from one text.
    pub(super) fn of_expressions(
        chain: &Chain,
        [first, second]: [Expr<Range<usize>>; 2],
        notes: Notes,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let nothing = Expr { node: Node::Number(Rational::ZERO), place: first.place.clone() };
        PrintedVector::of_expressions(chain, [first, second, nothing], notes).map(|printed| Self { printed })
    }

    /// The two formulas.
    #[must_use]
    pub fn formulas(&self) -> [&PrintedComponent; 2] {
        let [first, second, _] = &self.printed.components;
        [first, second]
    }

    /// Whether rotations about named axes were read as the table of symbols says.
    pub(crate) fn is_turned(&self) -> bool {
        self.printed.turned
    }

    /// Whether both are in the names of the chain alone and without quotients.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.printed.is_plain()
    }
}

impl EqualityVerdict {
    /// What the difference is one of, in words before it.
    #[must_use]
    pub fn words(&self) -> &'static str {
        if self.of_squares {
            "the square of the first less the square of the second is "
        } else {
            "the first less the second is "
        }
    }
}

impl Checker<'_> {
    /// The verdict on an equality.
    ///
    /// # Errors
    /// The difference has too many terms.
    pub(super) fn equality(&self, claim: &Equality) -> Result<EqualityVerdict, CheckError> {
        let [first, second] = claim.formulas();
        let difference = algebraic::reduced_fraction(first.value.sum(&second.value.negated())?, self.chain);
        let shown = |poly| algebraic::in_wholes(poly, self.chain);
        let difference = Fraction::new(shown(&difference.above), shown(&difference.below))
            .unwrap_or_else(|| unreachable!("no printed formula stands over zero"));
        Ok(EqualityVerdict { difference, of_squares: claim.printed.of_squares })
    }
}
