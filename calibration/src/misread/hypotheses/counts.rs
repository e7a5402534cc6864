//! A joint is in counts of its encoder: whole numbers, a fixed number a turn.

use std::f64::consts::TAU;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, line, span};
use crate::misread::policy::{COUNTS_DEGREES, COUNTS_PRICE};
use study::{Change, Changed, SampledColumn};

/// Powers of two that encoders have.
const BITS: std::ops::RangeInclusive<u32> = 10..=26;

/// Counts of encoders that divide a turn, or a degree, by ten.
const DECIMAL: [u32; 9] =
    [3_600, 10_000, 36_000, 100_000, 360_000, 1_000_000, 3_600_000, 10_000_000, 36_000_000];

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let of_column = |column: &&SampledColumn| -> Vec<Hypothesis> {
        let each = BITS.map(|bits| 1 << bits).chain(DECIMAL);
        let hypothesis = |per_turn: u32| {
            let changes = vec![Changed::all(column.place, Change::Factor(TAU / f64::from(per_turn)))];
            let how = vec![("counts_per_turn", per_turn.to_string())];
            let lines = vec![line(tried.plan, column, &column.name, how)];
            let reading = Reading::Counts { column: column.name.clone(), per_turn };
            Hypothesis::new(reading, changes, lines, COUNTS_PRICE)
        };
        each.map(hypothesis).collect()
    };
    tried.joints.iter().filter(|column| may_be(column)).flat_map(of_column).collect()
}

/// Whether a column is whole numbers, more than a few turns of degrees.
fn may_be(column: &SampledColumn) -> bool {
    column.quantity == Quantity::Angle
        && column.unit_is_open
        && column.written.iter().all(|number| number.fract() == 0.0)
        && span(column) > COUNTS_DEGREES
}
