//! Between what a canonical form lies over a domain.

use super::domain::{Domain, DomainError};
use super::interval::Interval;
use crate::algebra::{Poly, Rational, Wave};
use crate::chain::Chain;
use crate::symbol::SymbolId;

impl Domain {
    /// Between what a form lies.
    ///
    /// # Errors
    /// [`DomainError`] if a symbol without a range stands outside of sines and cosines, or a denominator vanishes.
    pub(super) fn enclose(&self, chain: &Chain, poly: &Poly) -> Result<Interval, DomainError> {
        let mut sum = Interval::ZERO;
        for term in poly.terms() {
            let mut product = coefficient(&term.coefficient);
            for &(symbol, power) in &term.powers {
                let range = self
                    .range(symbol)
                    .ok_or_else(|| DomainError::RangeNeeded { name: chain.symbol(symbol).name.clone() })?;
                product = product * Interval::new(range).powi(power);
            }
            for factor in &term.waves {
                let angle = self.angle(factor.symbol) * Interval::exact(f64::from(factor.harmonic));
                product = product
                    * match factor.wave {
                        Wave::Cos => angle.cos(),
                        Wave::Sin => angle.sin(),
                    };
            }
            for pole in &term.poles {
                let of_sine = pole.sin_power > 0;
                let angle = self.angle(pole.symbol);
                let over = if of_sine { angle.sin() } else { angle.cos() }.recip();
                let over = over.ok_or_else(|| DomainError::singular(chain, pole.symbol, of_sine))?;
                product = product * over.powi(pole.sin_power.max(pole.cos_power));
            }
            sum = sum + product;
        }
        Ok(sum)
    }

    /// Between what an angle lies; without a range it makes a whole turn.
    fn angle(&self, symbol: SymbolId) -> Interval {
        Interval::new(self.range(symbol).unwrap_or_else(Interval::turn))
    }
}

fn coefficient(coefficient: &Rational) -> Interval {
    match coefficient.to_integer() {
        Some(whole) if whole.unsigned_abs() < 1 << 53 => Interval::exact(whole as f64),
        _ => Interval::rounded(coefficient.to_f64()),
    }
}
