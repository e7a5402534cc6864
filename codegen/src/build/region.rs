//! The region that an instrument was measured in, as a number: 1 inside, 0 outside.

use std::f64::consts::PI;

use model_core::SymbolId;

use crate::builder::{Builder, Value};
use crate::vector::sin_cos;

/// The range of a joint or input that an instrument was measured over, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The joint or input.
    pub symbol: SymbolId,
    /// The smallest reading.
    pub low: f64,
    /// The largest reading.
    pub high: f64,
    /// Whether full turns of it are the same pose.
    pub turns: bool,
}

/// Readings are within a range to this part of it: what was written and read again is.
const SLACK: f64 = 1e-9;

/// Whether readings are within all ranges.
pub(super) fn inside(b: &mut Builder, ranges: &[Measured]) -> Value {
    let mut all = Builder::ONE;
    for range in ranges {
        let (low, high) = (range.low, range.high);
        let slack = SLACK * (high - low).max(low.abs()).max(high.abs());
        let reading = b.symbol(range.symbol);
        let edges: Vec<Value> = if range.turns {
            let half = (high - low) / 2.0 + slack;
            if half >= PI {
                continue;
            }
            // The cosine of the way to the middle of the range falls over half a turn, and does not count full ones.
            let (middle, edge) = (b.constant(low + (high - low) / 2.0), b.constant(sin_cos(half).1));
            let way = b.sub(reading, middle);
            let (_, cosine) = b.sin_cos(way);
            vec![b.sub(cosine, edge)]
        } else {
            let (low, high) = (b.constant(low - slack), b.constant(high + slack));
            vec![b.sub(reading, low), b.sub(high, reading)]
        };
        for edge in edges {
            let is_within = b.step(edge);
            all = b.mul(all, is_within);
        }
    }
    all
}
