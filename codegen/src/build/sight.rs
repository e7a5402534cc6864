//! The derivatives of angles between lines of sight and up.

use model_core::SymbolId;
use model_core::chain::sight::SightAngle;

use super::amount::{lower, sight_turn};
use crate::builder::{Builder, Value};

/// The derivative of an angle with respect to a joint or constant that it follows from: with c its cosine, −c'/sin.
pub(super) fn sight_slope(b: &mut Builder, angle: &SightAngle, symbol: SymbolId) -> Value {
    let rate = lower(b, &angle.cosine.derivative(symbol));
    let turn = sight_turn(b, angle);
    let slope = b.div(rate, turn.sin);
    -slope
}
