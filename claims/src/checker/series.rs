//! A printed formula to an order in the errors: what is left of a product of matrices that nobody multiplied out.

use model_core::algebra::{AlgebraError, Fraction, Poly, Rational};
use model_core::chain::Chain;
use model_core::symbol::{SymbolId, SymbolKind};

/// The terms of up to `order` errors.
///
/// # Errors
/// [`AlgebraError::NotDivisible`] if the formula has no value where the errors are zero.
pub(super) fn truncated(chain: &Chain, value: &Fraction, order: u32) -> Result<Fraction, AlgebraError> {
    let is_error = |id: SymbolId| chain.symbol(id).kind == SymbolKind::Error;
    let errors: Vec<SymbolId> = value.symbols().into_iter().filter(|&id| is_error(id)).collect();
    if errors.is_empty() {
        return Ok(value.clone());
    }
    let in_angles = value.above.terms().any(|term| {
        let waves = term.waves.iter().map(|wave| wave.symbol);
        waves.chain(term.poles.iter().map(|pole| pole.symbol)).any(is_error)
    });
    if !in_angles && !value.below.symbols().into_iter().any(is_error) {
        let parts = (0..=order).map(|degree| value.above.graded_part(is_error, degree));
        let above = parts.fold(Poly::zero(), |sum, part| &sum + &part);
        return Fraction::new(above, value.below.clone()).ok_or(AlgebraError::NotDivisible);
    }
    // Taylor's series, term by term; derivatives are taken in the order of the errors.
    let mut sum = at_zero(value, &errors)?;
    let mut derivatives = vec![(value.clone(), Poly::one(), 0, 0)];
    for _ in 0..order {
        let mut next = Vec::new();
        for (derived, monomial, last, repeated) in &derivatives {
            for (at, &error) in errors.iter().enumerate().skip(*last) {
                let repeated = if at == *last { repeated + 1 } else { 1 };
                let derived = derivative(derived, error)?;
                if derived.is_zero() {
                    continue;
                }
                let share = Rational::new(1, i64::from(repeated)).ok_or(AlgebraError::NotDivisible)?;
                let monomial = monomial.checked_mul(&Poly::symbol(error))?.scale(&share);
                let term = at_zero(&derived, &errors)?.product(&Fraction::whole(monomial.clone()))?;
                sum = sum.sum(&term)?;
                next.push((derived, monomial, at, repeated));
            }
        }
        derivatives = next;
    }
    Ok(sum)
}

/// The derivative of a quotient.
pub(super) fn derivative(value: &Fraction, symbol: SymbolId) -> Result<Fraction, AlgebraError> {
    let above = value.above.derivative(symbol);
    if value.is_whole() {
        return Ok(Fraction::whole(above));
    }
    let below = value.below.derivative(symbol);
    let above = &above.checked_mul(&value.below)? - &value.above.checked_mul(&below)?;
    Fraction::new(above, value.below.checked_mul(&value.below)?).ok_or(AlgebraError::NotDivisible)
}

/// The value where errors are zero.
pub(super) fn at_zero(value: &Fraction, errors: &[SymbolId]) -> Result<Fraction, AlgebraError> {
    let zero = Poly::zero();
    let put_in =
        |poly: &Poly| errors.iter().try_fold(poly.clone(), |poly, &error| poly.substitute(error, &zero));
    Fraction::new(put_in(&value.above)?, put_in(&value.below)?).ok_or(AlgebraError::NotDivisible)
}
