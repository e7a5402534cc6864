//! Clusters: runs of errors on the way from the ground to the device with no joint turning between them.
//!
//! Inside a cluster every rotation axis is a coordinate axis of one frame, whatever the joints do, so that errors add
//! as vectors there, and not as lengths. Between clusters stand rotations by joints and constants, which keep lengths.

use super::domain::{Domain, DomainError};
use super::interval::Interval;
use super::quadratic::{Amount, Linear, Quadratic};
use super::reach::Turn;
use super::upper::Upper;
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Chain, ObservableId, ObservableKind, TransformKind};
use crate::forms::error_table;
use crate::symbol::SymbolId;

/// A rotation by a small amount, or a vector to be carried to the ground, along an axis of the cluster's frame.
#[derive(Debug)]
pub(super) enum Element {
    Rotation(usize, Amount),
    Vector(usize, Amount),
}

/// Elements from the ground side to the device side.
#[derive(Debug, Default)]
pub(super) struct Cluster {
    pub(super) elements: Vec<Element>,
    /// How the next one is turned against it; the last has none.
    pub(super) turn: Option<Turn>,
}

/// The clusters of an observable, from the ground up; its own vector ends the last one.
pub(super) fn clusters(
    chain: &Chain,
    id: ObservableId,
    domain: &Domain,
) -> Result<Vec<Cluster>, DomainError> {
    let is_error = error_table(chain);
    let observable = chain.observable(id);
    let mut clusters = vec![];
    let mut cluster = Cluster::default();
    // Which axis of the cluster's frame each local axis lies along; directions do not matter for bounds.
    let mut frame = [0, 1, 2];
    for factor in chain.way(id).into_iter().map(|passed| passed.factor) {
        let axis = factor.axis.index();
        match factor.kind {
            TransformKind::Translation if observable.kind == ObservableKind::Direction => {}
            TransformKind::Translation => {
                let amount = Amount::new(chain, &factor.amount, &is_error, domain)?;
                cluster.elements.push(Element::Vector(frame[axis], amount));
            }
            TransformKind::Rotation => {
                let nominal = factor.amount.graded_part(|symbol| is_error[symbol.index()], 0);
                if !nominal.is_zero() {
                    match odd_quarter_turns(&nominal) {
                        Some(true) => frame.swap((axis + 1) % 3, (axis + 2) % 3),
                        Some(false) => {}
                        None => {
                            // What has no range turns freely.
                            let free = |_| Interval::new(Interval::turn());
                            let angle = domain.enclose(chain, &nominal).unwrap_or_else(free);
                            cluster.turn = Some(Turn::new(frame, axis, angle));
                            clusters.push(std::mem::take(&mut cluster));
                            frame = [0, 1, 2];
                        }
                    }
                }
                let error = &factor.amount - &nominal;
                if !error.is_zero() {
                    let amount = Amount::new(chain, &error, &is_error, domain)?;
                    cluster.elements.push(Element::Rotation(frame[axis], amount));
                }
            }
        }
    }
    for (axis, component) in frame.into_iter().zip(&observable.components) {
        let amount = Amount::new(chain, component, &is_error, domain)?;
        cluster.elements.push(Element::Vector(axis, amount));
    }
    clusters.push(cluster);
    Ok(clusters)
}

/// Whether a nominal rotation is by an odd number of quarter turns; `None` if by anything but quarter turns.
fn odd_quarter_turns(nominal: &Poly) -> Option<bool> {
    let angle = AngleSum::from_poly(nominal).ok()?;
    angle.multiples().is_empty().then(|| Poly::cos(&angle).is_zero())
}

/// The axis across two different ones; `None` if they are the same: the cross product of coordinate axes.
pub(super) fn across(a: usize, b: usize) -> Option<usize> {
    (a != b).then(|| 3 - a - b)
}

impl Cluster {
    /// The rotations before a place among the elements.
    fn rotations(&self, before: usize) -> impl DoubleEndedIterator<Item = (usize, &Amount)> + Clone {
        self.elements[..before].iter().filter_map(|element| match element {
            Element::Rotation(axis, amount) => Some((*axis, amount)),
            Element::Vector(..) => None,
        })
    }

    fn all_rotations(&self) -> impl DoubleEndedIterator<Item = (usize, &Amount)> + Clone {
        self.rotations(self.elements.len())
    }

    /// Vectors, each with its place among the elements.
    fn vectors(&self) -> impl Iterator<Item = (usize, usize, &Amount)> {
        self.elements.iter().enumerate().filter_map(|(place, element)| match element {
            Element::Vector(axis, amount) => Some((place, *axis, amount)),
            Element::Rotation(..) => None,
        })
    }

