//! Ramps: functions of a joint or input that are 0 before one threshold, 1 behind another, and linear between.
//!
//! Each ramp that a chain uses is a symbol of its own, so that the algebra treats it as one more free variable. What
//! follows from that: two formulas that differ by a relation *between* ramps (a step is its own square, say) have
//! different canonical forms.

use crate::algebra::Poly;
use crate::symbol::SymbolId;

/// A ramp of one chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// The symbol that stands for it in amounts; its value is without unit, from 0 to 1.
    pub symbol: SymbolId,
    /// The joint or input that it is a function of.
    pub of: SymbolId,
    /// Where it is still 0; a polynomial in π and constants, SI.
    pub from: Poly,
    /// Where it becomes 1. Below `from`, the ramp rises as its variable falls; equal to it, the ramp is a step.
    pub to: Poly,
}

impl Ramp {
    /// Whether it jumps: 0 below its threshold, 1 at it and beyond.
    #[must_use]
    pub fn is_step(&self) -> bool {
        self.from == self.to
    }

    /// The value where the symbols have these values, by [`SymbolId`], SI.
    #[must_use]
    pub fn value(&self, values: &[f64]) -> f64 {
        let at = values.get(self.of.index()).copied().unwrap_or(f64::NAN);
        if self.is_step() {
            step(at - self.from.eval(values))
        } else {
            let (from, to) = (self.from.eval(values), self.to.eval(values));
            saturated((at - from) / (to - from))
        }
    }

    /// The symbols that its value depends on.
    pub fn depends_on(&self) -> impl Iterator<Item = SymbolId> {
        std::iter::once(self.of).chain(self.from.symbols()).chain(self.to.symbols())
    }
}

/// `fraction` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
#[must_use]
#[inline]
pub fn saturated(fraction: f64) -> f64 {
    fraction.clamp(0.0, 1.0)
}

/// 1 from zero on, 0 below; NaN stays NaN.
#[must_use]
#[inline]
pub fn step(distance: f64) -> f64 {
    if distance >= 0.0 {
        1.0
    } else if distance < 0.0 {
        0.0
    } else {
        distance
    }
}
