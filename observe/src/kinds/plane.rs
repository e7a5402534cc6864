//! A point on a plane of which nobody knows where it is.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{AimedAt, GrowsWith, Kind, LENGTHS, Ranges, Scale, Thing};
use super::residual::Component;
use super::seeing::Seeing;
use super::written::{Observes, Written};
use crate::unknowns::{Shape, tilted};

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Plane),
    scale: |_| Scale::Free,
    grows_with: GrowsWith::RangeOrArm,
    ranges: Ranges::OfSensor,
    aim: AimedAt::Board,
    thing: |_| Some(&PLANE),
    ..Kind::new(
        &["off_plane"],
        LENGTHS,
        Measure::Point,
        &[Written::readings("plane", Observes::Point, Quantity::Length)],
        |rows, to| rows.each_seen(to, |row, p, _| Some(off_plane(row, p))),
    )
};

const PLANE: Thing = Thing::new("plane", "a plane");

/// n·(R p + t) − d against zero.
fn off_plane(row: &Seeing<'_>, p: &Vector3<f64>) -> [Component; 1] {
    let own = row.own;
    let (n, by_tilt) = tilted(&row.object.normal, [own[0], own[1]]);
    let from = row.pose.apply(p) - row.object.place;
    let gradient = row.pose.turn.inverse() * n;
    let object = [by_tilt[0].dot(&from), by_tilt[1].dot(&from), -1.0];
    [row.component((own[2] - n.dot(&from), gradient), object, n, p.cross(&gradient))]
}
