//! A point on a circle of which nobody knows where it is; its radius is measured.

use model_core::Quantity;

use super::circle::{CIRCLE, COMPONENTS, off_circle};
use super::kind::{AimedAt, Kind, LENGTHS, MeasuredLengths};
use super::written::{Key, Observes, OfReadings, Written, length};
use super::{Measure, Measured};
use crate::unknowns::Shape;

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Ring),
    distance_m: |measured| measured.length_m().map(f64::abs),
    lengths: Some(MeasuredLengths::Radii),
    aim: AimedAt::Circle,
    thing: |_| Some(&CIRCLE),
    ..Kind::new(COMPONENTS, LENGTHS, Measure::Point, &[RING], |rows, to| {
        rows.each_seen(to, |row, p, _| match row.measured {
            Measured::Length { length_m } => Some(off_circle(row, *length_m, p)),
            _ => None,
        })
    })
};

const RING: Written = Written {
    name: "circle",
    of: Observes::Point,
    quantity: Quantity::Length,
    columns: &[&[Key::new("radius")]],
    of_readings: OfReadings::Nothing,
    is_meant: |asked| (asked.names)("radius"),
    read: length,
    filled: None,
};
