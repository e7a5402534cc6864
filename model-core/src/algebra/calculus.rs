//! Derivatives, substitution and values.

use super::AlgebraError;
use super::angle::AngleSum;
use super::atom::{Atom, Circle, Meaning};
use super::circle;
use super::poly::Poly;
use super::rational::Rational;
use crate::symbol::SymbolId;

impl Poly {
    /// The partial derivative with respect to a symbol, wherever it occurs.
    #[must_use]
    pub fn derivative(&self, symbol: SymbolId) -> Self {
        let mut result = Self::zero();
        let mut expansion = Vec::new();
        let mut key = Vec::new();
        for (coefficient, atoms) in self.iter() {
            for (index, atom) in atoms.iter().enumerate().filter(|(_, atom)| atom.symbol() == symbol) {
                let mut append = |factor: &Rational, replacement: Option<Atom>| {
                    key.clear();
                    key.extend_from_slice(&atoms[..index]);
                    key.extend(replacement);
                    key.extend_from_slice(&atoms[index + 1..]);
                    result.push(coefficient * factor, &key);
                };
                match atom.meaning() {
                    Meaning::Power(n) => {
                        let lower = (n > 1).then(|| Atom::power(symbol, n - 1));
                        append(&Rational::from(i64::from(n)), lower);
                    }
                    Meaning::Circle(function) => {
                        expansion.clear();
                        circle::derivative(function, &mut expansion);
                        for (factor, function) in &expansion {
                            append(factor, function.map(|function| Atom::circle(symbol, function)));
                        }
                    }
                }
            }
        }
        result.normalised()
    }

    /// This with every occurrence of `symbol` replaced.
    ///
    /// # Errors
    /// [`AlgebraError::NotAnAngle`] if the symbol occurs in a sine or cosine and `replacement` is no
    /// [`AngleSum`]; [`AlgebraError::NotDivisible`] if it occurs in a denominator that the replacement makes zero
    /// or a sine or cosine of several angles; [`AlgebraError::TooLarge`].
    pub fn substitute(&self, symbol: SymbolId, replacement: &Self) -> Result<Self, AlgebraError> {
        if self.iter().all(|(_, atoms)| atoms.iter().all(|atom| atom.symbol() != symbol)) {
            return Ok(self.clone());
        }
        let mut result = Self::zero();
        for (coefficient, atoms) in self.iter() {
            let mut rest = Self::zero();
            let kept: Vec<Atom> = atoms.iter().copied().filter(|atom| atom.symbol() != symbol).collect();
            rest.push(coefficient.clone(), &kept);
            for atom in atoms.iter().filter(|atom| atom.symbol() == symbol) {
                let value = match atom.meaning() {
                    Meaning::Power(n) => replacement.pow(n)?,
                    Meaning::Circle(function) => circle_of(function, replacement)?,
                };
                rest = rest.checked_mul(&value)?;
            }
            result = &result + &rest;
        }
        Ok(result)
    }

    /// The value at `values`, indexed by [`SymbolId`]; angles in radians. A symbol beyond the slice gives NaN.
    #[must_use]
    pub fn eval(&self, values: &[f64]) -> f64 {
        self.iter()
            .map(|(coefficient, atoms)| {
                atoms.iter().fold(coefficient.to_f64(), |product, atom| {
                    let value = values.get(atom.symbol().index()).copied().unwrap_or(f64::NAN);
                    product
                        * match atom.meaning() {
                            Meaning::Power(1) => value,
                            Meaning::Power(n) => {
                                i32::try_from(n).map_or_else(|_| value.powf(f64::from(n)), |n| value.powi(n))
                            }
                            Meaning::Circle(function) => circle::evaluate(function, value),
                        }
                })
            })
            .sum()
    }
}

/// A function of one angle at a sum of angles.
fn circle_of(function: Circle, angle: &Poly) -> Result<Poly, AlgebraError> {
    let sum = AngleSum::from_poly(angle)?;
    let over = |base: Poly, k: u32| base.recip().ok_or(AlgebraError::NotDivisible)?.pow(k);
    let (cosine, sine) = sum.cos_sin();
    Ok(match function {
        Circle::Cos(k) => sum.times(k)?.cos_sin().0,
        Circle::Sin(k) => sum.times(k)?.cos_sin().1,
        Circle::OverCos(k) => over(cosine, k)?,
        Circle::OverSin(k) => over(sine, k)?,
        Circle::SinOverCos(k) => &sine * &over(cosine, k)?,
        Circle::CosOverSin(k) => &cosine * &over(sine, k)?,
    })
}
