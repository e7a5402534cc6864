//! A direction that is an unknown point's from a station.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{ANGLES, AimedAt, Kind, PlaceShown, Scale, Thing};
use super::residual::Component;
use super::seeing::{Seeing, TurnsBy};
use super::tangent_plane::on_tangent_plane;
use super::written::{Observes, Written};
use crate::tangent_frame;
use crate::unknowns::Shape;

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Point),
    place: PlaceShown::Beam,
    scale: |_| Scale::Unseen,
    aim: AimedAt::Way,
    thing: |_| Some(&MARK),
    ..Kind::new(
        &["across", "along"],
        ANGLES,
        Measure::Direction,
        &[Written::readings("sight", Observes::Direction, Quantity::Angle)],
        |rows, to| rows.each_seen(to, |row, beam, _| Some(off_sight(row, beam))),
    )
};

pub(super) const MARK: Thing = Thing::new("sight", "a mark");

/// The direction of the object from the station against the beam, on the tangent plane of the first.
fn off_sight(row: &Seeing<'_>, beam: &Vector3<f64>) -> [Component; 2] {
    let there = row.pose.back(&row.place(0));
    let distance = there.norm();
    let direction = there / distance;
    let axes = tangent_frame(&direction);
    let parts = on_tangent_plane(&direction, beam);
    let arm = if row.by == TurnsBy::Prediction { beam.normalize() } else { direction };
    [0, 1].map(|at| {
        let (part, axis) = (parts[at], axes[at]);
        let outside = row.pose.turn * axis / distance;
        row.component(part, [-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis))
    })
}
