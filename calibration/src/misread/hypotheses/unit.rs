//! Another unit: of one column, of all joints, of all that was observed, or of all that measures the same.

use model_core::Quantity;
use model_core::unit::Unit;

use super::{Heading, Hypothesis, Reading, Tried, is_joint, line, named, names, quoted, sets, span};
use crate::misread::policy::{HEADED_PRICE, TRAVEL_RAD};
use study::{Change, Changed, SampledColumn};

/// Units that files are written in.
const ANGLES: &[&str] = &["deg", "rad", "gon", "hour", "arcmin", "arcsec", "mrad", "mas", "turn"];
const LENGTHS: &[&str] = &["m", "mm", "cm", "um", "inch", "ft"];

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for (quantity, units) in [(Quantity::Angle, ANGLES), (Quantity::Length, LENGTHS)] {
        for set in sets(tried, |column| column.quantity == quantity) {
            all.extend(units.iter().filter_map(|unit| hypothesis(tried, &set, unit)));
        }
    }
    all
}

/// Columns in a unit that none of them is read in. Where a heading says the unit, the study cannot say another, and it is seldom wrong.
fn hypothesis(tried: &Tried<'_>, columns: &[&SampledColumn], unit: &str) -> Option<Hypothesis> {
    let unit = Unit::find(unit)?;
    if columns.iter().any(|column| column.factor == unit.in_si()) {
        return None;
    }
    let (open, headed): (Vec<&SampledColumn>, Vec<&SampledColumn>) =
        columns.iter().partition(|column| column.unit_is_open);
    let how = || vec![("unit", quoted(unit.name()))];
    let lines = open.iter().map(|column| line(tried.plan, column, &column.name, how())).collect();
    let heading = |column: &&SampledColumn| Heading { heading: column.heading.clone(), is: unit.name() };
    let read = columns.first().and_then(|column| named(column));
    Some(Hypothesis {
        reading: Reading::Unit { columns: names(columns), is: unit.name(), read },
        changes: columns
            .iter()
            .map(|column| Changed::all(column.place, Change::Factor(unit.in_si())))
            .collect(),
        lines,
        headings: headed.iter().map(heading).collect(),
        price: if headed.is_empty() { 0.0 } else { HEADED_PRICE }
            + columns
                .iter()
                .filter(|column| is_joint(tried.plan, column))
                .map(|column| {
                    (short_of_travel(column, unit.in_si()) - short_of_travel(column, column.factor)).max(0.0)
                })
                .sum::<f64>(),
        digits: 0.0,
    })
}

/// Nats that the travel of a joint is rarer than a long one, by the numbers of its column in a unit.
fn short_of_travel(column: &SampledColumn, in_si: f64) -> f64 {
    let travel = span(column) * in_si;
    if column.quantity == Quantity::Angle && travel > 0.0 { (TRAVEL_RAD / travel).ln().max(0.0) } else { 0.0 }
}
