//! Formulas over the sines and cosines of single angles: what is left of the canonical form when multiples of angles are
//! written out, so that Coq decides equality by polynomial arithmetic and sin² + cos² = 1.

use std::collections::BTreeMap;

use super::Refusal;
use model_core::algebra::{Poly, Rational, Wave};
use model_core::symbol::SymbolId;

/// The highest multiple of an angle that is written out.
pub(super) const HARMONIC_LIMIT: u32 = 24;

/// What a factor of a term does with its symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// The symbol itself.
    Value,
    /// Its sine.
    Sin,
    /// Its cosine.
    Cos,
    /// One over its sine.
    OverSin,
    /// One over its cosine.
    OverCos,
}

/// Factors with their powers, in order.
pub(super) type Key = Vec<(SymbolId, Part, u32)>;

/// A sum of products with exact coefficients; at most the first power of each sine.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Expanded(pub(super) BTreeMap<Key, Rational>);

impl Expanded {
    /// A canonical form with its multiples of angles written out.
    pub(super) fn new(poly: &Poly) -> Result<Self, Refusal> {
        let mut sum = Self::default();
        for term in poly.terms() {
            let mut products: Vec<(Rational, Key)> = vec![(term.coefficient.clone(), Vec::new())];
            let mut times = |factors: &[(Rational, Key)]| {
                products = products
                    .iter()
                    .flat_map(|(a, left)| {
                        factors.iter().map(move |(b, right)| (a * b, [left.as_slice(), right].concat()))
                    })
                    .collect();
            };
            for &(symbol, power) in &term.powers {
                times(&[(Rational::ONE, vec![(symbol, Part::Value, power)])]);
            }
            for wave in &term.waves {
                if wave.harmonic > HARMONIC_LIMIT {
                    return Err(Refusal::Harmonic { multiple: wave.harmonic });
                }
                times(&multiple(wave.symbol, wave.wave, wave.harmonic));
            }
            for pole in &term.poles {
                let (part, power) = if pole.sin_power > 0 {
                    (Part::OverSin, pole.sin_power)
                } else {
                    (Part::OverCos, pole.cos_power)
                };
                times(&[(Rational::ONE, vec![(pole.symbol, part, power)])]);
            }
            for (coefficient, mut key) in products {
                key.sort_unstable();
                sum.add(key, &coefficient);
            }
        }
        Ok(sum)
    }

    fn add(&mut self, key: Key, coefficient: &Rational) {
        let sum = self.0.remove(&key).map_or_else(|| coefficient.clone(), |before| &before + coefficient);
        if !sum.is_zero() {
            self.0.insert(key, sum);
        }
    }

    /// The number that this is, if it is one.
    pub(super) fn as_constant(&self) -> Option<Rational> {
        let mut keys = self.0.iter();
        match (keys.next(), keys.next()) {
            (None, _) => Some(Rational::ZERO),
            (Some((key, value)), None) if key.is_empty() => Some(value.clone()),
            _ => None,
        }
    }

    /// Times a number other than zero.
    pub(super) fn scale(&self, factor: &Rational) -> Self {
        Self(self.0.iter().map(|(key, value)| (key.clone(), value * factor)).collect())
    }

    /// In Coq's syntax, with `name` for a symbol.
    pub(super) fn write(&self, name: &dyn Fn(SymbolId) -> String) -> String {
        let mut text = String::new();
        for (key, coefficient) in &self.0 {
            let negative = coefficient.is_negative();
            text.push_str(match (text.is_empty(), negative) {
                (true, false) => "",
                (true, true) => "- ",
                (false, false) => " + ",
                (false, true) => " - ",
            });
            let magnitude = coefficient.abs();
            let mut above = Vec::new();
            if !magnitude.is_one()
                || key.iter().all(|(_, part, _)| matches!(part, Part::OverSin | Part::OverCos))
            {
                above.push(magnitude.to_string().replace('/', " / "));
            }
            let mut below = String::new();
            for &(symbol, part, power) in key {
                let power = if power == 1 { String::new() } else { format!(" ^ {power}") };
                let name = name(symbol);
                match part {
                    Part::Value => above.push(format!("{name}{power}")),
                    Part::Sin => above.push(format!("sin {name}{power}")),
                    Part::Cos => above.push(format!("cos {name}{power}")),
                    Part::OverSin => below.push_str(&format!(" / sin {name}{power}")),
                    Part::OverCos => below.push_str(&format!(" / cos {name}{power}")),
                }
            }
            // A fraction in front is one number, not a number and a divisor of all that follows.
            text.push_str(&above.join(" * "));
            text.push_str(&below);
        }
        if text.is_empty() { "0".to_owned() } else { text }
    }
}

/// cos kθ and sin kθ as polynomials in cos θ, the latter times sin θ.
///
/// Source: Chebyshev's polynomials of the first and second kind, by their common recurrence.
fn multiple(symbol: SymbolId, wave: Wave, harmonic: u32) -> Vec<(Rational, Key)> {
    let two = Rational::from(2);
    // From the polynomials of k − 1 and k, lowest powers first, to that of k + 1: 2c·pₖ − pₖ₋₁.
    let next = |last: &[Rational], this: &[Rational]| -> Vec<Rational> {
        (0..=this.len())
            .map(|power| {
                let raised = power
                    .checked_sub(1)
                    .and_then(|power| this.get(power))
                    .map_or(Rational::ZERO, |a| a * &two);
                last.get(power).map_or(raised.clone(), |b| &raised - b)
            })
            .collect()
    };
    let (mut last, mut this, steps, sine) = match wave {
        Wave::Cos => {
            (vec![Rational::ONE], vec![Rational::ZERO, Rational::ONE], harmonic.saturating_sub(1), None)
        }
        Wave::Sin => (vec![], vec![Rational::ONE], harmonic.saturating_sub(1), Some((symbol, Part::Sin, 1))),
    };
    for _ in 0..steps {
        let following = next(&last, &this);
        last = std::mem::replace(&mut this, following);
    }
    (0u32..)
        .zip(this)
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .map(|(power, coefficient)| {
            let cosine = (power > 0).then_some((symbol, Part::Cos, power));
            (coefficient, sine.into_iter().chain(cosine).collect())
        })
        .collect()
}
