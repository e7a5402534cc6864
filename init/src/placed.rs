//! Where a robot's base stands among measured points: a start for the fit, from the places that its description alone gives the tip.

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use tables::urdf::{Joint, Motion};

use super::look::Read;

/// The values of `base_x` to `base_rz` at which the places of the tip come nearest to the points, as the study writes them; none of too few rows.
pub fn base(
    joints: &[&Joint],
    readings: &[(String, Read)],
    points: &[Read; 3],
) -> Vec<(&'static str, String)> {
    let rows = points[0].si.len();
    let moving: Vec<&Joint> = joints.iter().copied().filter(|joint| joint.motion != Motion::Fixed).collect();
    if rows < 3 || moving.len() != readings.len() {
        return Vec::new();
    }
    let tips: Vec<Vector3<f64>> = (0..rows)
        .map(|row| {
            let of = |joint: &Joint| {
                let at = moving.iter().position(|own| own.name == joint.name);
                at.map_or(0.0, |at| readings[at].1.si[row])
            };
            tip(joints, of).translation.vector
        })
        .collect();
    let Some((shift, angles)) = pose(&tips, &vectors(points)) else { return Vec::new() };
    let lengths = ["base_x", "base_y", "base_z"]
        .into_iter()
        .zip(shift.iter())
        .map(|(name, size)| (name, format!("{size:.4} m")));
    let angles = ["base_rx", "base_ry", "base_rz"].into_iter().zip(angles);
    lengths.chain(angles.map(|(name, angle)| (name, format!("{angle:.5} rad")))).collect()
}

/// Points out of three columns, m.
pub fn vectors(points: &[Read; 3]) -> Vec<Vector3<f64>> {
    let [x, y, z] = points;
    x.si.iter().zip(&y.si).zip(&z.si).map(|((&x, &y), &z)| Vector3::new(x, y, z)).collect()
}

/// The shift and the angles of Rx(a) Ry(b) Rz(c) that lay points over others, as many; none of points that are not finite.
///
/// Source: W. Kabsch, A discussion of the solution for the best rotation to relate two sets of vectors (1978).
pub fn pose(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<(Vector3<f64>, [f64; 3])> {
    let mean = |all: &[Vector3<f64>]| all.iter().sum::<Vector3<f64>>() / all.len() as f64;
    let (here, there) = (mean(from), mean(to));
    let mut mixed = Matrix3::zeros();
    for (from, to) in from.iter().zip(to) {
        mixed += (to - there) * (from - here).transpose();
    }
    if !mixed.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let svd = mixed.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else { unreachable!("both were asked for") };
    // Of two mirrored solutions the one that is a rotation.
    let sign = (u * v).determinant().signum();
    let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
    // Rx(a) Ry(b) Rz(c)
    let angles = [
        (-turn[(1, 2)]).atan2(turn[(2, 2)]),
        turn[(0, 2)].clamp(-1.0, 1.0).asin(),
        (-turn[(0, 1)]).atan2(turn[(0, 0)]),
    ];
    Some((there - turn * here, angles))
}

/// The frame of the tip at some readings.
fn tip(joints: &[&Joint], reading: impl Fn(&Joint) -> f64) -> Isometry3<f64> {
    joints.iter().fold(Isometry3::identity(), |place, joint| {
        let [roll, pitch, yaw] = joint.rpy;
        let origin = Isometry3::from_parts(
            Translation3::from(Vector3::from(joint.xyz)),
            UnitQuaternion::from_euler_angles(roll, pitch, yaw),
        );
        let along = Vector3::from(joint.axis) * reading(joint);
        let moved = match joint.motion {
            Motion::Turns => Isometry3::rotation(along),
            Motion::Shifts => Isometry3::translation(along.x, along.y, along.z),
            Motion::Fixed | Motion::Free => Isometry3::identity(),
        };
        place * origin * moved
    })
}
