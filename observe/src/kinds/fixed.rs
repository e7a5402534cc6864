//! A point that stays where it is, however it is reached: a socket.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{GrowsWith, Kind, LENGTHS, PlaceShown, Ranges, Scale, Thing};
use super::written::{Observes, Written};
use crate::unknowns::Shape;

/// Its components are Rᵀ(X − t) − p along x, y, z of the chain's frame: along those of the objects' frame each would have a noise of its
/// own there, by which a frame that nothing holds would turn.
pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Point),
    place: PlaceShown::There,
    scale: |_| Scale::Free,
    grows_with: GrowsWith::Arm,
    ranges: Ranges::OfSensor,
    thing: |_| Some(&SOCKET),
    ..Kind::new(
        &["x", "y", "z"],
        LENGTHS,
        Measure::Point,
        &[Written::readings("fixed", Observes::Point, Quantity::Length)],
        |rows, to| {
            rows.each_seen(to, |row, p, _| Some(row.point(p, [Vector3::x(), Vector3::y(), Vector3::z()])))
        },
    )
};

const SOCKET: Thing = Thing::new("fixed", "a socket");
