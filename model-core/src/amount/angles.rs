//! Angles that are written as numbers: `Rx(0.7)`, `cos(beta - 30 deg)`.
//!
//! The algebra takes sines of whole multiples of symbols, and of quarter turns. Any other number that is turned by is a constant
//! of its own, whose name follows from its value; two of them have no relation that the algebra would know of, except that one
//! may be the other's negative.

use crate::algebra::{Poly, Rational};
use crate::symbol::SymbolId;

/// An angle that is a number, which is not zero and not so many quarter turns.
pub(crate) struct AngleNumber {
    /// The name of its constant.
    pub(crate) name: String,
    /// In radians.
    pub(crate) value_rad: f64,
    /// Whether the amount has it with a minus.
    is_negative: bool,
    /// The amount without it.
    rest: Poly,
}

impl AngleNumber {
    /// The number in an amount, if it has one.
    pub(crate) fn in_amount(amount: &Poly) -> Option<Self> {
        let (mut plain, mut of_pi) = (Rational::ZERO, Rational::ZERO);
        for term in amount.terms().filter(|term| term.waves.is_empty() && term.poles.is_empty()) {
            match term.powers.as_slice() {
                [] => plain = term.coefficient,
                [(SymbolId::PI, 1)] if (&term.coefficient * &Rational::from(2)).to_integer().is_none() => {
                    of_pi = term.coefficient;
                }
                _ => {}
            }
        }
        let leading = if of_pi.is_zero() { &plain } else { &of_pi };
        if leading.is_zero() {
            return None;
        }
        let is_negative = leading.is_negative();
        let number = &Poly::constant(plain.clone()) + &Poly::symbol(SymbolId::PI).scale(&of_pi);
        let [plain, of_pi] = [plain, of_pi].map(|part| if is_negative { -&part } else { part });
        let mut parts = Vec::new();
        if !of_pi.is_zero() {
            parts.push(word(&(&of_pi * &Rational::from(180)), "deg"));
        }
        if !plain.is_zero() {
            parts.push(word(&plain, "rad"));
        }
        Some(Self {
            name: format!("angle_{}", parts.join("_and_")),
            value_rad: of_pi.to_f64() * std::f64::consts::PI + plain.to_f64(),
            is_negative,
            rest: amount - &number,
        })
    }

    /// The amount with a symbol in place of the number.
    pub(crate) fn replaced(&self, symbol: SymbolId) -> Poly {
        let symbol = Poly::symbol(symbol);
        if self.is_negative { &self.rest - &symbol } else { &self.rest + &symbol }
    }
}

/// `22_5_deg`, or `60_over_7_deg` where that is no short decimal.
fn word(number: &Rational, unit: &str) -> String {
    let minus = if number.is_negative() { "minus_" } else { "" };
    let size = number.abs();
    let digits = match size.to_decimal() {
        Some(decimal) => decimal.replace('.', "_"),
        None => format!("{}_over_{}", size.numerator(), size.denominator()),
    };
    format!("{minus}{digits}_{unit}")
}
