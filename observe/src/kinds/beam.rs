//! A sight from a point of the chain: its beam goes through an unknown point, and nobody measures how far that is.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{ANGLES, BeamUse, Kind, PlaceShown, Scale};
use super::residual::Component;
use super::seeing::{Seeing, TurnsBy};
use super::sight::MARK;
use super::tangent_plane::on_tangent_plane;
use super::written::{Observes, Written};
use crate::tangent_frame;
use crate::unknowns::Shape;

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Point),
    beam: BeamUse::Whole,
    place: PlaceShown::Beam,
    scale: |_| Scale::Free,
    thing: |_| Some(&MARK),
    ..Kind::new(
        &["across", "along"],
        ANGLES,
        Measure::Point,
        &[Written::readings("sight", Observes::Point, Quantity::Angle)],
        |rows, to| rows.each_seen(to, |row, p, beam| Some(off_beam(row, p, beam))),
    )
};

/// The direction of the object from where the beam begins against the beam, which ends as far away, on the tangent plane of the
/// first.
fn off_beam(row: &Seeing<'_>, p: &Vector3<f64>, beam: &Vector3<f64>) -> [Component; 2] {
    let there = row.pose.back(&row.place(0));
    let from = there - (p - beam);
    let distance = from.norm();
    let direction = from / distance;
    let mut axes = tangent_frame(&direction);
    let mut parts = on_tangent_plane(&direction, beam);
    let mut arm = there;
    if row.by == TurnsBy::Prediction {
        // Along the beam nothing is determined: an eye that moves away from all that it sees makes every residual small, by a share of
        // itself.
        (arm, axes) = (*p, tangent_frame(&beam.normalize()));
        parts.iter_mut().zip(axes).for_each(|(own, axis)| own.1 = axis / beam.norm());
    }
    [0, 1].map(|at| {
        let (part, axis) = (parts[at], axes[at]);
        let outside = row.pose.turn * axis / distance;
        row.component(part, [-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis) / distance)
    })
}
