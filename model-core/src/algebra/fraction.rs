//! A quotient of two canonical forms: what a printed formula may be that divides by sums or measured distances. Two are
//! equal if and only if they are after multiplying out, for products of functions that are not zero are not zero.

use super::{AlgebraError, Poly};
use crate::symbol::SymbolId;

/// `above / below`; below is never zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Fraction {
    /// Above the stroke.
    pub above: Poly,
    /// Below the stroke; one wherever the division can be carried out.
    pub below: Poly,
}

impl Fraction {
    /// A whole amount.
    #[must_use]
    pub fn whole(above: Poly) -> Self {
        Self { above, below: Poly::one() }
    }

    /// Whether nothing stands below.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.below == Poly::one()
    }

    /// Whether this is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// A quotient with the division carried out where it can be; `None` for a division by zero.
    #[must_use]
    pub fn new(above: Poly, below: Poly) -> Option<Self> {
        if below.is_zero() {
            return None;
        }
        if above.is_zero() {
            return Some(Self::whole(above));
        }
        if let Some(inverse) = below.recip() {
            return Some(Self::whole(&above * &inverse));
        }
        let common = common_powers(&above, &below);
        let (above, below) = (above.without_monomial(&common), below.without_monomial(&common));
        match below.recip() {
            Some(inverse) => Some(Self::whole(&above * &inverse)),
            None => Some(Self { above, below }),
        }
    }

    /// The sum.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if it would be unreasonably large.
    pub fn sum(&self, other: &Self) -> Result<Self, AlgebraError> {
        if self.below == other.below {
            let above = &self.above + &other.above;
            return Ok(Self::new(above, self.below.clone()).unwrap_or_else(|| Self::whole(Poly::zero())));
        }
        let above = &self.above.checked_mul(&other.below)? + &other.above.checked_mul(&self.below)?;
        let below = self.below.checked_mul(&other.below)?;
        Ok(Self::new(above, below).unwrap_or_else(|| Self::whole(Poly::zero())))
    }

    /// The product.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`] if it would be unreasonably large.
    pub fn product(&self, other: &Self) -> Result<Self, AlgebraError> {
        if self.below == other.above && !self.is_whole() {
            return Ok(Self { above: self.above.clone(), below: other.below.clone() });
        }
        let above = self.above.checked_mul(&other.above)?;
        let below = self.below.checked_mul(&other.below)?;
        Ok(Self::new(above, below).unwrap_or_else(|| Self::whole(Poly::zero())))
    }

    /// One over this; `None` if it is zero.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        Self::new(self.below.clone(), self.above.clone())
    }

    /// The sign turned.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { above: -&self.above, below: self.below.clone() }
    }

    /// The product, however large it is: for what was derived, not typed.
    #[must_use]
    pub(crate) fn product_of_any_size(&self, other: &Self) -> Self {
        let (above, below) = (&self.above * &other.above, &self.below * &other.below);
        Self::new(above, below).unwrap_or_else(|| unreachable!("nothing stands over zero"))
    }

    /// The value; see [`Poly::eval`].
    #[must_use]
    pub fn eval(&self, values: &[f64]) -> f64 {
        if self.is_whole() {
            self.above.eval(values)
        } else {
            self.above.eval(values) / self.below.eval(values)
        }
    }

    /// The symbols that occur, in order.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        let mut symbols = [self.above.symbols(), self.below.symbols()].concat();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }
}

/// The powers of symbols that every term above and below has.
fn common_powers(above: &Poly, below: &Poly) -> Vec<(SymbolId, u32)> {
    let above = above.monomial_content();
    let shared = |(symbol, power): (SymbolId, u32)| {
        above.iter().find(|(other, _)| *other == symbol).map(|&(_, n)| (symbol, n.min(power)))
    };
    below.monomial_content().into_iter().filter_map(shared).collect()
}
