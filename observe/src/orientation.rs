//! How a body is turned: its three axes as a chain has them, and the turn between two orientations.
//!
//! An orientation R takes vectors of the body into the frame that it is seen in: its columns are the body's axes there. A turn
//! ω of that frame makes exp(ω×) R of it, as [`model_core::readings::Measures::Rotation`] has it.

use model_core::algebra::Poly;
use model_core::readings::COMPONENTS;
use model_core::{Chain, Observable, ObservableId, exact};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// The observables of [`axes_of`]: x, y and z.
pub const AXES: [ObservableId; 3] = [ObservableId(0), ObservableId(1), ObservableId(2)];

/// A chain that shows nothing but the directions of the three axes of the body that carries an observable.
#[must_use]
pub fn axes_of(chain: &Chain, observable: ObservableId) -> Chain {
    let shown = chain.observable(observable);
    let unit = |axis, i| if i == axis { Poly::one() } else { Poly::zero() };
    let along = |axis: usize| Observable {
        components: std::array::from_fn(|i| unit(axis, i)),
        shown: COMPONENTS.to_vec(),
        ..shown.clone()
    };
    Chain { observables: (0..3).map(along).collect(), ..chain.clone() }
}

/// The orientation of a body, pose by pose.
#[derive(Debug, Clone)]
pub struct Turned([exact::Path; 3]);

impl Turned {
    /// Of the body that carries an observable, in the frame that it is seen in.
    #[must_use]
    pub fn new(chain: &Chain, observable: ObservableId) -> Self {
        let axes = axes_of(chain, observable);
        Self(AXES.map(|axis| exact::Path::new(&axes, axis)))
    }

    /// At the values of all symbols, in SI.
    #[must_use]
    pub fn at(&self, values: &[f64]) -> UnitQuaternion<f64> {
        let [x, y, z] = self.0.each_ref().map(|axis| axis.value(values));
        of_axes(&Matrix3::from_columns(&[x, y, z]))
    }
}

/// The orientation whose axes are the columns of a matrix, which is a rotation but for rounding.
pub fn of_axes(axes: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(*axes))
}

/// The vector about which, and by the length of which, a rotation turns, in rad, by half a turn at most; no number for a rotation
/// that is none.
///
/// Source: logarithm of a unit quaternion (cos θ/2, n sin θ/2), of which q and −q are one rotation.
#[must_use]
pub fn rotation_vector(turn: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (w, v) = if turn.w < 0.0 { (-turn.w, -turn.imag()) } else { (turn.w, turn.imag()) };
    let sine = v.norm();
    // So small a turn that the length of its vector is lost.
    if sine == 0.0 { v * 2.0 } else { v * (2.0 * sine.atan2(w) / sine) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_turn_is_its_vector_up_to_half_a_turn() {
        let axis = Vector3::new(0.48, -0.6, 0.64);
        for angle_rad in [0.0, 1e-300, 1e-12, 1e-3, 1.0, 3.0, std::f64::consts::PI - 1e-9] {
            let vector = axis * angle_rad;
            let turn = UnitQuaternion::new(vector);
            let opposite = UnitQuaternion::new_unchecked(-turn.into_inner());
            for turn in [turn, opposite] {
                assert_relative_eq!(rotation_vector(&turn), vector, epsilon = 1e-15, max_relative = 1e-12);
            }
        }
        let half = UnitQuaternion::new(axis * std::f64::consts::PI);
        assert_relative_eq!(rotation_vector(&half).norm(), std::f64::consts::PI, epsilon = 1e-12);
        assert!(rotation_vector(&of_axes(&Matrix3::from_element(f64::NAN))).iter().all(|own| own.is_nan()));
    }
}
