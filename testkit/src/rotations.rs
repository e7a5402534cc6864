//! Rotations by hand, about the axes x, y and z: 0, 1 and 2.

use nalgebra::Matrix3;

/// A point or direction turned about an axis by an angle, rad.
#[must_use]
pub fn turned(axis: usize, angle: f64, point: [f64; 3]) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut out = point;
    out[i] = cosine * point[i] - sine * point[j];
    out[j] = sine * point[i] + cosine * point[j];
    out
}

/// The matrix that turns about an axis by an angle, rad.
#[must_use]
pub fn rotation(axis: usize, angle: f64) -> Matrix3<f64> {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Matrix3::from_columns(&columns.map(|column| turned(axis, angle, column).into()))
}
