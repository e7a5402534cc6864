//! What the errors of one cluster add up to, by axis of its frame: one pass over its elements, however many there are.

use super::cluster::{Cluster, Element, across};
use super::quadratic::Amount;
use super::upper::Upper;

type ByAxis = [Upper; 3];

/// Bounds on the parts of degree one and two of a cluster, by axis.
#[derive(Debug, Clone, Default)]
pub(super) struct Sums {
    /// The vectors, degree one: θ × v₀ + v₁.
    pub(super) first: ByAxis,
    /// The vectors, degree two: θ × v₁ + v₂ and the second order of the rotations of v₀.
    pub(super) second: ByAxis,
    /// The rotation vector, degree one.
    pub(super) turned: ByAxis,
    /// Half the cross products of rotations in order.
    pub(super) crosses: ByAxis,
    /// The parts of degree two of the rotations' amounts.
    pub(super) amounts: ByAxis,
}

impl Sums {
    /// Of a cluster alone, and together with a vector behind it, of which the size along each axis is known.
    pub(super) fn of(cluster: &Cluster, behind: [Upper; 3]) -> [Self; 2] {
        let mut sums = Self::default();
        // Products of two rotations so far, by the axis of the earlier and of the later one; squares count half.
        let mut pairs = [[Upper::ZERO; 3]; 3];
        for element in &cluster.elements {
            match element {
                Element::Rotation(axis, amount) => {
                    let size = amount.first.sum;
                    for (about, pairs) in pairs.iter_mut().enumerate() {
                        let both = sums.turned[about] * size;
                        pairs[*axis] = pairs[*axis] + both;
                        if let Some(target) = across(about, *axis) {
                            sums.crosses[target] = sums.crosses[target] + both.half();
                        }
                    }
                    pairs[*axis][*axis] = pairs[*axis][*axis] + (size * size).half();
                    sums.turned[*axis] = sums.turned[*axis] + size;
                    sums.amounts[*axis] = sums.amounts[*axis] + amount.second_sum();
                }
                Element::Vector(axis, vector) => sums.add(*axis, vector, &pairs),
            }
        }
        let mut whole = sums.clone();
        for (axis, nominal) in behind.into_iter().enumerate() {
            whole.add(axis, &Amount { nominal, ..Amount::default() }, &pairs);
        }
        [sums, whole]
    }

    /// A vector along an axis, behind the rotations so far.
    fn add(&mut self, axis: usize, vector: &Amount, pairs: &[ByAxis; 3]) {
        self.first[axis] = self.first[axis] + vector.first.sum;
        self.second[axis] = self.second[axis] + vector.second_sum();
        for about in 0..3 {
            let Some(target) = across(about, axis) else { continue };
            let turned = self.turned[about];
            self.first[target] = self.first[target] + vector.nominal * turned;
            self.second[target] =
                self.second[target] + turned * vector.first.sum + vector.nominal * self.amounts[about];
        }
        for (about, pairs) in pairs.iter().enumerate() {
            for (inner, &both) in pairs.iter().enumerate() {
                if let Some(target) = across(inner, axis).and_then(|turned| across(about, turned)) {
                    self.second[target] = self.second[target] + vector.nominal * both;
                }
            }
        }
    }

    /// A bound on the rotation of the cluster, degree two.
    pub(super) fn rotation(&self) -> Upper {
        let [turned, crosses, amounts] = [self.turned, self.crosses, self.amounts].map(Upper::norm);
        (turned * turned).half() + crosses + amounts
    }
}
