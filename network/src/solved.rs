//! What points and lengths say in closed form: the flattest plane, a circle, an anchor.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::rows::Row;
use fit::robust;
use observe::tangent_frame;
use observe::unknowns::Pose;

/// Singular values below this share of the largest are none: points in a line or a plane.
pub(super) const FLAT: f64 = 1e-6;

/// A point lies nowhere near others where it is so many times as far from their median as they are.
const OUTLYING: f64 = 10.0;

/// Whether points leave a turn about their line open.
pub fn is_in_a_line(points: &[Vector3<f64>]) -> bool {
    let Some((_, spread)) = spread(points.iter().copied()) else { return true };
    let values = spread.symmetric_eigenvalues();
    let mut values = [values[0], values[1], values[2]];
    values.sort_by(f64::total_cmp);
    points.len() < 3 || values[1] <= FLAT * FLAT * values[2]
}

/// The centre of points and the sum of squares about it.
pub(super) fn spread(
    points: impl Iterator<Item = Vector3<f64>> + Clone,
) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let count = points.clone().count();
    let centre = points.clone().sum::<Vector3<f64>>() / count as f64;
    let squares = points.map(|point| (point - centre) * (point - centre).transpose()).sum();
    (count > 0).then_some((centre, squares))
}

/// The mean of points without those many times as far from their median as is usual; none of no points.
pub(super) fn middle(points: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let along = |axis: usize| robust::median(points.iter().map(|point| point[axis]).collect());
    let median = Vector3::new(along(0), along(1), along(2));
    let away = |point: &Vector3<f64>| (point - median).norm();
    let usual = robust::median(points.iter().map(away).collect());
    let near: Vec<&Vector3<f64>> = points.iter().filter(|point| away(point) <= OUTLYING * usual).collect();
    let count = near.len() as f64;
    (count > 0.0).then(|| near.into_iter().sum::<Vector3<f64>>() / count)
}

/// The direction in which points are spread least, of its two ways the one whose largest part is positive; `None` for points in a
/// line.
pub(super) fn flattest(squares: Matrix3<f64>) -> Option<Vector3<f64>> {
    let eigen = squares.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    if eigen.eigenvalues[order[1]] <= FLAT * FLAT * eigen.eigenvalues[order[2]] {
        return None;
    }
    let normal: Vector3<f64> = eigen.eigenvectors.column(order[0]).into();
    let larger = |most: f64, part: f64| if part.abs() > most.abs() { part } else { most };
    let largest = normal.iter().copied().fold(0.0, larger);
    Some(normal * largest.signum())
}

/// The axis, centre and radius of a circle through points with this mean and these squares about it; `None` where they do not say.
pub(super) fn circle(
    points: &[Vector3<f64>],
    mean: &Vector3<f64>,
    squares: Matrix3<f64>,
) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
    let axis = flattest(squares).filter(|_| points.len() >= 3)?;
    let [across, along] = tangent_frame(&axis);
    // |x|² = 2 x·c + (r² − |c|²) in the plane: linear in c and what is in the brackets.
    let places = points.iter().map(|point| [(point - mean).dot(&across), (point - mean).dot(&along)]);
    let places: Vec<[f64; 2]> = places.collect();
    let matrix = DMatrix::from_fn(places.len(), 3, |i, j| if j < 2 { 2.0 * places[i][j] } else { 1.0 });
    let right = DVector::from_fn(places.len(), |i, _| places[i].iter().map(|part| part * part).sum());
    let svd = matrix.svd(true, true);
    if svd.singular_values.min() <= FLAT * svd.singular_values.max() {
        return None;
    }
    let solved = svd.solve(&right, 0.0).ok()?;
    let radius = (solved[2] + solved[0] * solved[0] + solved[1] * solved[1]).sqrt();
    Some((axis, mean + across * solved[0] + along * solved[1], radius))
}

/// The anchor of lengths to known points, and with a fourth number what each length lacks; `None` where these points do not
/// say.
pub(super) fn trilaterated<const N: usize>(rows: &[&Row], poses: &[Pose]) -> Option<[f64; N]> {
    let lengths_m: Vec<f64> = rows
        .iter()
        .map(|row| match row.measured.length_m() {
            Some(length_m) => length_m,
            None => unreachable!("the rows measure lengths"),
        })
        .collect();
    let points: Vec<Vector3<f64>> =
        rows.iter().zip(poses).map(|(row, pose)| pose.apply(&row.point)).collect();
    // Lengths that are all one, as those of a sphere, lack what the constant says.
    let is_one = lengths_m.iter().all(|length| *length == lengths_m[0]);
    let numbers = if is_one { 3 } else { N };
    // |x|² − L² = 2 x·a + 2 L z − (|a|² − z²): linear in a, z and what is in the brackets.
    let matrix = DMatrix::from_fn(rows.len(), numbers + 1, |i, j| match j {
        0..3 => 2.0 * points[i][j],
        _ if j < numbers => 2.0 * lengths_m[i],
        _ => -1.0,
    });
    let right = DVector::from_fn(rows.len(), |i, _| points[i].norm_squared() - lengths_m[i].powi(2));
    if rows.len() <= numbers {
        return None;
    }
    let svd = matrix.svd(true, true);
    if svd.singular_values.min() <= FLAT * svd.singular_values.max() {
        return None;
    }
    let solved = svd.solve(&right, 0.0).ok()?;
    let lacks = || {
        let squares: f64 = (0..3).map(|axis| solved[axis] * solved[axis]).sum();
        (squares - solved[3] + lengths_m[0].powi(2)).max(0.0).sqrt() - lengths_m[0]
    };
    Some(std::array::from_fn(|at| if at == 3 && is_one { lacks() } else { solved[at] }))
}
