//! Whether readings are within the ranges that a model was found over.

use std::f64::consts::TAU;

use codegen::Measured;
use model_core::budget::spread;
use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind};

use crate::errors_file::FoundOver;
use crate::evaluation::{self, Evaluator, Exactness};
use crate::instrument::Instrument;
use crate::refusal::Refusal;

/// Readings are within a range to this part of it: what was written and read again is.
const SLACK: f64 = 1e-9;
/// Rows at which it is tried whether a full turn changes anything.
const TRIED: usize = 16;
/// Full turns change a unit vector, or a point in units of its distance, by less than this.
const SAME: f64 = 1e-9;

/// Counts rows outside the ranges that a model was found over.
pub struct Outside {
    ranges: Vec<Watched>,
    rows: usize,
    outside: usize,
}

/// What was counted of some rows: how many there are, how many are outside, and of each range how many are outside of it and by
/// how much at most, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Counted {
    /// All rows.
    pub rows: usize,
    /// Those outside of any range.
    pub outside: usize,
    /// Those outside of each range, and the farthest.
    pub ranges: Vec<(usize, f64)>,
}

struct Watched {
    found: FoundOver,
    /// Whether a full turn more is the same pose; known when the first rows were seen.
    turns: Option<bool>,
    outside: usize,
    farthest: f64,
}

impl Outside {
    /// Watches these ranges.
    pub fn new(found: Vec<FoundOver>) -> Self {
        let watched = |found| Watched { found, turns: None, outside: 0, farthest: 0.0 };
        Self { ranges: found.into_iter().map(watched).collect(), rows: 0, outside: 0 }
    }

    /// Looks at some rows, and says of each whether it is outside.
    ///
    /// # Errors
    /// The evaluator lacks a reading.
    pub fn see(
        &mut self,
        chain: &Chain,
        readings: &[(SymbolId, &[f64])],
        evaluator: &Evaluator,
    ) -> Result<Vec<bool>, Refusal> {
        let rows = readings.first().map_or(0, |(_, column)| column.len());
        self.rows += rows;
        let mut is_outside = vec![false; rows];
        for watched in &mut self.ranges {
            let Some((symbol, column)) = readings.iter().find(|(id, _)| *id == watched.found.symbol) else {
                continue;
            };
            let turns = match watched.turns {
                Some(turns) => turns,
                None => turns(chain, *symbol, readings, evaluator)?,
            };
            watched.turns = Some(turns);
            let (low, high) = (watched.found.low, watched.found.high);
            let slack = SLACK * (high - low).max(low.abs()).max(high.abs());
            for (value, is_outside) in column.iter().zip(&mut is_outside) {
                let by =
                    if turns { beside(*value, low, high) } else { (low - value).max(value - high).max(0.0) };
                if by > slack {
                    *is_outside = true;
                    watched.outside += 1;
                    watched.farthest = watched.farthest.max(by);
                }
            }
        }
        self.outside += is_outside.iter().filter(|is| **is).count();
        Ok(is_outside)
    }

    /// What was counted.
    #[must_use]
    pub fn counted(&self) -> Counted {
        let ranges = self.ranges.iter().map(|watched| (watched.outside, watched.farthest)).collect();
        Counted { rows: self.rows, outside: self.outside, ranges }
    }

    /// Adds what was counted of other rows, over the same ranges.
    pub fn add(&mut self, other: &Counted) {
        self.rows += other.rows;
        self.outside += other.outside;
        for (watched, &(outside, farthest)) in self.ranges.iter_mut().zip(&other.ranges) {
            watched.outside += outside;
            watched.farthest = watched.farthest.max(farthest);
        }
    }

    /// What to warn of, if rows were outside.
    #[must_use]
    pub fn warning(&self, chain: &Chain) -> Option<String> {
        if self.outside == 0 {
            return None;
        }
        let parts: Vec<String> = self
            .ranges
            .iter()
            .filter(|watched| watched.outside > 0)
            .map(|watched| {
                let symbol = chain.symbol(watched.found.symbol);
                let told = |value: f64| told(value, symbol.quantity);
                format!(
                    "{} by up to {} (found over {} to {})",
                    symbol.name,
                    told(watched.farthest),
                    told(watched.found.low),
                    told(watched.found.high)
                )
            })
            .collect();
        let verb = if self.outside == 1 { "is" } else { "are" };
        Some(format!(
            "{} of {} rows {verb} outside what the model was found over, where nothing confirms it: {}",
            self.outside,
            self.rows,
            parts.join("; ")
        ))
    }
}

