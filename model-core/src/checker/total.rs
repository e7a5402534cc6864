//! The total error: the length of the first-order error, of which a print gives the square below a root. Its square is a
//! canonical form like any other, so that the claim is decided.

use std::ops::Range;

use super::algebraic;
use super::claim::Order;
use super::compare::{self, Monomial};
use super::fraction::Fraction;
use super::lowering::{self, Sines};
use super::{CheckError, Checker, ClosedForm, PrintedVector};
use crate::algebra::Poly;
use crate::chain::{Chain, ObservableId};
use crate::expr::Expr;
use crate::latex::{self, PrintedSymbols};
use crate::mistake::Mistake;
use crate::symbol::SymbolId;

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
    value: PrintedVector,
}

impl Radicand {
    /// Reads `\sqrt{…}` over the symbols of an [extended](super::extended) chain.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(chain: &Chain, symbols: &PrintedSymbols, text: &str) -> Result<Self, Mistake<Range<usize>>> {
        let expression = latex::read_total(text, symbols)?;
        let value = lowering::fraction(chain, &expression, Sines::OfAngles)?;
        let value = PrintedVector::of_one(chain, &expression, value)
            .map_err(|error| Mistake::new(expression.place.clone(), error.to_string()))?;
        Ok(Self { expression, value })
    }
}

/// What is said of a total error. It holds if there is no difference.
#[derive(Debug, Clone, PartialEq)]
pub struct TotalVerdict {
    /// The products of two errors whose factors below the root differ: printed and derived.
    pub differences: Vec<(Monomial, Fraction, Fraction)>,
    /// What belongs below the root.
    pub derived: Poly,
}

impl Checker<'_> {
    /// The verdict on a total error.
    ///
    /// # Errors
    /// The chain has no closed form, or it cannot be said in the terms of the print.
    pub fn total(&mut self, claim: &Total) -> Result<TotalVerdict, CheckError> {
        let chain = self.chain;
        let form = ClosedForm {
            observable: claim.observable,
            order: Order::UpTo(1),
            only: None,
            faces: None,
            kept: claim.kept.clone(),
            printed: claim.radicand.value.clone(),
        };
        let kept = compare::kept(chain, self.columns(claim.observable, Order::UpTo(1))?, &form)?;
        let mut square = Poly::zero();
        for component in &kept {
            let component = compare::total(component);
            square = &square + &component.checked_mul(&component)?;
        }
        let square = form.printed.translate(chain, &square)?;
        let value = &form.printed.components[0].value;
        let zero = Poly::zero();
        let (printed, derived) = (compare::parts(chain, &value.above), compare::parts(chain, &square));
        let errors: std::collections::BTreeSet<&Monomial> = printed.keys().chain(derived.keys()).collect();
        let shown = |poly: &Poly| algebraic::in_wholes(poly, chain);
        let differences = errors
            .into_iter()
            .filter_map(|error| {
                let (print, truth) =
                    (printed.get(error).unwrap_or(&zero), derived.get(error).unwrap_or(&zero));
                if *print == truth * &value.below {
                    return None;
                }
                let print = Fraction::new(shown(print), shown(&value.below))?;
                Some((error.clone(), print, Fraction::whole(shown(truth))))
            })
            .collect();
        Ok(TotalVerdict { differences, derived: shown(&square) })
    }
}
