//! Where a camera sees a point that is known row by row, in pixels.

use model_core::Quantity;
use nalgebra::Vector3;

use super::kind::{Kind, Map, NoiseOf, Predicted, Scale};
use super::residual::Part;
use super::written::{Filled, Key, Observes, OfReadings, Written};
use super::{MOST, Measure, Measured};
use crate::SiUnit;

pub(super) const KIND: Kind = Kind {
    predicted: Predicted::Image,
    scale: |_| Scale::Unseen,
    map: Some(Map {
        title: "Over the image",
        labels: ["u, px", "v, px"],
        place: |measured| match measured {
            Measured::Pixel { uv_px: [u, v] } => Some((*u, *v)),
            _ => None,
        },
    }),
    ..Kind::new(
        &["u", "v"],
        (SiUnit::PIXEL, [NoiseOf::Pixels; MOST]),
        Measure::Pixel,
        &[PIXEL],
        |rows, to| rows.each(to, residual, |predicted| Measured::Pixel { uv_px: [predicted.x, predicted.y] }),
    )
};

const PIXEL: Written = Written {
    name: "pixel",
    of: Observes::Image,
    quantity: Quantity::Number,
    columns: &[&[Key { name: "u", headers: &["u", "pixelx"] }, Key { name: "v", headers: &["v", "pixely"] }]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: |cells| {
        let depth_m = cells.nominal().z;
        if depth_m.is_finite() && depth_m <= 0.0 {
            return Err(format!(
                "the declared camera has this point {:.4} m behind it, and no camera sees that: is the sign of a joint, the order of the \
                 columns or the pose of the camera wrong?",
                -depth_m
            ));
        }
        Ok(Measured::Pixel { uv_px: [cells.at(0), cells.at(1)] })
    },
    filled: Filled::with(|shows| shows.vector().into()),
};

/// Nothing is seen behind the camera.
fn residual(measured: &Measured, predicted: &Vector3<f64>) -> Option<[Part; 2]> {
    let Measured::Pixel { uv_px: [u, v] } = measured else { return None };
    let seen = |difference: f64| if predicted.z > 0.0 { difference } else { f64::NAN };
    Some([(seen(u - predicted.x), Vector3::x()), (seen(v - predicted.y), Vector3::y())])
}
