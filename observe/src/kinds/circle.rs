//! A point on a circle of which nobody knows where it is, nor its radius.

use model_core::Quantity;
use nalgebra::Vector3;

use super::Measure;
use super::kind::{AimedAt, GrowsWith, Kind, LENGTHS, Scale, Thing};
use super::residual::Component;
use super::seeing::Seeing;
use super::written::{Observes, Written};
use crate::unknowns::{Shape, tilted};

/// What the components of a point beside a circle are.
pub(super) const COMPONENTS: &[&str] = &["off_plane", "off_circle"];

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Circle),
    scale: |_| Scale::Free,
    grows_with: GrowsWith::Arm,
    aim: AimedAt::Circle,
    thing: |_| Some(&CIRCLE),
    ..Kind::new(
        COMPONENTS,
        LENGTHS,
        Measure::Point,
        &[Written {
            is_meant: |asked| !(asked.names)("radius"),
            ..Written::readings("circle", Observes::Point, Quantity::Length)
        }],
        |rows, to| rows.each_seen(to, |row, p, _| Some(off_circle(row, 0.0, p))),
    )
};

pub(super) const CIRCLE: Thing = Thing { turned_by: "axis", ..Thing::new("circle", "a circle") };

/// How far R p + t is off the plane of a circle, and how far outside of it; `radius_m` is what is known of the radius.
pub(super) fn off_circle(row: &Seeing<'_>, radius_m: f64, p: &Vector3<f64>) -> [Component; 2] {
    let own = row.own;
    let (n, by_tilt) = tilted(&row.object.normal, [own[0], own[1]]);
    let from = row.pose.apply(p) - row.object.place - Vector3::new(own[2], own[3], own[4]);
    let off = n.dot(&from);
    let inside = from - n * off;
    let distance = inside.norm();
    let u = inside / distance;
    let tilts = by_tilt.map(|by| by.dot(&from));
    let out = row.pose.turn.inverse() * u;
    let up = row.pose.turn.inverse() * n;
    let lean = off / distance;
    let radius = radius_m + row.object.offset + own[5];
    let by_plane = [tilts[0], tilts[1], -n.x, -n.y, -n.z, 0.0];
    let by_circle = [-tilts[0] * lean, -tilts[1] * lean, -u.x, -u.y, -u.z, -1.0];
    [
        row.component((-off, up), by_plane, n, p.cross(&up)),
        row.component((radius - distance, out), by_circle, u, p.cross(&out)),
    ]
}