    /// The vectors without errors, added up by axis.
    pub(super) fn nominal(&self) -> [Upper; 3] {
        let mut sum = [Upper::ZERO; 3];
        for (_, axis, amount) in self.vectors() {
            sum[axis] = sum[axis] + amount.nominal;
        }
        sum
    }

    /// The amounts of its elements.
    pub(super) fn amounts(&self) -> impl Iterator<Item = &Amount> {
        self.elements.iter().map(|element| match element {
            Element::Rotation(_, amount) | Element::Vector(_, amount) => amount,
        })
    }

    /// The same with the parts of some errors only.
    pub(super) fn only(&self, keep: impl Fn(SymbolId) -> bool + Copy) -> Self {
        let elements = self.elements.iter().map(|element| match element {
            Element::Rotation(axis, amount) => Element::Rotation(*axis, amount.only(keep)),
            Element::Vector(axis, amount) => Element::Vector(*axis, amount.only(keep)),
        });
        let is_there = |element: &Element| match element {
            Element::Rotation(_, amount) => !amount.is_zero(),
            Element::Vector(_, amount) => !amount.is_zero(),
        };
        Self { elements: elements.filter(is_there).collect(), turn: self.turn }
    }

    /// The part of degree one of the vectors in the cluster's frame, by axis: θ × v₀ + v₁.
    pub(super) fn first_order(&self) -> Vec<(usize, Upper, &Linear)> {
        let mut terms = Vec::new();
        for (place, axis, vector) in self.vectors() {
            terms.push((axis, Upper::ONE, &vector.first));
            if vector.nominal.is_zero() {
                continue;
            }
            for (about, rotation) in self.rotations(place) {
                if let Some(target) = across(about, axis) {
                    terms.push((target, vector.nominal, &rotation.first));
                }
            }
        }
        terms
    }

    /// The part of degree two of the vectors, by axis: θ × v₁ + v₂ and the second order of the rotations of v₀.
    pub(super) fn second_order(&self) -> Vec<(usize, Quadratic<'_>)> {
        let mut terms = Vec::new();
        for (place, axis, vector) in self.vectors() {
            terms.push((axis, Quadratic::Pairs { scale: Upper::ONE, pairs: &vector.second }));
            let mut later: Vec<(usize, &Amount)> = Vec::new();
            for (about, rotation) in self.rotations(place).rev() {
                if let Some(target) = across(about, axis) {
                    let (left, right) = (&rotation.first, &vector.first);
                    terms.push((target, Quadratic::Product { scale: Upper::ONE, left, right }));
                    terms.push((target, Quadratic::Pairs { scale: vector.nominal, pairs: &rotation.second }));
                }
                if vector.nominal.is_zero() {
                    continue;
                }
                // This rotation after a later one, and half of it twice.
                let left = &rotation.first;
                let twice = (about, rotation, vector.nominal.half());
                let pairs = later.iter().map(|&(about, amount)| (about, amount, vector.nominal));
                for (inner, other, scale) in pairs.chain([twice]) {
                    if let Some(target) = across(inner, axis).and_then(|turned| across(about, turned)) {
                        terms.push((target, Quadratic::Product { scale, left, right: &other.first }));
                    }
                }
                later.push((about, rotation));
            }
        }
        terms
    }

    /// The rotation vector of the whole cluster to first order, by axis.
    pub(super) fn rotation_vector(&self) -> Vec<(usize, Upper, &Linear)> {
        self.all_rotations().map(|(axis, amount)| (axis, Upper::ONE, &amount.first)).collect()
    }

    /// What the rotation of the cluster has in second order beside half the square of its rotation vector: half the
    /// cross products of the rotations in order, and the parts of degree two of their amounts; by axis.
    pub(super) fn commutators(&self) -> [Vec<(usize, Quadratic<'_>)>; 2] {
        let mut crosses = Vec::new();
        let mut amounts = Vec::new();
        for (index, (about, rotation)) in self.all_rotations().enumerate() {
            amounts.push((about, Quadratic::Pairs { scale: Upper::ONE, pairs: &rotation.second }));
            for (inner, other) in self.all_rotations().skip(index + 1) {
                if let Some(target) = across(about, inner) {
                    let scale = Upper::exact(0.5);
                    let (left, right) = (&rotation.first, &other.first);
                    crosses.push((target, Quadratic::Product { scale, left, right }));
                }
            }
        }
        [crosses, amounts]
    }
}
