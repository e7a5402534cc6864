//! What turns can do at all: bounds that hold for errors of any size, because a product of rotations keeps lengths.
//!
//! With A = Σ|eᵢ| over the rotations before a vector v of the chain, P their product along the ray t·e: the n-th derivative
//! of P has a norm of at most Aⁿ, so that what P has beyond degree n − 1 is at most Aⁿ/n!; and no turn moves v by more than
//! 2|v|. The derivation is in the book, page "Remainder".

use super::cluster::{Cluster, Element};
use super::quadratic::Amount;
use super::upper::Upper;

/// Bounds on what all errors together do to the vector of an observable.
#[derive(Debug, Default)]
pub(super) struct Isometry {
    /// Of degree three and more; none where an amount has products of errors.
    pub(super) tail: Option<Upper>,
    /// Beyond the first order.
    pub(super) remainder: Upper,
    /// Everything.
    pub(super) moved: Upper,
}

/// Vectors behind the same rotations, by axis of the cluster's frame.
#[derive(Default)]
struct Run {
    nominal: [Upper; 3],
    first: [Upper; 3],
    second: [Upper; 3],
    tail: [Upper; 3],
}

impl Run {
    fn add(&mut self, axis: usize, amount: &Amount) {
        let parts = [
            (&mut self.nominal, amount.nominal),
            (&mut self.first, amount.first.sum),
            (&mut self.second, amount.second_sum()),
            (&mut self.tail, amount.tail),
        ];
        for (sum, part) in parts {
            sum[axis] = sum[axis] + part;
        }
    }
}

impl Isometry {
    pub(super) fn of(clusters: &[Cluster]) -> Self {
        let mut bounds = Self { tail: Some(Upper::ZERO), ..Self::default() };
        let (mut turned, mut beyond) = (Upper::ZERO, Upper::ZERO);
        for cluster in clusters {
            let mut run = Run::default();
            for element in &cluster.elements {
                match element {
                    Element::Vector(axis, amount) => run.add(*axis, amount),
                    Element::Rotation(_, amount) => {
                        bounds.add(&std::mem::take(&mut run), turned, beyond);
                        let later = amount.second_sum() + amount.tail;
                        turned = turned + amount.first.sum + later;
                        beyond = beyond + later;
                    }
                }
            }
            bounds.add(&run, turned, beyond);
        }
        bounds
    }

    fn add(&mut self, run: &Run, turned: Upper, beyond: Upper) {
        let two = Upper::exact(2.0);
        let [nominal, first, second, tail] = [run.nominal, run.first, run.second, run.tail].map(Upper::norm);
        let square = (turned * turned).half();
        let most = turned.min(two);
        self.moved = self.moved + most * nominal + first + second + tail;
        let two_and_more = square.min(most + turned);
        self.remainder = self.remainder + (two_and_more + beyond) * nominal + most * first + second + tail;
        self.tail = self.tail.filter(|_| beyond.is_zero()).map(|sum| {
            let sixth = Upper::rounded(1.0 / 6.0);
            sum + turned.powi(3) * sixth * nominal + square * first + most * second + tail
        });
    }
}
