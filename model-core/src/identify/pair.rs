//! A number in two kinds of arithmetic at once: exact modulo a large prime, which decides what is zero, and in floats, which
//! say how large the rest is.

use super::modular::{self, PRIME};
use crate::algebra::Rational;

/// One number: its residue modulo the prime, and its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair {
    residue: u64,
    value: f64,
}

/// How far a simple fraction may be from the float beside it, as a share of it.
const NEAR: f64 = 1e-6;

/// The x, y and z of a vector.
pub(super) type Vector = [Pair; 3];

impl Pair {
    pub(super) const ZERO: Self = Self { residue: 0, value: 0.0 };
    pub(super) const ONE: Self = Self { residue: 1, value: 1.0 };

    /// A rational number; `None` if the prime divides its denominator.
    pub(super) fn rational(number: &Rational) -> Option<Self> {
        Some(Self { residue: modular::residue(number)?, value: number.to_f64() })
    }

    /// The number that a float is: its digits times a power of two, exactly.
    pub(super) fn exact(value: f64) -> Self {
        /// Of the digits of a float.
        const DIGITS: i32 = 52;
        let bits = value.abs().to_bits();
        let (raised, digits) = (bits >> DIGITS, bits & ((1 << DIGITS) - 1));
        let (digits, exponent) = match i32::try_from(raised).unwrap_or(0) {
            0 => (digits, 1),
            exponent => (digits | (1 << DIGITS), exponent),
        };
        // 1023 is the bias of exponents.
        let exponent = exponent - 1023 - DIGITS;
        let power = modular::power(2, u64::from(exponent.unsigned_abs()));
        let scale = if exponent < 0 { modular::inverse(power) } else { power };
        let residue = modular::product(digits % PRIME, scale);
        let residue = if value < 0.0 { modular::difference(0, residue) } else { residue };
        Self { residue, value }
    }

    /// A number of which only the residue is chosen freely: π, that no polynomial relation holds for.
    pub(super) fn transcendental(residue: u64, value: f64) -> Self {
        Self { residue: residue % PRIME, value }
    }

    /// The cosine and the sine of the angle at the tangent `t` of its half.
    pub(super) fn cosine_and_sine(t: Self) -> [Self; 2] {
        let square = t.times(t);
        let below = Self::ONE.plus(square);
        let Some(over) = below.inverse() else { return [Self::ONE, Self::ZERO] };
        [Self::ONE.minus(square).times(over), t.plus(t).times(over)]
    }

    pub(super) fn value(self) -> f64 {
        self.value
    }

    pub(super) fn is_zero(self) -> bool {
        self.residue == 0
    }

    pub(super) fn equals(self, other: Self) -> bool {
        self.residue == other.residue
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self::new((self.residue + other.residue) % PRIME, self.value + other.value)
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self::new(modular::difference(self.residue, other.residue), self.value - other.value)
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self::new(modular::product(self.residue, other.residue), self.value * other.value)
    }

    pub(super) fn negated(self) -> Self {
        Self::ZERO.minus(self)
    }

    /// One over it; `None` of zero.
    pub(super) fn inverse(self) -> Option<Self> {
        (self.residue != 0).then(|| Self::new(modular::inverse(self.residue), 1.0 / self.value))
    }

    pub(super) fn power(self, exponent: u32) -> Self {
        (0..exponent).fold(Self::ONE, |power, _| power.times(self))
    }

    /// A short fraction if that is what it is, else its value to six digits.
    pub(super) fn to_rational(self) -> Rational {
        let is_it = |simple: &Rational| (simple.to_f64() - self.value).abs() <= NEAR * self.value.abs();
        if let Some(simple) = modular::simple(self.residue).filter(is_it) {
            return simple;
        }
        let rounded = Rational::parse_decimal(&format!("{:.5e}", self.value));
        rounded.unwrap_or_else(|_| unreachable!("a ratio of finite numbers is written as a decimal"))
    }

    /// What is zero is zero in both kinds.
    fn new(residue: u64, value: f64) -> Self {
        Self { residue, value: if residue == 0 { 0.0 } else { value } }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_float_and_the_fraction_that_it_is_have_one_residue() {
        for (value, above, below) in [(0.75, 3, 4), (-6.5, -13, 2), (1024.0, 1024, 1), (0.0, 0, 1)] {
            let fraction = Pair::rational(&Rational::new(above, below).unwrap()).unwrap();
            assert!(Pair::exact(value).equals(fraction), "{value}");
        }
        // A tenth is none of the floats.
        assert!(!Pair::exact(0.1).equals(Pair::rational(&Rational::new(1, 10).unwrap()).unwrap()));
    }

    #[test]
    fn short_fractions_are_seen_and_others_rounded() {
        let third = Pair::rational(&Rational::new(-1, 3).unwrap()).unwrap();
        assert_eq!(third.to_rational(), Rational::new(-1, 3).unwrap());
        let sine = Pair::exact(0.295_520_206_661_339_55);
        assert_eq!(sine.to_rational(), Rational::new(29552, 100_000).unwrap());
    }

    #[test]
    fn sine_and_cosine_lie_on_the_circle() {
        let [cosine, sine] = Pair::cosine_and_sine(Pair::exact(0.3_f64));
        assert!(cosine.times(cosine).plus(sine.times(sine)).equals(Pair::ONE));
        assert!((sine.value() - (2.0 * 0.3_f64.atan()).sin()).abs() < 1e-15);
    }
}
