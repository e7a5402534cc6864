//! Numbers of a claim exactly as they are written: decimals with their units, amounts of numbers and π.

use model_core::algebra::{Poly, Rational};
use model_core::symbol::SymbolId;
use model_core::unit::{Measures, Unit};
use model_core::{Chain, Quantity, syntax};

use crate::checker::lower;

/// How far the exact number and the one in floating point may be apart, relatively: a few roundings.
const ROUNDED: f64 = 1e-12;

/// The number that a text says, which was read as `value`. `None` if it cannot be said exactly, or is another one.
pub(super) fn exactly(chain: &Chain, text: &str, quantity: Quantity, value: f64) -> Option<Poly> {
    let exact = decimal(text.trim(), quantity).or_else(|| amount(chain, text))?;
    let near = |found: f64| (found - value).abs() <= ROUNDED * value.abs();
    near(exact.eval(&[std::f64::consts::PI])).then_some(exact)
}

/// A decimal, with its unit if there is one.
fn decimal(text: &str, quantity: Quantity) -> Option<Poly> {
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    let unsigned = text.trim_start_matches(['+', '-']);
    let mantissa = unsigned.find(|c| !is_digit(c)).unwrap_or(unsigned.len());
    let mut end = text.len() - unsigned.len() + mantissa;
    if let Some(power) = text[end..].strip_prefix(['e', 'E']) {
        let digits = power.trim_start_matches(['+', '-']);
        let length = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        if length > 0 {
            end = text.len() - digits.len() + length;
        }
    }
    let number = Rational::parse_decimal(&text[..end]).ok()?;
    match text[end..].trim() {
        "" => Some(Poly::constant(number)),
        unit => {
            let unit = Unit::read(unit, None).ok()?;
            unit.factor(Measures::from(quantity)).ok()?;
            Some(unit.amount(&number))
        }
    }
}

/// An amount of numbers and π.
fn amount(chain: &Chain, text: &str) -> Option<Poly> {
    let amount = lower(chain, &syntax::parse_amount(text).ok()?).ok()?;
    amount.symbols().iter().all(|symbol| *symbol == SymbolId::PI).then_some(amount)
}
