//! An azimuth alone, from y through x.

use std::f64::consts::TAU;

use model_core::Quantity;
use nalgebra::Vector3;

use super::kind::{ANGLES, Kind};
use super::residual::Part;
use super::written::{Asked, Filled, Key, Observes, OfReadings, Shows, Written};
use super::{Measure, Measured};

pub(super) const KIND: Kind = Kind::new(&["azimuth"], ANGLES, Measure::Azimuth, &[AZIMUTH], |rows, to| {
    rows.each(to, residual, |predicted| Measured::Azimuth { azimuth_rad: azimuth_rad(predicted) })
});

const AZIMUTH: Written = Written {
    name: "spherical",
    of: Observes::Direction,
    quantity: Quantity::Angle,
    columns: &[&[Key::new("ha")], &[Key::new("azimuth")]],
    of_readings: OfReadings::TwoAngles,
    is_meant: is_alone,
    read: |cells| Ok(Measured::Azimuth { azimuth_rad: cells.at(0) }),
    filled: Some(ROUND),
};

/// An azimuth, which goes round, and an elevation.
pub(super) const ROUND: Filled = Filled { of: two_angles, beside_nominal: false, turns: true };

fn two_angles(shows: &dyn Shows) -> [f64; 3] {
    let [azimuth_rad, elevation_rad] = shows.angles(&shows.vector());
    [azimuth_rad, elevation_rad, 0.0]
}

/// Whether a study that names the angles of a direction means the first alone.
pub(super) fn is_alone(asked: &Asked<'_>) -> bool {
    let names = asked.names;
    let [first, second] = if names("ha") || names("dec") { ["ha", "dec"] } else { ["azimuth", "elevation"] };
    names(first) && !names(second) && !asked.shows_two
}

fn azimuth_rad(vector: &Vector3<f64>) -> f64 {
    vector.x.atan2(vector.y)
}

fn residual(measured: &Measured, predicted: &Vector3<f64>) -> Option<[Part; 1]> {
    let Measured::Azimuth { azimuth_rad: measured } = measured else { return None };
    let azimuth = azimuth_rad(predicted);
    let turns = ((measured - azimuth) / TAU).round();
    let square = predicted.x * predicted.x + predicted.y * predicted.y;
    let gradient = Vector3::new(predicted.y / square, -predicted.x / square, 0.0);
    Some([(measured - azimuth - turns * TAU, gradient)])
}
