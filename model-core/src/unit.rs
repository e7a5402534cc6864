//! Units that a number of the language may carry: `53 deg`, `0.1 mm`. Their sizes are exact.

use crate::algebra::{Poly, Rational};
use crate::symbol::SymbolId;

/// A unit of angle or of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unit {
    name: &'static str,
    numerator: i64,
    denominator: i64,
    /// Whether the size is a multiple of π.
    of_pi: bool,
}

const fn plain(name: &'static str, numerator: i64, denominator: i64) -> Unit {
    Unit { name, numerator, denominator, of_pi: false }
}

const fn of_pi(name: &'static str, denominator: i64) -> Unit {
    Unit { name, numerator: 1, denominator, of_pi: true }
}

/// Every unit of the language, with its size in rad or m.
const UNITS: [Unit; 14] = [
    plain("rad", 1, 1),
    plain("mrad", 1, 1000),
    plain("urad", 1, 1_000_000),
    of_pi("deg", 180),
    of_pi("arcmin", 10_800),
    of_pi("arcsec", 648_000),
    of_pi("mas", 648_000_000),
    of_pi("gon", 200),
    plain("m", 1, 1),
    plain("km", 1000, 1),
    plain("cm", 1, 100),
    plain("mm", 1, 1000),
    plain("um", 1, 1_000_000),
    plain("nm", 1, 1_000_000_000),
];

impl Unit {
    /// The unit of this name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        UNITS.into_iter().find(|unit| unit.name == name)
    }

    /// As it is written: `arcsec`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.name
    }

    /// A number of this unit in SI (rad or m), exactly.
    #[must_use]
    pub fn amount(self, number: &Rational) -> Poly {
        let whole = Poly::constant(number * &Rational::from(self.numerator));
        let Some(size) = Rational::new(1, self.denominator) else {
            unreachable!("the table of units has no denominator that is zero")
        };
        let amount = whole.scale(&size);
        if self.of_pi { &amount * &Poly::symbol(SymbolId::PI) } else { amount }
    }
}
