//! Means over full turns, and the highest multiples of angles: what the Fourier part of the canonical form says at once.

use super::atom::{Circle, Meaning};
use super::poly::Poly;
use crate::symbol::SymbolId;

impl Poly {
    /// The mean of the square while the chosen symbols make full turns, all of them independently: exact, because waves of
    /// different multiples are orthogonal, and 1/2 is the mean square of each. Everything else has its value from
    /// `values`, by [`SymbolId`], SI.
    ///
    /// `None` if a chosen symbol stands outside of sines and cosines, or in a denominator.
    #[must_use]
    pub fn mean_square_over_turns(&self, chosen: impl Fn(SymbolId) -> bool, values: &[f64]) -> Option<f64> {
        let mut sum = 0.0;
        for (function, factor) in self.split_by(chosen) {
            let mut weight = 1.0;
            for atom in function.atoms() {
                match atom.meaning() {
                    Meaning::Circle(Circle::Cos(_) | Circle::Sin(_)) => weight /= 2.0,
                    _ => return None,
                }
            }
            let factor = factor.eval(values);
            sum += weight * factor * factor;
        }
        Some(sum)
    }

    /// The highest multiple of a symbol in sines and cosines; a pole counts with its power.
    #[must_use]
    pub fn highest_harmonic(&self, symbol: SymbolId) -> u32 {
        let of_symbol = self.atoms.iter().filter(|atom| atom.symbol() == symbol && !atom.is_power());
        of_symbol.map(|atom| atom.number()).max().unwrap_or(0)
    }
}
