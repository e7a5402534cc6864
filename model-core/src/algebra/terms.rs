//! A term of a [`Poly`] as others see it: powers, waves and poles by symbol.

use super::atom::{Circle, Meaning};
use super::poly::Poly;
use super::rational::Rational;
use crate::symbol::SymbolId;

/// Sine or cosine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Wave {
    /// Cosine.
    Cos,
    /// Sine.
    Sin,
}

/// The sine or cosine of `harmonic · symbol`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WaveFactor {
    /// The angle.
    pub symbol: SymbolId,
    /// Its whole multiple, ≥ 1.
    pub harmonic: u32,
    /// Sine or cosine.
    pub wave: Wave,
}

/// A power of the sine or cosine of a symbol in the denominator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pole {
    /// The angle.
    pub symbol: SymbolId,
    /// The sine's power.
    pub sin_power: u32,
    /// The cosine's power. One of the two powers is zero, the other is not.
    pub cos_power: u32,
}

/// One term: `coefficient · Π powers · Π waves / Π poles`, each list in order of symbols.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// Exact, never zero.
    pub coefficient: Rational,
    /// Symbols and their powers, ≥ 1.
    pub powers: Vec<(SymbolId, u32)>,
    /// Sines and cosines, at most one of each symbol. Over a pole of the same symbol it is sin θ / cosᵏ θ or
    /// cos θ / sinᵏ θ, always of harmonic 1.
    pub waves: Vec<WaveFactor>,
    /// Denominators, at most one of each symbol.
    pub poles: Vec<Pole>,
}

impl Poly {
    /// The terms, in the order of the canonical form: lexicographic by symbols, high powers first.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = Term> + '_ {
        (0..self.len()).map(|index| {
            let mut term = Term {
                coefficient: self.terms[index].coefficient.clone(),
                powers: Vec::new(),
                waves: Vec::new(),
                poles: Vec::new(),
            };
            for atom in self.key(index) {
                let symbol = atom.symbol();
                let wave = |harmonic, wave| WaveFactor { symbol, harmonic, wave };
                let sin_pole = |sin_power| Pole { symbol, sin_power, cos_power: 0 };
                let cos_pole = |cos_power| Pole { symbol, sin_power: 0, cos_power };
                match atom.meaning() {
                    Meaning::Power(power) => term.powers.push((symbol, power)),
                    Meaning::Circle(Circle::Cos(k)) => term.waves.push(wave(k, Wave::Cos)),
                    Meaning::Circle(Circle::Sin(k)) => term.waves.push(wave(k, Wave::Sin)),
                    Meaning::Circle(Circle::OverCos(k)) => term.poles.push(cos_pole(k)),
                    Meaning::Circle(Circle::OverSin(k)) => term.poles.push(sin_pole(k)),
                    Meaning::Circle(Circle::SinOverCos(k)) => {
                        term.waves.push(wave(1, Wave::Sin));
                        term.poles.push(cos_pole(k));
                    }
                    Meaning::Circle(Circle::CosOverSin(k)) => {
                        term.waves.push(wave(1, Wave::Cos));
                        term.poles.push(sin_pole(k));
                    }
                }
            }
            term
        })
    }
}
