//! Products and powers.

use std::cell::Cell;
use std::ops::Mul;

use super::atom::{Atom, Circle, Meaning};
use super::circle::{self, Combination};
use super::poly::Poly;
use super::rational::Rational;
use super::{AlgebraError, BITS_LIMIT, DEGREE_LIMIT, SIZE_LIMIT};

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

/// How much work may still be spent on products, in term products.
///
/// What a user types is multiplied out within a budget; a formula of an instrument needs a tiny part of it.
pub(crate) struct Budget {
    left: Cell<usize>,
}

impl Budget {
    /// For one checked operation, or for one typed expression.
    pub(crate) fn new() -> Self {
        Self { left: Cell::new(SIZE_LIMIT) }
    }

    fn spend(&self, work: usize) -> Result<(), AlgebraError> {
        let left = self.left.get().checked_sub(work).ok_or(AlgebraError::TooLarge)?;
        self.left.set(left);
        Ok(())
    }
}

impl Poly {
    /// `self · other`, unless the product would be unreasonably large.
    ///
    /// For expressions that a user typed; a formula of an instrument is far below the limit.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if more than about [`SIZE_LIMIT`] terms would have to be formed, or powers beyond
    /// [`DEGREE_LIMIT`].
    pub fn checked_mul(&self, other: &Self) -> Result<Self, AlgebraError> {
        self.mul_within(other, &Budget::new())
    }

    /// This to a whole power.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if the result would be unreasonably large.
    pub fn pow(&self, exponent: u32) -> Result<Self, AlgebraError> {
        self.pow_within(exponent, &Budget::new())
    }

    pub(crate) fn mul_within(&self, other: &Self, budget: &Budget) -> Result<Self, AlgebraError> {
        let (a, b) = (degrees(self), degrees(other));
        let [power, harmonic, sin_pole, cos_pole] = std::array::from_fn(|i| a[i].saturating_add(b[i]));
        if power.max(sin_pole).max(cos_pole) > DEGREE_LIMIT {
            return Err(AlgebraError::TooLarge);
        }
        // A product with poles is divided with remainder, once for each power, over all harmonics; poles of the sine
        // times poles of the cosine are first split into as many parts. Those are operations on numbers, of which
        // sixteen cost about as much as a product of terms.
        let poles = u64::from(sin_pole + cos_pole);
        let parts = if sin_pole > 0 && cos_pole > 0 { poles } else { 1 };
        let each = poles.saturating_mul(parts).saturating_mul(poles + u64::from(harmonic)) / 16 + 1;
        let each = usize::try_from(each).unwrap_or(usize::MAX);
        budget.spend(self.len().saturating_mul(other.len()).saturating_mul(each))?;
        let product = self * other;
        budget.spend(product.atoms.len() / 8)?;
        if product.terms.iter().any(|head| head.coefficient.bits() > BITS_LIMIT) {
            return Err(AlgebraError::TooLarge);
        }
        Ok(product)
    }

    pub(crate) fn pow_within(&self, exponent: u32, budget: &Budget) -> Result<Self, AlgebraError> {
        // Numbers grow without any degree.
        let grows = self.as_constant().is_some_and(|value| !value.is_zero() && !value.abs().is_one());
        if grows && exponent > DEGREE_LIMIT {
            return Err(AlgebraError::TooLarge);
        }
        let mut result = Self::one();
        let mut base = self.clone();
        let mut left = exponent;
        while left > 0 {
            if left & 1 == 1 {
                result = result.mul_within(&base, budget)?;
            }
            left >>= 1;
            if left > 0 {
                base = base.mul_within(&base, budget)?;
            }
        }
        Ok(result)
    }
}

/// The highest power of a symbol, the highest harmonic, and the highest poles of sine and cosine in a polynomial.
fn degrees(poly: &Poly) -> [u32; 4] {
    let mut degrees = [0; 4];
    for atom in &poly.atoms {
        let kind = match atom.meaning() {
            Meaning::Power(_) => 0,
            Meaning::Circle(Circle::Cos(_) | Circle::Sin(_)) => 1,
            Meaning::Circle(Circle::OverSin(_) | Circle::CosOverSin(_)) => 2,
            Meaning::Circle(Circle::OverCos(_) | Circle::SinOverCos(_)) => 3,
        };
        degrees[kind] = atom.number().max(degrees[kind]);
    }
    degrees
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
