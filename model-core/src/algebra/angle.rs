//! Angles that the algebra can take the sine of: whole multiples of symbols plus quarter turns.

use super::atom::{Circle, Meaning};
use super::poly::Poly;
use super::rational::Rational;
use super::{AlgebraError, HARMONIC_LIMIT};
use crate::symbol::SymbolId;

/// Symbols that one sine or cosine may add up: expansion doubles the terms with each.
const SYMBOLS_LIMIT: usize = 12;

/// `Σ nᵢ·symbolᵢ + quarters·π/2`, with whole `nᵢ`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AngleSum {
    /// By symbol; multiples are never zero.
    multiples: Vec<(SymbolId, i32)>,
    /// Quarter turns, 0 to 3.
    quarters: u8,
}

impl AngleSum {
    /// One symbol.
    #[must_use]
    pub fn symbol(symbol: SymbolId) -> Self {
        Self { multiples: vec![(symbol, 1)], quarters: 0 }
    }

    /// Reads an amount as such a sum.
    ///
    /// # Errors
    /// [`AlgebraError::NotAnAngle`] if it is none: a product, a function, a fraction of a symbol, a plain number
    /// other than zero, or a fraction of π other than quarter turns; [`AlgebraError::TooLarge`] if it is a
    /// sum of more than a dozen symbols or an unreasonably high multiple.
    pub fn from_poly(amount: &Poly) -> Result<Self, AlgebraError> {
        let mut sum = Self::default();
        for (coefficient, atoms) in amount.iter() {
            let [atom] = atoms else { return Err(AlgebraError::NotAnAngle) };
            if atom.meaning() != Meaning::Power(1) {
                return Err(AlgebraError::NotAnAngle);
            }
            if atom.symbol() == SymbolId::PI {
                let quarters = (coefficient * &Rational::from(2)).to_integer();
                let quarters = quarters.ok_or(AlgebraError::NotAnAngle)?.rem_euclid(4);
                sum.quarters = u8::try_from(quarters).map_err(|_| AlgebraError::NotAnAngle)?;
            } else {
                let multiple = coefficient.to_integer().ok_or(AlgebraError::NotAnAngle)?;
                let multiple = i32::try_from(multiple).map_err(|_| AlgebraError::TooLarge)?;
                if multiple.unsigned_abs() > HARMONIC_LIMIT || sum.multiples.len() == SYMBOLS_LIMIT {
                    return Err(AlgebraError::TooLarge);
                }
                sum.multiples.push((atom.symbol(), multiple));
            }
        }
        sum.multiples.sort_unstable();
        Ok(sum)
    }

    /// The sum times a whole number.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if a multiple becomes unreasonably high.
    pub fn times(&self, factor: u32) -> Result<Self, AlgebraError> {
        let multiples = self.multiples.iter().map(|&(symbol, n)| {
            let product = i64::from(n) * i64::from(factor);
            let product = i32::try_from(product).map_err(|_| AlgebraError::TooLarge)?;
            if product.unsigned_abs() > HARMONIC_LIMIT {
                return Err(AlgebraError::TooLarge);
            }
            Ok((symbol, product))
        });
        let multiples = if factor == 0 { Vec::new() } else { multiples.collect::<Result<Vec<_>, _>>()? };
        let quarters = (0..factor % 4).fold(0, |sum, _| (sum + self.quarters) % 4);
        Ok(Self { multiples, quarters })
    }

    /// The symbols and their whole multiples, by symbol.
    #[must_use]
    pub fn multiples(&self) -> &[(SymbolId, i32)] {
        &self.multiples
    }

    /// The quarter turns beside them, 0 to 3.
    #[must_use]
    pub fn quarters(&self) -> u8 {
        self.quarters
    }

    /// Whether the angle is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.multiples.is_empty() && self.quarters == 0
    }

    /// The cosine and the sine, expanded by angle addition.
    #[must_use]
    pub fn cos_sin(&self) -> (Poly, Poly) {
        let (mut cosine, mut sine) = match self.quarters {
            0 => (Poly::one(), Poly::zero()),
            1 => (Poly::zero(), Poly::one()),
            2 => (-&Poly::one(), Poly::zero()),
            _ => (Poly::zero(), -&Poly::one()),
        };
        for &(symbol, multiple) in &self.multiples {
            let harmonic = multiple.unsigned_abs();
            let c = Poly::circle(symbol, Circle::Cos(harmonic));
            let s = Poly::circle(symbol, Circle::Sin(harmonic));
            let s = if multiple < 0 { -&s } else { s };
            (cosine, sine) = (&(&cosine * &c) - &(&sine * &s), &(&sine * &c) + &(&cosine * &s));
        }
        (cosine, sine)
    }
}

impl Poly {
    /// The sine of an angle.
    #[must_use]
    pub fn sin(angle: &AngleSum) -> Self {
        angle.cos_sin().1
    }

    /// The cosine of an angle.
    #[must_use]
    pub fn cos(angle: &AngleSum) -> Self {
        angle.cos_sin().0
    }

    /// One over this, if it is a rational number times sines, cosines and their reciprocals: of one symbol, or of
    /// twice one symbol (sin 2θ = 2 sin θ cos θ).
    #[must_use]
    pub fn recip(&self) -> Option<Self> {
        let [head] = self.terms.as_slice() else { return None };
        let mut result = Self::constant(head.coefficient.recip()?);
        for atom in self.key(0) {
            let Meaning::Circle(function) = atom.meaning() else { return None };
            let part = |function| Self::circle(atom.symbol(), function);
            let factor = match function {
                Circle::Cos(1) => part(Circle::OverCos(1)),
                Circle::Sin(1) => part(Circle::OverSin(1)),
                // 1/sin 2θ = (tan θ + cot θ)/2
                Circle::Sin(2) => {
                    (&part(Circle::SinOverCos(1)) + &part(Circle::CosOverSin(1))).scale(&Rational::half())
                }
                Circle::OverCos(k) => part(Circle::Cos(1)).pow(k).ok()?,
                Circle::OverSin(k) => part(Circle::Sin(1)).pow(k).ok()?,
                Circle::SinOverCos(k) => &part(Circle::Cos(1)).pow(k).ok()? * &part(Circle::OverSin(1)),
                Circle::CosOverSin(k) => &part(Circle::Sin(1)).pow(k).ok()? * &part(Circle::OverCos(1)),
                Circle::Cos(_) | Circle::Sin(_) => return None,
            };
            result = &result * &factor;
        }
        Some(result)
    }
}
