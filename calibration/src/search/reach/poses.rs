//! Poses further out than those of the data: each joint by itself over its range and half of that on either side.

use std::f64::consts::TAU;
use std::ops::Range;

use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use observe::{Poses, Series};

/// How far each joint's range is widened on either side, as a share of it.
const WIDENED: f64 = 0.5;

/// About so many poses, shared evenly among the series. Joints are uniform over their widened ranges, at most a turn, within
/// `limits` where those leave room around the data; inputs are those of some row of the data.
pub(crate) fn further_out(
    chain: &Chain,
    poses: &Poses,
    limits: &[(SymbolId, Range<f64>)],
    count: usize,
    seed: u64,
) -> Poses {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let watched: Vec<&Series> = poses.series.iter().filter(|series| !series.rows.is_empty()).collect();
    let each = count.div_ceil(watched.len().max(1));
    let mut from = Vec::new();
    let mut series = Vec::new();
    for own in watched {
        let start = from.len();
        from.extend((0..each).map(|_| random.random_range(own.rows.clone())));
        series.push(Series { rows: start..from.len(), measure: own.measure.bare(), ..own.clone() });
    }
    let columns = poses.columns.iter().map(|(id, readings)| {
        let symbol = chain.symbol(*id);
        if symbol.kind != SymbolKind::Joint {
            return (*id, from.iter().map(|&row| readings[row]).collect());
        }
        let limit = limits.iter().find(|(limited, _)| limited == id).map(|(_, limit)| limit.clone());
        let range = within(widened(readings), readings, symbol.quantity, limit);
        let mut drawn = || range.start + (range.end - range.start) * random.random_range(0.0..1.0);
        (*id, from.iter().map(|_| drawn()).collect())
    });
    let columns = columns.collect();
    Poses { series, columns }
}

/// The range of some readings and half of it on either side.
pub(super) fn widened(readings: &[f64]) -> Range<f64> {
    let (low, high) = ends(readings);
    low - WIDENED * (high - low)..high + WIDENED * (high - low)
}

/// What of a widened range lies within a turn and within limits; the readings themselves always do.
fn within(wide: Range<f64>, readings: &[f64], quantity: Quantity, limit: Option<Range<f64>>) -> Range<f64> {
    let (low, high) = ends(readings);
    let mut half = (wide.end - wide.start) / 2.0;
    if quantity == Quantity::Angle {
        half = half.min((TAU / 2.0).max((high - low) / 2.0));
    }
    let middle = low.midpoint(high);
    match limit {
        Some(limit) => (middle - half).max(limit.start.min(low))..(middle + half).min(limit.end.max(high)),
        None => middle - half..middle + half,
    }
}

fn ends(readings: &[f64]) -> (f64, f64) {
    let low = readings.iter().copied().fold(f64::INFINITY, f64::min);
    (low, readings.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn within_of(readings: &[f64], quantity: Quantity, limit: Option<Range<f64>>) -> Range<f64> {
        within(widened(readings), readings, quantity, limit)
    }

    #[test]
    fn ranges_are_widened_within_limits_and_a_turn() {
        let close = |range: Range<f64>, low: f64, high: f64| {
            assert!((range.start - low).abs() < 1e-12 && (range.end - high).abs() < 1e-12, "{range:?}");
        };
        close(within_of(&[1.0, 2.0], Quantity::Length, None), 0.5, 2.5);
        close(within_of(&[-2.0, 2.0], Quantity::Angle, None), -TAU / 2.0, TAU / 2.0);
        close(within_of(&[1.0, 2.0], Quantity::Angle, Some(0.9..5.0)), 0.9, 2.5);
        // A limit narrower than the data does not forbid what was measured.
        close(within_of(&[1.0, 2.0], Quantity::Angle, Some(1.2..1.8)), 1.0, 2.0);
    }
}
