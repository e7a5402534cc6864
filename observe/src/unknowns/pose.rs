//! Where an instrument stood: a rigid motion, changed by six numbers that count from where it was taken to be.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// A rigid motion from the frame of the chain into that of the objects: x = turn · p + shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The turn.
    pub turn: Rotation3<f64>,
    /// The shift, m.
    pub shift: Vector3<f64>,
}

impl Default for Pose {
    fn default() -> Self {
        Self { turn: Rotation3::identity(), shift: Vector3::zeros() }
    }
}

impl Pose {
    /// From a shift in m and the turns roll about x, pitch about y, heading about z in rad, the heading outermost.
    #[must_use]
    pub fn new(shift_m: Vector3<f64>, roll_rad: f64, pitch_rad: f64, heading_rad: f64) -> Self {
        Self { turn: Rotation3::from_euler_angles(roll_rad, pitch_rad, heading_rad), shift: shift_m }
    }

    /// A point of the chain's frame in that of the objects.
    #[must_use]
    pub fn apply(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.turn * point + self.shift
    }

    /// A point of the objects' frame in that of the chain.
    #[must_use]
    pub fn back(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.turn.inverse() * (point - self.shift)
    }

    /// Roll, pitch and heading, rad, and their derivatives by a small turn about each axis of the chain's frame.
    #[must_use]
    pub fn angles(&self) -> ([f64; 3], Matrix3<f64>) {
        let (roll, pitch, heading) = self.turn.euler_angles();
        let ((sine, cosine), up) = (roll.sin_cos(), pitch.cos());
        let tilted = pitch.tan();
        #[rustfmt::skip]
        let by_turn = Matrix3::new(
            1.0, sine * tilted, cosine * tilted,
            0.0, cosine,        -sine,
            0.0, sine / up,     cosine / up,
        );
        ([roll, pitch, heading], by_turn)
    }

    /// This motion after another.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        Self { turn: self.turn * first.turn, shift: self.apply(&first.shift) }
    }

    /// The motion that undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { turn: self.turn.inverse(), shift: -(self.turn.inverse() * self.shift) }
    }

    /// The pose changed by a shift in m and by a turn, rad, about an axis of the chain's frame.
    #[must_use]
    pub fn moved(&self, by: &[f64; 6]) -> Self {
        let [x, y, z, a, b, c] = *by;
        Self {
            turn: self.turn * Rotation3::new(Vector3::new(a, b, c)),
            shift: self.shift + Vector3::new(x, y, z),
        }
    }
}

/// The small turn, about axes of the chain's frame, that follows a turn by `w` when `w` changes by a unit of each.
///
/// Source: the right Jacobian of SO(3), J. Solà et al., A micro Lie theory for state estimation in robotics,
/// arXiv:1812.01537, equation (143).
pub fn right_jacobian(w: &Vector3<f64>) -> Matrix3<f64> {
    let angle = w.norm();
    let cross = w.cross_matrix();
    let (first, second) = if angle < 1e-4 {
        (0.5 - angle * angle / 24.0, 1.0 / 6.0 - angle * angle / 120.0)
    } else {
        ((1.0 - angle.cos()) / angle.powi(2), (angle - angle.sin()) / angle.powi(3))
    };
    Matrix3::identity() - cross * first + cross * cross * second
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_is_that_of_the_turn() {
        for w in [Vector3::new(0.3, -0.8, 1.1), Vector3::new(2e-5, 1e-5, -3e-5)] {
            let jacobian = right_jacobian(&w);
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = 1e-6;
                let change = Rotation3::new(w - step).inverse() * Rotation3::new(w + step);
                // Of so small a turn the antisymmetric part; its cosine would have lost the digits.
                let matrix = change.matrix();
                let across = matrix - matrix.transpose();
                let small = Vector3::new(across[(2, 1)], across[(0, 2)], across[(1, 0)]) / 4e-6;
                assert!((small - jacobian.column(axis)).norm() < 1e-8, "{small}");
            }
        }
    }

    #[test]
    fn angles_change_with_small_turns() {
        let pose = Pose::new(Vector3::zeros(), 0.4, -0.7, 2.0);
        let ([roll, pitch, heading], by_turn) = pose.angles();
        assert!((Vector3::new(roll, pitch, heading) - Vector3::new(0.4, -0.7, 2.0)).norm() < 1e-12);
        for axis in 0..3 {
            let mut by = [0.0; 6];
            by[3 + axis] = 1e-6;
            let (after, _) = pose.moved(&by).angles();
            let change = (Vector3::from(after) - Vector3::new(roll, pitch, heading)) / 1e-6;
            assert!((change - by_turn.column(axis)).norm() < 1e-5, "{axis}: {change}");
        }
    }

    #[test]
    fn a_pose_goes_there_and_back() {
        let pose =
            Pose::new(Vector3::new(1.0, 2.0, 3.0), 0.1, -0.2, 2.5).moved(&[0.1, 0.0, -0.2, 0.3, 0.1, 0.5]);
        let point = Vector3::new(-4.0, 5.0, 6.0);
        assert!((pose.back(&pose.apply(&point)) - point).norm() < 1e-12);
        assert!((pose.inverse().after(&pose).apply(&point) - point).norm() < 1e-12);
    }
}
