//! What an error measures, which no statement says: it follows from where the error stands.
//!
//! The amount of a rotation is an angle, that of a shift a length. What an error measures is what its factor
//! in a term leaves open, where sines, cosines, numbers and π have no unit:
//!
//! - `Rx(a)`, `Rx(a*cos(beta))`: an angle; `Tx(a)`, `Tx(a*cos(beta))`: a length.
//! - `Tx(lead*alpha)`, a shift in proportion to an angle: a length (for each radian).
//! - `Rx(drift*temperature)`: an angle, for each unit of a plain number such as the temperature.
//! - `Rx(scale*alpha)`, `Tx(scale*range)`: a number, in what unit the factor leaves.
//! - Terms with a product or power of errors say nothing.
//!
//! Where uses differ, an angle or a length wins over a number.

use super::amounts::{Amount, Purpose};
use super::scope::Scope;
use super::words::quantity_moved;
use crate::algebra::Poly;
use crate::symbol::{Quantity, SymbolId};

/// What one factor says of an error.
pub fn inferred(scope: &Scope, amount: &Amount<'_>) -> Vec<(SymbolId, Quantity)> {
    let Some(value) = &amount.value else { return Vec::new() };
    let moved = match &amount.purpose {
        Purpose::Factor { kind, .. } => quantity_moved(*kind),
        Purpose::Bend(_) => Quantity::Angle,
        Purpose::Component(_) | Purpose::Intrinsic(_) | Purpose::Gravity => return Vec::new(),
    };
    let by_error = value.graded_part(|id| scope.is_error(id), 1).collect_by(|id| scope.is_error(id));
    let mut found = Vec::new();
    for (monomial, cofactor) in by_error {
        if let [(error, 1)] = monomial[..] {
            found.push((error, measured(scope, moved, &cofactor)));
        }
    }
    found
}

/// The quantity of an error whose product with `cofactor` measures `moved`.
fn measured(scope: &Scope, moved: Quantity, cofactor: &Poly) -> Quantity {
    let is_plain = |powers: &[(SymbolId, u32)]| {
        powers.iter().all(|&(id, _)| {
            let quantity = scope.entry(id).quantity;
            quantity == Some(Quantity::Number)
                || moved == Quantity::Length && quantity == Some(Quantity::Angle)
        })
    };
    if cofactor.terms().any(|term| is_plain(&term.powers)) { moved } else { Quantity::Number }
}
