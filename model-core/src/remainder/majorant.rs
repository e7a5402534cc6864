//! Majorant series: bounds by degree in the errors, for the tail beyond the second order.

use std::ops::Mul;

use super::upper::Upper;

/// Bounds on the parts of a function of the errors: of degree 0, 1 and 2, and on the sum of all higher ones.
///
/// For matrices the bounds are on operator norms, for vectors on lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Majorant {
    pub(super) degree: [Upper; 3],
    pub(super) tail: Upper,
}

impl Majorant {
    pub(super) const ONE: Self = Self { degree: [Upper::ONE, Upper::ZERO, Upper::ZERO], tail: Upper::ZERO };

    /// All degrees together.
    pub(super) fn total(&self) -> Upper {
        self.degree.iter().copied().sum::<Upper>() + self.tail
    }

    /// The rotation by an amount: its n-th power series term is bounded by (amount)ⁿ/n!, because the generator of a
    /// rotation has norm one. The amount has no part of degree 0.
    pub(super) fn rotation(amount: &Self) -> Self {
        let [_, first, second] = amount.degree;
        let size = first + second + amount.tail;
        let beyond_first = second + amount.tail;
        // Half the square, beyond degree 2, and Σ_{n≥3} sizeⁿ/n! ≤ size³/6 · e^size.
        let of_square = first * beyond_first + (beyond_first * beyond_first).half();
        let sixth = Upper::rounded(1.0 / 6.0);
        Self {
            degree: [Upper::ONE, first, second + (first * first).half()],
            tail: amount.tail + of_square + size.powi(3) * sixth * size.exp(),
        }
    }
}

impl Mul for &Majorant {
    type Output = Majorant;

    fn mul(self, other: &Majorant) -> Majorant {
        let (a, b) = (&self.degree, &other.degree);
        Majorant {
            degree: [a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0]],
            tail: self.tail * other.total()
                + (a[0] + a[1] + a[2]) * other.tail
                + a[1] * b[2]
                + a[2] * b[1]
                + a[2] * b[2],
        }
    }
}
