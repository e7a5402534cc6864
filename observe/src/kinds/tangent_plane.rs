//! A direction beside another, on the tangent plane of what was measured: what every kind of direction compares.

use nalgebra::Vector3;

use super::residual::Part;
use crate::tangent_frame;

/// A direction across and along, on the tangent plane of what was measured.
pub(super) fn on_tangent_plane(measured: &Vector3<f64>, predicted: &Vector3<f64>) -> [Part; 2] {
    // Rotations keep the length, which is divided out.
    let length = predicted.norm();
    let component = |axis: Vector3<f64>| (-axis.dot(predicted) / length, axis / length);
    let [mut across, mut along] = tangent_frame(measured).map(component);
    if measured.dot(predicted) < 0.0 {
        // More than 90° away the tangent plane would show it near again: continue growing instead.
        let sine = across.0.hypot(along.0);
        let stretch = if sine > 0.0 { 2.0 / sine - 1.0 } else { 1.0 };
        across.0 *= stretch;
        along.0 = if sine > 0.0 { along.0 * stretch } else { 2.0 };
    }
    [across, along]
}
