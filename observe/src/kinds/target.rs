//! A point that is an unknown target's, seen along a beam from a station.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{BeamUse, GrowsWith, Kind, LENGTHS, NoiseOf, PlaceShown, Ranges, Scale, Thing};
use super::residual::Component;
use super::seeing::Seeing;
use super::written::{Observes, Written};
use crate::tangent_frame;
use crate::unknowns::Shape;

pub(super) const KIND: Kind = Kind {
    noise: [NoiseOf::Across, NoiseOf::Across, NoiseOf::Lengths],
    shape: Some(Shape::Point),
    beam: BeamUse::Direction,
    place: PlaceShown::There,
    scale: |_| Scale::Free,
    grows_with: GrowsWith::RangeOrArm,
    ranges: Ranges::BothWays,
    thing: |_| Some(&TARGET),
    ..Kind::new(
        &["across", "up", "along"],
        LENGTHS,
        Measure::Point,
        &[Written::readings("target", Observes::Point, Quantity::Length)],
        |rows, to| rows.each_seen(to, |row, p, beam| Some(off_target(row, p, beam))),
    )
};

const TARGET: Thing = Thing::new("target", "a target");

/// Rᵀ(X − t) − p across, up and along the beam.
fn off_target(row: &Seeing<'_>, p: &Vector3<f64>, beam: &Vector3<f64>) -> [Component; 3] {
    let beam = beam.normalize();
    let [across, up] = tangent_frame(&beam);
    row.point(p, [across, up, beam])
}
