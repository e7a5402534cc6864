//! A place: a number for every symbol, and for its cosine and sine, at which forms are evaluated without rounding.
//!
//! Joints, inputs and ramps are anywhere; constants are where they are declared. An angle is at the place with rational sine
//! and cosine that is nearest to its value, some 1e-16 rad from it; one of so many quarter turns is exactly there.

use super::modular::scattered;
use super::pair::Pair;
use super::special;
use crate::algebra::{AngleSum, Poly, Wave};
use crate::chain::Chain;
use crate::symbol::{Quantity, SymbolId, SymbolKind};

pub(super) struct Place {
    /// By symbol: the number itself, and the cosine and sine of the angle.
    symbols: Vec<(Pair, [Pair; 2])>,
}

impl Place {
    /// The place of a number, another one for each.
    pub(super) fn new(chain: &Chain, number: u64) -> Self {
        // 53 bits of a scattered number, between −1 and 1.
        let uniform = |seed: u64| (scattered(seed) >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        let anywhere = |id: usize, stream: u64| uniform((number << 20) | ((id as u64) << 2) | stream);
        let place = |(id, symbol): (usize, &crate::Symbol)| match (symbol.kind, symbol.value) {
            (SymbolKind::Pi, value) => {
                let pi = Pair::transcendental(scattered(0), value.unwrap_or(std::f64::consts::PI));
                (pi, [Pair::ONE.negated(), Pair::ZERO])
            }
            (SymbolKind::Constant, Some(value)) => {
                let angle = if symbol.quantity == Quantity::Angle { value } else { 0.0 };
                (Pair::exact(value), on_circle(angle))
            }
            // A constant without a value is the same at every place, and has no relation to any other.
            (SymbolKind::Constant, None) => {
                let seed = (id as u64) << 2;
                (Pair::exact(uniform(seed)), on_circle(uniform(seed | 1) * 3.0))
            }
            _ => (Pair::exact(anywhere(id, 0)), on_circle(anywhere(id, 1) * 3.0)),
        };
        let mut symbols: Vec<(Pair, [Pair; 2])> = chain.symbols.iter().enumerate().map(place).collect();
        for (id, value) in special(chain) {
            if let Ok(angle) = AngleSum::from_poly(&value) {
                symbols[id.index()].1 = quarters(angle.quarters());
            }
        }
        Self { symbols }
    }

    /// The value of a form; `None` where a denominator vanishes.
    pub(super) fn value(&self, poly: &Poly) -> Option<Pair> {
        let mut sum = Pair::ZERO;
        for term in poly.terms() {
            let mut value = Pair::rational(&term.coefficient)?;
            for &(symbol, exponent) in &term.powers {
                value = value.times(self.symbols[symbol.index()].0.power(exponent));
            }
            for wave in &term.waves {
                let [cosine, sine] = self.multiple(wave.symbol, wave.harmonic);
                value = value.times(match wave.wave {
                    Wave::Cos => cosine,
                    Wave::Sin => sine,
                });
            }
            for pole in &term.poles {
                let [cosine, sine] = self.symbols[pole.symbol.index()].1;
                for (below, exponent) in [(cosine, pole.cos_power), (sine, pole.sin_power)] {
                    if exponent > 0 {
                        value = value.times(below.inverse()?.power(exponent));
                    }
                }
            }
            sum = sum.plus(value);
        }
        Some(sum)
    }

    /// The cosine and sine of a sum of angles.
    pub(super) fn cosine_and_sine(&self, angle: &AngleSum) -> [Pair; 2] {
        angle.multiples().iter().fold(quarters(angle.quarters()), |turned, &(symbol, times)| {
            let [cosine, sine] = self.multiple(symbol, times.unsigned_abs());
            added(turned, [cosine, if times < 0 { sine.negated() } else { sine }])
        })
    }

    fn multiple(&self, symbol: SymbolId, harmonic: u32) -> [Pair; 2] {
        let (mut result, mut base, mut left) = (quarters(0), self.symbols[symbol.index()].1, harmonic);
        while left > 0 {
            if left & 1 == 1 {
                result = added(result, base);
            }
            base = added(base, base);
            left >>= 1;
        }
        result
    }
}

/// The cosine and sine of so many quarter turns.
fn quarters(count: u8) -> [Pair; 2] {
    let (one, zero) = (Pair::ONE, Pair::ZERO);
    match count % 4 {
        0 => [one, zero],
        1 => [zero, one],
        2 => [one.negated(), zero],
        _ => [zero, one.negated()],
    }
}

/// The cosine and sine of an angle, rad, or of one next to it.
fn on_circle(angle_rad: f64) -> [Pair; 2] {
    Pair::cosine_and_sine(Pair::exact((angle_rad / 2.0).tan()))
}

/// The cosine and sine of a sum.
fn added([c, s]: [Pair; 2], [other_c, other_s]: [Pair; 2]) -> [Pair; 2] {
    [c.times(other_c).minus(s.times(other_s)), s.times(other_c).plus(c.times(other_s))]
}
