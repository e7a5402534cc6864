//! A function of the pose summed up: largest value, where it is taken, root mean square.

use super::poses::{Pose, Space};

/// How an influence is measured over poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The largest value.
    Sup,
    /// The root mean square.
    Rms,
}

/// An influence over a set of poses, rad or m.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The largest value that was found: at the nodes of the rule, and uphill from the best of them.
    pub sup: f64,
    /// The parameters at which it was found: `t` of a path, or joints and inputs in the order of the chain, SI.
    pub at: Vec<f64>,
    /// The root mean square.
    pub rms: f64,
}

impl Summary {
    /// One of the two numbers.
    #[must_use]
    pub fn size(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Sup => self.sup,
            Measure::Rms => self.rms,
        }
    }
}

/// Nodes from which the search goes uphill.
const STARTS: usize = 4;
/// Where the search stops: this fraction of the range. Near a maximum the value is flat, so that it is then right to
/// about the square of this.
const RESOLUTION: f64 = 1e-7;

/// What is kept of a function that is sampled node by node: of many functions at many nodes the values would not fit memory.
#[derive(Debug, Clone, Default)]
pub(super) struct Sampled {
    mean_square: f64,
    /// The largest values with their nodes, the largest first.
    largest: Vec<(f64, usize)>,
}

impl Sampled {
    /// Takes the value at a node, whose number is higher than those before.
    pub fn add(&mut self, number: usize, node: &Pose, value: f64) {
        self.mean_square += node.weight * value * value;
        let place = self.largest.partition_point(|(larger, _)| *larger >= value);
        if place < STARTS {
            self.largest.truncate(STARTS - 1);
            self.largest.insert(place, (value, number));
        }
    }

    /// Sums up the function, which climbs on from its largest values.
    pub fn summarise(
        &self,
        space: &Space<'_>,
        nodes: &[Pose],
        mut function: impl FnMut(&[f64]) -> f64,
    ) -> Summary {
        let mut best = (0.0, nodes.first().map_or_else(Vec::new, |node| node.parameters.clone()));
        for &(value, start) in &self.largest {
            let (value, at) = climb(space, &nodes[start].parameters, value, &mut function);
            if value > best.0 {
                best = (value, at);
            }
        }
        Summary { sup: best.0, at: best.1, rms: self.mean_square.sqrt() }
    }
}

/// Compass search: a step along each parameter while it leads uphill, then half the step.
fn climb(
    space: &Space<'_>,
    start: &[f64],
    value: f64,
    function: &mut impl FnMut(&[f64]) -> f64,
) -> (f64, Vec<f64>) {
    let mut at = start.to_vec();
    let mut value = value;
    let mut fraction = 1.0;
    let widest = (0..at.len()).map(|axis| space.spacing(axis)).fold(0.0, f64::max);
    let finest = space.bounds.iter().map(|(low, high)| high - low).fold(0.0, f64::max) * RESOLUTION;
    while widest * fraction > finest {
        let mut moved = false;
        for axis in 0..at.len() {
            let (low, high) = space.bounds[axis];
            for direction in [1.0, -1.0] {
                let mut next = at.clone();
                next[axis] = (next[axis] + direction * fraction * space.spacing(axis)).clamp(low, high);
                let there = function(&next);
                if there > value {
                    (value, at, moved) = (there, next, true);
                    break;
                }
            }
        }
        if !moved {
            fraction /= 2.0;
        }
    }
    (value, at)
}
