//! Nodes and weights for means over an interval.

use std::f64::consts::{PI, TAU};

/// One node of a rule; the weights of a rule sum to one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub at: f64,
    pub weight: f64,
}

/// A rule of `count` nodes for the mean over an interval: equal steps over a full turn, where they are exact for
/// trigonometric polynomials of a degree below `count`; Gauss-Legendre elsewhere.
pub(super) fn rule(low: f64, high: f64, count: usize) -> Vec<Node> {
    let width = high - low;
    if width == 0.0 {
        return vec![Node { at: low, weight: 1.0 }];
    }
    if is_turn(low, high) {
        let weight = 1.0 / count as f64;
        return (0..count).map(|k| Node { at: low + width * (k as f64 + 0.5) * weight, weight }).collect();
    }
    gauss_legendre(count)
        .into_iter()
        .map(|node| Node { at: low + width * (1.0 + node.at) / 2.0, weight: node.weight })
        .collect()
}

/// A rule for the mean of squares of waves over an interval.
pub(super) struct Rule {
    low: f64,
    high: f64,
    kind: Kind,
}

/// How many nodes, and which.
enum Kind {
    /// One rule of so many nodes: see [`rule`].
    Whole(usize),
    /// So many panels of eight nodes.
    Panels(f64),
}

/// Nodes in a panel.
const IN_PANEL: usize = 8;

impl Rule {
    /// For waves up to a multiple of the angle, with at least so many nodes.
    pub fn for_squares(low: f64, high: f64, harmonic: u32, least: usize) -> Self {
        /// More waves than these go into panels, as rules of many nodes take long to find.
        const IN_ONE_RULE: f64 = 10.0;
        let waves = f64::from(harmonic) * (high - low) / TAU;
        let kind = if is_turn(low, high) && waves < 1e6 {
            Kind::Whole(least.max(2 * waves.round() as usize + 1))
        } else if waves <= IN_ONE_RULE {
            Kind::Whole(least.max(gauss_nodes(TAU * waves)))
        } else {
            // Squares have twice as many waves, and a panel does half of one to ten digits.
            Kind::Panels((4.0 * waves).ceil())
        };
        Self { low, high, kind }
    }

    /// How many nodes it has.
    pub fn len(&self) -> usize {
        match self.kind {
            Kind::Whole(_) if self.low == self.high => 1,
            Kind::Whole(count) => count,
            Kind::Panels(panels) => panels as usize * IN_PANEL,
        }
    }

    /// The nodes.
    pub fn nodes(&self) -> Vec<Node> {
        match self.kind {
            Kind::Whole(count) => rule(self.low, self.high, count),
            Kind::Panels(count) => panels(self.low, self.high, count as usize, IN_PANEL),
        }
    }
}

/// How many nodes a Gauss-Legendre rule needs for cos kx on (−1, 1) to six digits.
///
/// Source: its error is about (e k/4n)²ⁿ, by the term of degree 2n of the cosine's series.
fn gauss_nodes(k: f64) -> usize {
    let is_enough = |n: &usize| {
        let n = *n as f64;
        (std::f64::consts::E * k / (4.0 * n)).powf(2.0 * n) < 1e-6
    };
    (1..1000).find(is_enough).unwrap_or(1000)
}

fn is_turn(low: f64, high: f64) -> bool {
    let turns = (high - low) / TAU;
    turns.round() >= 1.0 && ((turns.round() - turns) * TAU).abs() < 1e-9
}

/// Equal panels of Gauss-Legendre rules, for a function of which nothing but smoothness is known.
pub(super) fn panels(low: f64, high: f64, panels: usize, count: usize) -> Vec<Node> {
    let width = (high - low) / panels as f64;
    let inside = gauss_legendre(count);
    (0..panels)
        .flat_map(|panel| {
            let start = low + width * panel as f64;
            inside.iter().map(move |node| Node {
                at: start + width * (1.0 + node.at) / 2.0,
                weight: node.weight / panels as f64,
            })
        })
        .collect()
}

/// The Gauss-Legendre rule on (−1, 1), in ascending order.
///
/// Source: Newton's iteration on the Legendre polynomial from Chebyshev-like starts; weights 2/((1 − x²) Pₙ'(x)²), here
/// halved so that they sum to one.
fn gauss_legendre(count: usize) -> Vec<Node> {
    let n = count as f64;
    (0..count)
        .rev()
        .map(|k| {
            let mut x = (PI * (k as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut before, mut last) = (1.0, x);
                for degree in 2..=count {
                    let d = degree as f64;
                    (before, last) = (last, ((2.0 * d - 1.0) * x * last - (d - 1.0) * before) / d);
                }
                slope = n * (x * last - before) / (x * x - 1.0);
                let step = last / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            Node { at: x, weight: 1.0 / ((1.0 - x * x) * slope * slope) }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(nodes: &[Node], f: impl Fn(f64) -> f64) -> f64 {
        nodes.iter().map(|node| node.weight * f(node.at)).sum()
    }

    #[test]
    fn gauss_legendre_is_exact_for_polynomials() {
        let nodes = rule(-1.0, 3.0, 5);
        // The mean of x⁹ over (−1, 3) is (3¹⁰ − 1)/40.
        approx::assert_relative_eq!(
            mean(&nodes, |x| x.powi(9)),
            (3f64.powi(10) - 1.0) / 40.0,
            epsilon = 1e-9
        );
        approx::assert_relative_eq!(mean(&panels(0.0, 2.0, 3, 4), |x| x.powi(7)), 16.0, epsilon = 1e-12);
        approx::assert_relative_eq!(mean(&rule(0.0, 1.0, 1), |x| x), 0.5, epsilon = 1e-15);
    }

    #[test]
    fn equal_steps_are_exact_for_waves_over_a_full_turn() {
        let nodes = rule(0.0, TAU, 5);
        approx::assert_relative_eq!(mean(&nodes, |x| (2.0 * x).cos().powi(2)), 0.5, epsilon = 1e-15);
    }
}
