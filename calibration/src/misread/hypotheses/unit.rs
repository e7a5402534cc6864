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
    let of = |quantity| sets(tried, |column: &SampledColumn| column.quantity == quantity);
    [Quantity::Angle, Quantity::Length].into_iter().flat_map(of).flat_map(|set| of_set(tried, &set)).collect()
}

/// Columns of one quantity in each of the other units of it.
pub(super) fn of_set(tried: &Tried<'_>, columns: &[&SampledColumn]) -> Vec<Hypothesis> {
    let units = match columns.first().map(|column| column.quantity) {
        Some(Quantity::Angle) => ANGLES,
        Some(Quantity::Length) => LENGTHS,
        _ => &[],
    };
    units.iter().filter_map(|unit| hypothesis(tried, columns, unit)).collect()
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
    let reading = Reading::Unit { columns: names(columns), is: unit.name(), read };
    let changes =
        columns.iter().map(|column| Changed::all(column.place, Change::Factor(unit.in_si()))).collect();
    let short = |column: &&SampledColumn| {
        (short_of_travel(column, unit.in_si()) - short_of_travel(column, column.factor)).max(0.0)
    };
    let of_joints = columns.iter().copied().filter(|column| is_joint(tried.plan, column));
    let price =
        if headed.is_empty() { 0.0 } else { HEADED_PRICE } + of_joints.map(|own| short(&own)).sum::<f64>();
    let headings = headed.iter().map(heading).collect();
    Some(Hypothesis { headings, ..Hypothesis::new(reading, changes, lines, price) })
}

/// Nats that the travel of a joint is rarer than a long one, by the numbers of its column in a unit.
fn short_of_travel(column: &SampledColumn, in_si: f64) -> f64 {
    let travel = span(column) * in_si;
    if column.quantity == Quantity::Angle && travel > 0.0 { (TRAVEL_RAD / travel).ln().max(0.0) } else { 0.0 }
}
