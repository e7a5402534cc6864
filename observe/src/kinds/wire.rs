//! The length of a wire from an unknown anchor to the point, or a sphere of which nobody knows the radius: a wire of which nothing
//! is read.

use model_core::Quantity;
use nalgebra::Vector3;

use super::kind::{AimedAt, Kind, LENGTHS, MeasuredLengths, Scale, Thing};
use super::residual::Component;
use super::seeing::Seeing;
use super::written::{Key, Observes, OfReadings, Written, length};
use super::{Measure, Measured};
use crate::unknowns::Shape;

/// What the component of a length is called.
pub(super) const COMPONENTS: &[&str] = &["length"];

pub(super) const KIND: Kind = Kind {
    shape: Some(Shape::Wire),
    scale: |measured| {
        let reads_nothing = |own: &Measured| own.length_m() == Some(0.0);
        if measured.iter().all(reads_nothing) { Scale::Free } else { Scale::Held }
    },
    lengths: Some(MeasuredLengths::Wires),
    aim: AimedAt::Sphere,
    thing: |reads_length| Some(if reads_length { &WIRE } else { &SPHERE }),
    ..Kind::new(COMPONENTS, LENGTHS, Measure::Point, &[OF_SPHERE, OF_WIRE], |rows, to| {
        rows.each_seen(to, |row, p, _| too_long(row, p))
    })
};

const WIRE: Thing = Thing::new("wire", "a wire with its anchor");
const SPHERE: Thing = Thing::new("sphere", "a sphere");

const OF_SPHERE: Written = Written {
    is_meant: |asked| !(asked.names)("radius"),
    read: |_| Ok(Measured::Length { length_m: 0.0 }),
    ..Written::readings("sphere", Observes::Point, Quantity::Length)
};

const OF_WIRE: Written = Written {
    name: "wire",
    of: Observes::Point,
    quantity: Quantity::Length,
    columns: &[&[Key::new("length")]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: length,
    filled: None,
};

/// The length read against |R p + t − a| − z.
pub(super) fn too_long(row: &Seeing<'_>, p: &Vector3<f64>) -> Option<[Component; 1]> {
    let length_m = row.measured.length_m()?;
    let own = row.own;
    let from = row.pose.apply(p) - row.object.place - Vector3::new(own[0], own[1], own[2]);
    let distance = from.norm();
    let u = from / distance;
    let gradient = row.pose.turn.inverse() * u;
    let part = (length_m + row.object.offset + own[3] - distance, gradient);
    Some([row.component(part, [-u.x, -u.y, -u.z, -1.0], u, p.cross(&gradient))])
}
