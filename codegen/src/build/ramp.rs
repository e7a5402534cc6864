//! The derivatives of ramps.
//!
//! With `f = (x − from)/(to − from)`, a ramp is `f` between 0 and 1 and the nearer of the two outside. Its derivative
//! is that of `f` where `0 ≤ f < 1`, and 0 elsewhere; that of a step is 0 everywhere.

use model_core::SymbolId;
use model_core::ramp::Ramp;

use super::amount::{lower, ramp_fraction, ramp_width};
use crate::builder::{Builder, Value};

/// The derivative of a ramp with respect to its variable or to a constant in its thresholds.
pub(super) fn slope(b: &mut Builder, ramp: &Ramp, symbol: SymbolId) -> Value {
    if ramp.is_step() {
        return Builder::ZERO;
    }
    let fraction = ramp_fraction(b, ramp);
    // f' = (x' − from' − f (to − from)')/(to − from)
    let width = ramp_width(b, ramp);
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
