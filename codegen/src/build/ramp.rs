//! Ramps: their values and their derivatives.
//!
//! With `f = (x − from)/(to − from)`, a ramp is `f` between 0 and 1 and the nearer of the two outside. Its derivative
//! is that of `f` where `0 ≤ f < 1`, and 0 elsewhere; that of a step is 0 everywhere.

use model_core::SymbolId;
use model_core::ramp::Ramp;

use super::amount::lower;
use crate::builder::{Builder, Value};

/// The value of a ramp.
pub(crate) fn ramp(b: &mut Builder, ramp: &Ramp) -> Value {
    let fraction = fraction(b, ramp);
    if ramp.is_step() { b.step(fraction) } else { b.saturate(fraction) }
}

/// The derivative of a ramp with respect to its variable or to a constant in its thresholds.
pub(super) fn slope(b: &mut Builder, ramp: &Ramp, symbol: SymbolId) -> Value {
    if ramp.is_step() {
        return Builder::ZERO;
    }
    let fraction = fraction(b, ramp);
    // f' = (x' − from' − f (to − from)')/(to − from)
    let width = width(b, ramp);
    let own = if ramp.of == symbol { Builder::ONE } else { Builder::ZERO };
    let from_rate = lower(b, &ramp.from.derivative(symbol));
    let width_rate = lower(b, &(&ramp.to - &ramp.from).derivative(symbol));
    let shift = b.sub(own, from_rate);
    let stretch = b.mul(fraction, width_rate);
    let above = b.sub(shift, stretch);
    let rate = b.div(above, width);
    let behind = b.sub(fraction, Builder::ONE);
    let (begun, ended) = (b.step(fraction), b.step(behind));
    let within = b.sub(begun, ended);
    b.mul(rate, within)
}

/// How far the variable is from the first threshold to the second; for a step, how far it is beyond its threshold.
fn fraction(b: &mut Builder, ramp: &Ramp) -> Value {
    let (at, from) = (b.symbol(ramp.of), lower(b, &ramp.from));
    let distance = b.sub(at, from);
    if ramp.is_step() {
        return distance;
    }
    let width = width(b, ramp);
    b.div(distance, width)
}

fn width(b: &mut Builder, ramp: &Ramp) -> Value {
    let (from, to) = (lower(b, &ramp.from), lower(b, &ramp.to));
    b.sub(to, from)
}
