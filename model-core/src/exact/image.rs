//! Image points in numbers, with what the errors add kept apart: no digit of that is lost, however small the errors are.

use super::{Parts, Split};
use crate::chain::image::{Field, INTRINSICS, Image, project};

/// A number without errors, what the errors add to it in first order, and what else they add.
#[derive(Debug, Clone, Copy)]
pub(super) struct Graded {
    pub nominal: f64,
    pub first: f64,
    pub rest: f64,
}

impl Graded {
    /// All that the errors add.
    pub fn error(self) -> f64 {
        self.first + self.rest
    }

    /// The number with errors.
    pub fn value(self) -> f64 {
        self.nominal + self.error()
    }
}

impl Field for Graded {
    type With<'a> = ();

    fn plus(self, other: Self, (): &mut ()) -> Self {
        Self {
            nominal: self.nominal + other.nominal,
            first: self.first + other.first,
            rest: self.rest + other.rest,
        }
    }

    /// (a + δ)(b + ε) = ab + (aε + δb) + …, each of the two by degree.
    fn times(self, other: Self, (): &mut ()) -> Self {
        Self {
            nominal: self.nominal * other.nominal,
            first: self.nominal * other.first + self.first * other.nominal,
            rest: self.nominal * other.rest + self.rest * other.nominal + self.error() * other.error(),
        }
    }

    /// With q = a/b, what is added is (δ − qε)/(b + ε), and of that (δ₁ − qε₁)/b in first order.
    fn over(self, other: Self, (): &mut ()) -> Self {
        let nominal = self.nominal / other.nominal;
        let first = (self.first - nominal * other.first) / other.nominal;
        let rest = (self.rest - nominal * other.rest - first * other.error()) / other.value();
        Self { nominal, first, rest }
    }
}

/// The numbers of a camera, each split by degree in the errors.
pub(super) type Intrinsics = [Split; INTRINSICS];

/// The numbers of a camera, split.
pub(super) fn split(image: &Image, split: impl Fn(&crate::algebra::Poly) -> Split) -> Intrinsics {
    image.intrinsics.each_ref().map(split)
}

/// A component of a point.
pub(super) fn component(point: &Parts, axis: usize) -> Graded {
    Graded { nominal: point.nominal[axis], first: point.first[axis], rest: point.rest[axis] }
}

/// Where the camera sees a point of its frame.
pub(super) fn seen(point: &Parts, intrinsics: &Intrinsics, values: &[f64]) -> [Graded; 2] {
    let number = |split: &Split| {
        let [nominal, first, rest] =
            [&split.nominal, &split.linear, &split.beyond].map(|part| part.eval(values));
        Graded { nominal, first, rest }
    };
    project([0, 1, 2].map(|axis| component(point, axis)), &intrinsics.each_ref().map(number), &mut ())
}
