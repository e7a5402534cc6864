//! Products and powers.

use std::ops::Mul;

use super::atom::{Atom, Meaning};
use super::circle::{self, Combination};
use super::poly::Poly;
use super::rational::Rational;
use super::{AlgebraError, SIZE_LIMIT};

impl Mul for &Poly {
    type Output = Poly;

    fn mul(self, other: &Poly) -> Poly {
        let mut result = Poly::zero();
        let mut scratch = Scratch::default();
        for (a, left) in self.iter() {
            for (b, right) in other.iter() {
                scratch.multiply(&(a * b), left, right, &mut result);
            }
        }
        result.normalised()
    }
}

impl Poly {
    /// `self · other`, unless the product would be unreasonably large.
    ///
    /// For expressions that a user typed; a formula of an instrument is far below the limit.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if more than [`SIZE_LIMIT`] terms would have to be formed.
    pub fn checked_mul(&self, other: &Self) -> Result<Self, AlgebraError> {
        if self.len().saturating_mul(other.len()) > SIZE_LIMIT {
            return Err(AlgebraError::TooLarge);
        }
        let product = self * other;
        let atoms = product.atoms.len();
        if atoms > SIZE_LIMIT { Err(AlgebraError::TooLarge) } else { Ok(product) }
    }

    /// This to a whole power.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if the result would be unreasonably large.
    pub fn pow(&self, exponent: u32) -> Result<Self, AlgebraError> {
        let degree = self.atoms.iter().map(|atom| atom.number()).max().unwrap_or(0);
        if self.as_constant().is_none_or(|value| !value.is_zero() && !value.abs().is_one())
            && degree.max(1).saturating_mul(exponent) > super::DEGREE_LIMIT
        {
            return Err(AlgebraError::TooLarge);
        }
        let mut result = Self::one();
        let mut base = self.clone();
        let mut left = exponent;
        while left > 0 {
            if left & 1 == 1 {
                result = result.checked_mul(&base)?;
            }
            left >>= 1;
            if left > 0 {
                base = base.checked_mul(&base)?;
            }
        }
        Ok(result)
    }
}

/// Space that the product of two terms needs, kept from one product to the next.
#[derive(Default)]
struct Scratch {
    atoms: Vec<Atom>,
    /// Pairs of circle functions of the same angle that met.
    met: Vec<(Atom, Atom)>,
    expansion: Combination,
}

impl Scratch {
    /// Appends `coefficient · left · right` to `out`, unsorted.
    fn multiply(&mut self, coefficient: &Rational, left: &[Atom], right: &[Atom], out: &mut Poly) {
        self.atoms.clear();
        self.met.clear();
        let (mut i, mut j) = (0, 0);
        while i < left.len() && j < right.len() {
            let (a, b) = (left[i], right[j]);
            if a.meets(b) {
                i += 1;
                j += 1;
                match (a.meaning(), b.meaning()) {
                    (Meaning::Power(m), Meaning::Power(n)) => {
                        self.atoms.push(Atom::power(a.symbol(), m.saturating_add(n)));
                    }
                    _ => self.met.push((a, b)),
                }
            } else if a < b {
                i += 1;
                self.atoms.push(a);
            } else {
                j += 1;
                self.atoms.push(b);
            }
        }
        self.atoms.extend_from_slice(&left[i..]);
        self.atoms.extend_from_slice(&right[j..]);
        self.expand(coefficient, self.met.len(), out);
    }

    /// Expands the first `count` pairs that met, the last of them first, and appends the terms.
    fn expand(&mut self, coefficient: &Rational, count: usize, out: &mut Poly) {
        let Some(index) = count.checked_sub(1) else {
            return out.push(coefficient.clone(), &self.atoms);
        };
        let (a, b) = self.met[index];
        let (Meaning::Circle(left), Meaning::Circle(right)) = (a.meaning(), b.meaning()) else {
            return;
        };
        let from = self.expansion.len();
        circle::product(left, right, &mut self.expansion);
        for position in from..self.expansion.len() {
            let (factor, function) = self.expansion[position].clone();
            let product = coefficient * &factor;
            match function {
                None => self.expand(&product, index, out),
                Some(function) => {
                    let atom = Atom::circle(a.symbol(), function);
                    let place = self.atoms.partition_point(|other| *other < atom);
                    self.atoms.insert(place, atom);
                    self.expand(&product, index, out);
                    self.atoms.remove(place);
                }
            }
        }
        self.expansion.truncate(from);
    }
}
