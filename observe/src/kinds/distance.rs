//! The distance of the point from another: of a bar, or of a sphere whose radius is measured.

use model_core::Quantity;

use super::Measure;
use super::kind::{AimedAt, Kind, LENGTHS, MeasuredLengths, PlaceShown, Thing};
use super::wire::{COMPONENTS, too_long};
use super::written::{Key, Observes, OfReadings, Written, length};
use crate::unknowns::Shape;

/// It is a wire's length that lacks nothing: an object that is a point has no fourth number.
pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Point),
    place: PlaceShown::Distance,
    distance_m: |measured| measured.length_m().map(f64::abs),
    lengths: Some(MeasuredLengths::Distances),
    aim: AimedAt::Sphere,
    thing: |_| Some(&PIVOT),
    ..Kind::new(
        COMPONENTS,
        LENGTHS,
        Measure::Point,
        &[
            Written {
                name: "sphere",
                columns: &[&[Key::new("radius")]],
                is_meant: |asked| (asked.names)("radius"),
                ..DISTANCE
            },
            DISTANCE,
        ],
        |rows, to| rows.each_seen(to, |row, p, _| too_long(row, p)),
    )
};

const PIVOT: Thing = Thing { radius: [", ", " mm from every point"], ..Thing::new("distance", "a pivot") };

const DISTANCE: Written = Written {
    name: "distance",
    of: Observes::Point,
    quantity: Quantity::Length,
    columns: &[&[Key::new("length")]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: length,
    filled: None,
};
