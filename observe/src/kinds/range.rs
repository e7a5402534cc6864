//! The distance of a point from the origin of the ground frame.

use model_core::Quantity;
use nalgebra::Vector3;

use super::kind::{Kind, LENGTHS};
use super::residual::Part;
use super::written::{Filled, Key, Observes, OfReadings, Written};
use super::{Measure, Measured};

pub(super) const KIND: Kind = Kind {
    distance_m: |measured| match measured {
        Measured::Range { range_m } => Some(range_m.abs()),
        _ => None,
    },
    ..Kind::new(&["range"], LENGTHS, Measure::Range, &[RANGE], |rows, to| {
        rows.each(to, residual, |predicted| Measured::Range { range_m: predicted.norm() })
    })
};

const RANGE: Written = Written {
    name: "range",
    of: Observes::Point,
    quantity: Quantity::Length,
    columns: &[&[Key { name: "range", headers: &["range", "distance", "dist", "slope"] }]],
    of_readings: OfReadings::Range,
    is_meant: |_| true,
    read: |cells| {
        let range_m = cells.at(0);
        if range_m < 0.0 {
            return Err(format!("a range of {range_m} m is negative"));
        }
        Ok(Measured::Range { range_m })
    },
    filled: Filled::with(|shows| [shows.vector().norm(), 0.0, 0.0]),
};

fn residual(measured: &Measured, predicted: &Vector3<f64>) -> Option<[Part; 1]> {
    let Measured::Range { range_m } = measured else { return None };
    let length = predicted.norm();
    Some([(range_m - length, predicted / length)])
}