/// How far an angle is from a range, full turns not counted.
fn beside(value: f64, low: f64, high: f64) -> f64 {
    if high - low >= TAU {
        return 0.0;
    }
    let above = (value - low).rem_euclid(TAU);
    if above <= high - low { 0.0 } else { (above - (high - low)).min(TAU - above) }
}

/// Whether a full turn more of a joint is the same pose.
fn turns(
    chain: &Chain,
    symbol: SymbolId,
    readings: &[(SymbolId, &[f64])],
    evaluator: &Evaluator,
) -> Result<bool, Refusal> {
    let declared = chain.symbol(symbol);
    if declared.kind != SymbolKind::Joint
        || declared.quantity != Quantity::Angle
        || !evaluator.readings.contains(&symbol)
    {
        return Ok(false);
    }
    let rows = readings.first().map_or(0, |(_, column)| column.len()).min(TRIED);
    let at = |turn: f64| {
        let moved: Vec<(SymbolId, Vec<f64>)> = readings
            .iter()
            .map(|&(id, column)| {
                let turn = if id == symbol { turn } else { 0.0 };
                (id, column[..rows].iter().map(|value| value + turn).collect())
            })
            .collect();
        let moved: Vec<(SymbolId, &[f64])> =
            moved.iter().map(|(id, column)| (*id, column.as_slice())).collect();
        evaluator.columns(&moved, rows)
    };
    let (here, there) = (at(0.0)?, at(TAU)?);
    let far =
        here.iter().flatten().map(|value| value.abs()).filter(|value| value.is_finite()).fold(1.0, f64::max);
    Ok(here
        .iter()
        .flatten()
        .zip(there.iter().flatten())
        .all(|(a, b)| (a - b).abs() <= SAME * far || a.is_nan()))
}

/// The measured region of an instrument for code that is generated of some observables.
///
/// # Errors
/// None that an instrument which was read has: its readings are all there.
pub fn region(instrument: &Instrument, observables: &[ObservableId]) -> Result<Vec<Measured>, Refusal> {
    let chain = &instrument.chain;
    let quantity = evaluation::Quantity::Value;
    let evaluator =
        Evaluator::new(chain, observables.to_vec(), Exactness::Exact, quantity, &instrument.values);
    let bounds: Vec<(f64, f64)> = evaluator
        .readings
        .iter()
        .map(|&id| match instrument.found.iter().find(|found| found.symbol == id) {
            Some(found) => (found.low, found.high),
            // Any readings do where none are known.
            None => (1.0, 2.0),
        })
        .collect();
    let poses: Vec<Vec<f64>> = spread(&bounds, TRIED).collect();
    let column = |at: usize| -> Vec<f64> { poses.iter().map(|pose| pose[at]).collect() };
    let columns: Vec<Vec<f64>> = (0..bounds.len()).map(column).collect();
    let readings: Vec<(SymbolId, &[f64])> =
        evaluator.readings.iter().copied().zip(columns.iter().map(Vec::as_slice)).collect();
    let measured = instrument.found.iter().filter(|found| evaluator.readings.contains(&found.symbol));
    measured
        .map(|&FoundOver { symbol, low, high }| {
            Ok(Measured { symbol, low, high, turns: turns(chain, symbol, &readings, &evaluator)? })
        })
        .collect()
}

/// A reading as people read it.
fn told(value: f64, quantity: Quantity) -> String {
    match quantity {
        Quantity::Angle => format!("{:.4}°", value.to_degrees()),
        Quantity::Length => format!("{value:.4} m"),
        Quantity::Number => format!("{value:.4}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_is_beside_a_range_by_the_shorter_way() {
        for (value, low, high, expected) in [
            (200.0, -180.0, 180.0, 0.0),
            (200.0, -170.0, 170.0, 0.0),
            (175.0, -170.0, 170.0, 5.0),
            (-350.0, 0.0, 20.0, 0.0),
            (-30.0, 0.0, 90.0, 30.0),
            (100.0, 0.0, 90.0, 10.0),
            (5.0, 10.0, 10.0, 5.0),
        ] {
            let [value, low, high, expected] = [value, low, high, expected].map(f64::to_radians);
            assert!((beside(value, low, high) - expected).abs() < 1e-12, "{value} {low} {high}");
        }
    }
}
