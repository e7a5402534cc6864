//! Vectors and matrices of values, and how a turn about a coordinate axis acts on them.

use model_core::Axis;

use crate::builder::{Builder, Value};

/// Three components.
pub(super) type Vector = [Value; 3];
/// Three rows of three.
pub(super) type Matrix = [[Value; 3]; 3];

/// The vector of zeros.
pub(super) const NOTHING: Vector = [Builder::ZERO; 3];

/// The two axes that a turn about an axis moves, in right-handed order.
pub(super) fn others(axis: Axis) -> (usize, usize) {
    ((axis.index() + 1) % 3, (axis.index() + 2) % 3)
}

/// A vector along an axis.
pub(super) fn along(axis: Axis, length: Value) -> Vector {
    let mut vector = NOTHING;
    vector[axis.index()] = length;
    vector
}

/// `a × v` for the unit vector of an axis.
pub(super) fn axis_cross(axis: Axis, v: &Vector) -> Vector {
    let (j, k) = others(axis);
    let mut product = NOTHING;
    product[j] = -v[k];
    product[k] = v[j];
    product
}

pub(super) fn add(b: &mut Builder, u: &Vector, v: &Vector) -> Vector {
    std::array::from_fn(|i| b.add(u[i], v[i]))
}

/// `u × v`
pub(super) fn cross(b: &mut Builder, u: &Vector, v: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        b.dot([(u[j], v[k]), (-u[k], v[j])])
    })
}

/// `M v + t`
pub(super) fn affine(b: &mut Builder, m: &Matrix, v: &Vector, t: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let turned = b.dot(m[i].into_iter().zip(*v));
        b.add(turned, t[i])
    })
}

/// `L M`
pub(super) fn product(b: &mut Builder, l: &Matrix, m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| b.dot((0..3).map(|k| (l[i][k], m[k][j])))))
}

pub(super) fn matrix_add(b: &mut Builder, l: &Matrix, m: &Matrix) -> Matrix {
    std::array::from_fn(|i| add(b, &l[i], &m[i]))
}

/// Sine and cosine of a turn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Turn {
    pub(super) sin: Value,
    pub(super) cos: Value,
}

impl Turn {
    /// The turn by the opposite angle.
    pub(super) fn back(self) -> Self {
        Self { sin: -self.sin, ..self }
    }

    /// `R v`
    pub(super) fn apply(self, b: &mut Builder, axis: Axis, v: &Vector) -> Vector {
        let (j, k) = others(axis);
        let mut turned = *v;
        turned[j] = b.dot([(self.cos, v[j]), (-self.sin, v[k])]);
        turned[k] = b.dot([(self.sin, v[j]), (self.cos, v[k])]);
        turned
    }
}
