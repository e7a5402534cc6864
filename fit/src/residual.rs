//! The residual components of one observation, and how each moves with what the chain predicts.

use nalgebra::Vector3;

use observe::{Measured, tangent_frame};

/// The most components of any measure.
pub const MOST: usize = 3;

/// Measured minus predicted for each component, and the gradient of each predicted component by the observable's x, y,
/// z; only the first [`observe::Measure::components`] count. `None` for a row that observes an object, or an orientation.
pub fn components(measured: &Measured, predicted: &Vector3<f64>) -> Option<[(f64, Vector3<f64>); MOST]> {
    let none = (0.0, Vector3::zeros());
    Some(match measured {
        Measured::Direction(direction) => on_tangent_plane(direction, predicted),
        Measured::Point(point) => {
            let difference = point - predicted;
            [(difference.x, Vector3::x()), (difference.y, Vector3::y()), (difference.z, Vector3::z())]
        }
        Measured::Range { range_m } => {
            let length = predicted.norm();
            [(range_m - length, predicted / length), none, none]
        }
        Measured::Azimuth { azimuth_rad } => {
            let azimuth = predicted.x.atan2(predicted.y);
            let turns = ((azimuth_rad - azimuth) / std::f64::consts::TAU).round();
            let square = predicted.x * predicted.x + predicted.y * predicted.y;
            let gradient = Vector3::new(predicted.y / square, -predicted.x / square, 0.0);
            [(azimuth_rad - azimuth - turns * std::f64::consts::TAU, gradient), none, none]
        }
        Measured::Orientation(_) | Measured::Length { .. } | Measured::Readings => return None,
    })
}

/// A direction across and along, on the tangent plane of what was measured.
pub fn on_tangent_plane(measured: &Vector3<f64>, predicted: &Vector3<f64>) -> [(f64, Vector3<f64>); MOST] {
    // Rotations keep the length, which is divided out.
    let length = predicted.norm();
    let [across, along] = tangent_frame(measured);
    let component = |axis: Vector3<f64>| (-axis.dot(predicted) / length, axis / length);
    let [mut across, mut along] = [across, along].map(component);
    if measured.dot(predicted) < 0.0 {
        // More than 90° away the tangent plane would show it near again: continue growing instead.
        let sine = across.0.hypot(along.0);
        let stretch = if sine > 0.0 { 2.0 / sine - 1.0 } else { 1.0 };
        across.0 *= stretch;
        along.0 = if sine > 0.0 { along.0 * stretch } else { 2.0 };
    }
    [across, along, (0.0, Vector3::zeros())]
}
