//! How a body is turned: the turn that takes the predicted orientation to the measured one.

use model_core::Quantity;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::compare::{Compared, Mismatch, Rows};
use super::kind::{ANGLES, BaseShown, Kind, Predicted, Scale};
use super::written::{Observes, OfReadings, Written};
use super::{Measure, Measured};
use crate::orientation::{of_axes, rotation_vector};

pub(super) const KIND: Kind = Kind {
    predicted: Predicted::Axes,
    base: BaseShown::Turn,
    scale: |_| Scale::Unseen,
    ..Kind::new(
        &["rotation_x", "rotation_y", "rotation_z"],
        ANGLES,
        Measure::Orientation,
        &[ORIENTATION],
        compare,
    )
};

const ORIENTATION: Written = Written {
    name: "orientation",
    of: Observes::Orientation,
    quantity: Quantity::Angle,
    columns: &[],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: |cells| cells.orientation().map(Measured::Orientation),
    filled: None,
};

fn compare(rows: &Rows<'_>, to: &mut Compared<'_>) -> Result<(), Mismatch> {
    let count = rows.count;
    for row in 0..count {
        let axes = Matrix3::from_fn(|component, axis| rows.predicted[(3 * axis + component) * count + row]);
        let measured = match rows.measured.map(|measured| &measured[row]) {
            None => None,
            Some(Measured::Orientation(measured)) => Some(measured),
            Some(_) => return Err(Mismatch { row }),
        };
        let components = components(measured, &axes);
        let is_defined = components.iter().all(|(left, _)| left.is_finite());
        to.defined.push(is_defined);
        for (component, (left, by_axes)) in components.iter().enumerate() {
            to.residual[component * count + row] = if is_defined { *left } else { 0.0 };
            for (place, part) in by_axes.iter().flatten().enumerate() {
                to.gradient[(9 * component + place) * count + row] = *part;
            }
        }
    }
    rows.nothing_unknown::<3>(to);
    Ok(())
}

/// The three components of the turn that takes the predicted orientation to the measured one, rad, and of each component of what
/// is predicted the gradient by the three axes of the body; nothing remains where nothing was `measured`.
///
/// With E = M Rᵀ = exp(ρ×) a further turn δ of the prediction leaves E exp(−δ×), so that ρ changes by −J(ρ) δ; and the axes a
/// of R, which change by da = δ × a, say δ = ½ Σ a × da.
///
/// Source: J(ρ) = 1 + ½ ρ× + b ρ×², b = (1 − (θ/2) cot(θ/2))/θ², is the inverse of the right Jacobian of SO(3): J. Solà,
/// J. Deray, D. Atchuthan, A micro Lie theory for state estimation in robotics (2018), equation 144.
fn components(
    measured: Option<&UnitQuaternion<f64>>,
    predicted: &Matrix3<f64>,
) -> [(f64, [Vector3<f64>; 3]); 3] {
    let left = match measured {
        Some(measured) => rotation_vector(&(measured * of_axes(predicted).inverse())),
        // No number where nothing can be predicted.
        None => predicted * Vector3::zeros(),
    };
    let cross = left.cross_matrix();
    let jacobian = Matrix3::identity() + cross / 2.0 + cross * cross * curvature(left.norm());
    std::array::from_fn(|component| {
        let row = jacobian.row(component).transpose();
        (left[component], std::array::from_fn(|axis| row.cross(&predicted.column(axis)) / 2.0))
    })
}

/// (1 − (θ/2) cot(θ/2))/θ², without cancellation where θ is small.
fn curvature(angle_rad: f64) -> f64 {
    let square = angle_rad * angle_rad;
    if angle_rad < 1e-2 {
        return 1.0 / 12.0 + square / 720.0;
    }
    let half = angle_rad / 2.0;
    (1.0 - half / half.tan()) / square
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A rotation whose first component is differentiated numerically, without logarithms of the code above.
    fn turned(by: Vector3<f64>, start: &Matrix3<f64>) -> Matrix3<f64> {
        by.cross_matrix().exp() * start
    }

    #[test]
    fn gradients_are_differences_of_residuals_near_and_far() {
        let start = turned(Vector3::new(1.9, -0.7, 2.2), &Matrix3::identity());
        for left in [
            Vector3::zeros(),
            Vector3::new(1e-9, -3e-9, 2e-9),
            Vector3::new(4e-3, 6e-3, -3e-3),
            Vector3::new(0.3, -0.8, 0.5),
            Vector3::new(1.7, 1.7, -1.9),
        ] {
            let measured = of_axes(&turned(left, &start));
            let found = components(Some(&measured), &start);
            for (component, (residual, _)) in found.iter().enumerate() {
                assert_relative_eq!(*residual, left[component], epsilon = 1e-14);
            }
            let step = 1e-5;
            for about in 0..3 {
                let by = Vector3::ith(about, 1.0);
                let [behind, ahead] =
                    [-step, step].map(|step| components(Some(&measured), &turned(by * step, &start)));
                for component in 0..3 {
                    // What is predicted grows where the residual falls.
                    let expected = (behind[component].0 - ahead[component].0) / (2.0 * step);
                    let change = |axis: usize| by.cross(&start.column(axis));
                    let gradients = found[component].1;
                    let along: f64 = (0..3).map(|axis| gradients[axis].dot(&change(axis))).sum();
                    assert_relative_eq!(along, expected, epsilon = 1e-8);
                }
            }
        }
    }

    #[test]
    fn half_a_turn_is_a_number_and_nothing_predicted_is_none() {
        let start = turned(Vector3::new(0.2, 0.1, -0.4), &Matrix3::identity());
        let away = turned(Vector3::new(0.6, 0.0, 0.8) * std::f64::consts::PI, &start);
        let found = components(Some(&of_axes(&away)), &start);
        let length = found.iter().map(|(residual, _)| residual * residual).sum::<f64>().sqrt();
        assert_relative_eq!(length, std::f64::consts::PI, epsilon = 1e-9);
        assert!(found.iter().all(|(_, gradient)| gradient.iter().flatten().all(|part| part.is_finite())));
        assert!(components(None, &start).iter().all(|(residual, _)| *residual == 0.0));
        let none = Matrix3::from_element(f64::NAN);
        for measured in [None, Some(&of_axes(&away))] {
            assert!(components(measured, &none).iter().all(|(residual, _)| residual.is_nan()));
        }
    }
}
