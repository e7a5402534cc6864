//! The residual components of one observation, and how each moves with what the chain predicts.

use nalgebra::Vector3;

use crate::data::{Measure, tangent_frame};

/// The most components of any measure.
pub const MOST: usize = 3;

/// Measured minus predicted for each component, and the gradient of each predicted component by the observable's x, y,
/// z; only the first [`Measure::components`] count.
pub fn components(
    measure: Measure,
    measured: &Vector3<f64>,
    predicted: &Vector3<f64>,
) -> [(f64, Vector3<f64>); MOST] {
    match measure {
        Measure::Direction => {
            // On the tangent plane of what was measured; rotations keep the length, which is divided out.
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
        Measure::Point => {
            let difference = measured - predicted;
            [(difference.x, Vector3::x()), (difference.y, Vector3::y()), (difference.z, Vector3::z())]
        }
        Measure::Range => {
            let length = predicted.norm();
            let none = (0.0, Vector3::zeros());
            [(measured.x - length, predicted / length), none, none]
        }
        Measure::Azimuth => {
            let azimuth = predicted.x.atan2(predicted.y);
            let turns = ((measured.x - azimuth) / std::f64::consts::TAU).round();
            let square = predicted.x * predicted.x + predicted.y * predicted.y;
            let gradient = Vector3::new(predicted.y / square, -predicted.x / square, 0.0);
            let none = (0.0, Vector3::zeros());
            [(measured.x - azimuth - turns * std::f64::consts::TAU, gradient), none, none]
        }
        Measure::Plane
        | Measure::Target
        | Measure::Fixed
        | Measure::Wire
        | Measure::Distance
        | Measure::Sight => {
            unreachable!("the residual of a row that observes an object is that of `objects::seen`")
        }
    }
}
