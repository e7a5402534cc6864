//! Upper bounds: numbers that are never too small, because every operation rounds up.

use std::iter::Sum;
use std::ops::{Add, Mul};

/// A number ≥ 0 that is at least the quantity it stands for.
///
/// IEEE arithmetic rounds to nearest, so the next float above a result is never below the exact one. Sums with and
/// products by zero are exact and stay so.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub(super) struct Upper(f64);

impl Upper {
    pub(super) const ZERO: Self = Self(0.0);
    pub(super) const ONE: Self = Self(1.0);

    /// An exactly known number; its sign is dropped.
    pub(super) fn exact(value: f64) -> Self {
        Self(value.abs())
    }

    /// A number known to within one unit in the last place.
    pub(super) fn rounded(value: f64) -> Self {
        Self(value.abs().next_up())
    }

    pub(super) fn get(self) -> f64 {
        self.0
    }

    pub(super) fn is_zero(self) -> bool {
        self.0 == 0.0
    }

    pub(super) fn half(self) -> Self {
        self * Self(0.5)
    }

    pub(super) fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    pub(super) fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    /// This over a number that is known to be at least so large; `None` unless that is above zero.
    pub(super) fn over(self, least: f64) -> Option<Self> {
        if least > 0.0 {
            Some(if self.is_zero() { self } else { Self((self.0 / least).next_up()) })
        } else {
            None
        }
    }

    pub(super) fn powi(self, exponent: u32) -> Self {
        (0..exponent).fold(Self::ONE, |product, _| product * self)
    }

    /// The length of a vector of which the components are bounded.
    pub(super) fn norm(vector: [Self; 3]) -> Self {
        vector.iter().map(|&component| component * component).sum::<Self>().root()
    }

    /// The square root.
    pub(super) fn root(self) -> Self {
        if self.is_zero() { self } else { Self(self.0.sqrt().next_up()) }
    }

    /// e to this. For x ≤ 1, eˣ ≤ 1 + x + x²; larger arguments are halved and the result squared.
    pub(super) fn exp(self) -> Self {
        /// Halvings: enough to make the inequality sharp, few enough to cost nothing.
        const HALVINGS: i32 = 10;
        let mut x = self.0 / f64::from(1 << HALVINGS);
        let mut squarings = HALVINGS;
        while x > 1.0 && squarings < 2000 {
            x /= 2.0;
            squarings += 1;
        }
        let x = Self(x);
        (0..squarings).fold(Self::ONE + x + x * x, |power, _| power * power)
    }
}

impl Add for Upper {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            other
        } else if other.is_zero() {
            self
        } else {
            Self((self.0 + other.0).next_up())
        }
    }
}

impl Mul for Upper {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            Self::ZERO
        } else if self == Self::ONE {
            other
        } else if other == Self::ONE {
            self
        } else {
            Self((self.0 * other.0).next_up())
        }
    }
}

impl Sum for Upper {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use dashu_float::{FBig, round::mode::Down};
    use dashu_ratio::RBig;
    use proptest::prelude::*;

    use super::Upper;

    fn exact(value: f64) -> RBig {
        RBig::try_from(value).unwrap()
    }

    proptest! {
        #[test]
        fn verify_no_operation_rounds_down(a in 0.0f64..1e3, b in 1e-9f64..1e-3, c in 0.0f64..3.0) {
            let [x, y, z] = [a, b, c].map(Upper::exact);
            prop_assert!(exact((x + y).get()) >= exact(a) + exact(b));
            prop_assert!(exact((x * y).get()) >= exact(a) * exact(b));
            prop_assert!(exact(y.half().get()) * RBig::from(2) >= exact(b));
            let square = exact(a) * exact(a) + exact(b) * exact(b) + exact(c) * exact(c);
            let norm = exact(Upper::norm([x, y, z]).get());
            prop_assert!(&norm * &norm >= square);
            // The exponential, against one rounded down at 100 bits; and it is not much larger.
            let reference = FBig::<Down, 2>::try_from(c).unwrap().with_precision(100).value().exp();
            let ratio = z.exp().get() / reference.to_f64().value();
            prop_assert!((1.0..1.01).contains(&ratio), "{ratio}");
        }
    }
}
