//! The total error: the length of the first-order error, of which a print gives the square below a root. Its square is a
//! canonical form like any other, so that the claim is decided.

use super::algebraic;
use super::compare::{self, Monomial};
use super::order::Order;
use super::radicand::Total;
use super::{CheckError, Checker, ClosedForm};
use model_core::algebra::{Fraction, Poly};
use model_core::budget;

/// What is said of a total error. It holds if there is no difference.
#[derive(Debug, Clone, PartialEq)]
pub struct TotalVerdict {
    /// The products of two errors whose factors below the root differ: printed and derived.
    pub differences: Vec<(Monomial, Fraction, Fraction)>,
    /// What belongs below the root.
    pub derived: Fraction,
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
        budget::one_unit(chain, claim.observable)?;
        let implied = self.columns(claim.observable, Order::UpTo(1))?;
        let kept = compare::kept(chain, &implied.columns, &form)?;
        let mut square = Fraction::whole(Poly::zero());
        for (component, below) in kept.iter().zip(&implied.below) {
            let component = Fraction::new(compare::total(component), below.clone())
                .unwrap_or_else(|| unreachable!("no form stands over zero"));
            square = square.sum(&component.product(&component)?)?;
        }
        // Both sides are multiplied by what stands below the derived one.
        let below = form.printed.translate(chain, &square.below)?;
        let square = square.above;
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
                if print * &below == truth * &value.below {
                    return None;
                }
                let print = Fraction::new(shown(print), shown(&value.below))?;
                Some((error.clone(), print, Fraction::new(shown(truth), shown(&below))?))
            })
            .collect();
        let derived = Fraction::new(shown(&square), shown(&below))
            .unwrap_or_else(|| unreachable!("no form stands over zero"));
        Ok(TotalVerdict { differences, derived })
    }
}
