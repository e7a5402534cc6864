//! A point that is known row by row.

use model_core::Quantity;
use nalgebra::Vector3;

use super::kind::{BaseShown, Kind, LENGTHS, Map, SpaceAxes};
use super::residual::Part;
use super::written::{Filled, Key, Observes, OfReadings, Written};
use super::{Measure, Measured};

pub(super) const KIND: Kind = Kind {
    base: BaseShown::Pose,
    space_axes: Some(SpaceAxes { turn: false, of: |_| [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] }),
    distance_m: |measured| match measured {
        Measured::Point(point) => Some(point.norm()),
        _ => None,
    },
    map: Some(Map {
        title: "In space, from above",
        labels: ["x, m", "y, m"],
        place: |measured| match measured {
            Measured::Point(point) => Some((point.x, point.y)),
            _ => None,
        },
    }),
    ..Kind::new(&["x", "y", "z"], LENGTHS, Measure::Point, &[POINT], |rows, to| {
        rows.each(to, residual, |predicted| Measured::Point(*predicted))
    })
};

const POINT: Written = Written {
    name: "point",
    of: Observes::Point,
    quantity: Quantity::Length,
    columns: &[&[
        Key { name: "x", headers: &["x", "east"] },
        Key { name: "y", headers: &["y", "north"] },
        Key { name: "z", headers: &["z", "up"] },
    ]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: |cells| Ok(Measured::Point(Vector3::new(cells.at(0), cells.at(1), cells.at(2)))),
    filled: Filled::with(|shows| shows.vector().into()),
};

fn residual(measured: &Measured, predicted: &Vector3<f64>) -> Option<[Part; 3]> {
    let Measured::Point(point) = measured else { return None };
    let difference = point - predicted;
    Some([(difference.x, Vector3::x()), (difference.y, Vector3::y()), (difference.z, Vector3::z())])
}
