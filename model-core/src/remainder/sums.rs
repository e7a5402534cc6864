//! What the errors of one cluster add up to, by axis of its frame: one pass over its elements, however many there are.

use super::cluster::{Cluster, Element, across};
use super::upper::Upper;

type ByAxis = [Upper; 3];

/// Bounds on the parts of degree one and two of a cluster, by axis.
#[derive(Debug, Default)]
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
    pub(super) fn of(cluster: &Cluster) -> Self {
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
                Element::Vector(axis, vector) => {
                    sums.first[*axis] = sums.first[*axis] + vector.first.sum;
                    sums.second[*axis] = sums.second[*axis] + vector.second_sum();
                    for about in 0..3 {
                        let Some(target) = across(about, *axis) else { continue };
                        let turned = sums.turned[about];
                        sums.first[target] = sums.first[target] + vector.nominal * turned;
                        sums.second[target] = sums.second[target]
                            + turned * vector.first.sum
                            + vector.nominal * sums.amounts[about];
                    }
                    for (about, pairs) in pairs.iter().enumerate() {
                        for (inner, &both) in pairs.iter().enumerate() {
                            if let Some(target) =
                                across(inner, *axis).and_then(|turned| across(about, turned))
                            {
                                sums.second[target] = sums.second[target] + vector.nominal * both;
                            }
                        }
                    }
                }
            }
        }
        sums
    }
}
