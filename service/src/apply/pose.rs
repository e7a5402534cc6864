//! Wanted poses of a body as tables have them: a point, and how the body is turned.

use model_core::{Chain, ObservableId, Quantity};
use nalgebra::UnitQuaternion;
use study::{OrientationForm, axes_in_turn};

use super::solve::with_axes;
use crate::evaluation::{Evaluator, Exactness, Quantity as Computed};
use crate::sensitivity::without_errors;

/// How a wanted pose is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseForm {
    /// As a point and an orientation.
    Turned(OrientationForm),
    /// As the readings with which an instrument without errors would be there.
    Joints,
}

impl std::str::FromStr for PoseForm {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let usage = "write quaternion, matrix, vector, joints, or three angles by their axes, as euler-zyx";
        Ok(match text {
            "quaternion" => Self::Turned(OrientationForm::Quaternion),
            "matrix" => Self::Turned(OrientationForm::Matrix),
            "vector" => Self::Turned(OrientationForm::Vector),
            "joints" => Self::Joints,
            other => {
                let axes = other.strip_prefix("euler-").and_then(axes_in_turn).ok_or(usage)?;
                Self::Turned(OrientationForm::Euler(axes))
            }
        })
    }
}

impl PoseForm {
    /// The names of the columns that are read beside readings, and what they measure.
    #[must_use]
    pub fn columns(self, chain: &Chain, point: ObservableId) -> Vec<(String, Quantity)> {
        let Self::Turned(form) = self else { return Vec::new() };
        let name = &chain.observable(point).name;
        let place = ["x", "y", "z"].map(|part| (format!("{name}_{part}"), Quantity::Length));
        let turned = form.keys().iter().map(|key| match form {
            // The place has x, y and z already.
            OrientationForm::Quaternion => (format!("{name}_q{key}"), form.quantity()),
            _ => (format!("{name}_{key}"), form.quantity()),
        });
        place.into_iter().chain(turned).collect()
    }

    /// The pose that one row of these columns says: a point, then the three axes of the body.
    ///
    /// # Errors
    /// Why the numbers say none.
    pub fn read(self, columns: &[Vec<f64>], row: usize) -> Result<[f64; 12], String> {
        let Self::Turned(form) = self else { return Err("readings say no pose by themselves".to_owned()) };
        let numbers = |at: usize| columns[at][row];
        let turned = form.read(|at| numbers(3 + at), UnitQuaternion::identity)?;
        let axes = turned.to_rotation_matrix();
        let mut pose = [0.0; 12];
        pose[..3].copy_from_slice(&[numbers(0), numbers(1), numbers(2)]);
        pose[3..].copy_from_slice(axes.matrix().as_slice());
        if pose.iter().all(|part| part.is_finite()) {
            Ok(pose)
        } else {
            Err("a number is missing".to_owned())
        }
    }
}

/// What computes the pose of the body that a point is fixed to: of an instrument without errors.
#[must_use]
pub fn nominal_pose(chain: &Chain, point: ObservableId, values: &[f64]) -> Evaluator {
    let (posed, observables) = with_axes(chain, point);
    let without = without_errors(chain, values);
    Evaluator::new(&posed, observables, Exactness::Exact, Computed::Value, &without)
}
