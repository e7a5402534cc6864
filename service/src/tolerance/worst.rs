//! The worst case: the longest vector that errors within their sizes can add up to.
//!
//! The vectors Σ ±cᵢ of a pose are the corners of a zonotope, and the longest of all lies at a corner. Each corner that counts
//! shares an edge with one that some plane through two of the columns touches, so that every pair of columns is tried: the
//! columns beside the plane go to its side, those within it to the corners of their own, flat zonotope.

use nalgebra::Vector3;

use model_core::budget::Sensitivity;

use super::Tolerance;
use super::spread::norm_squared;

/// Two directions are one, or a direction lies in a plane, within this sine.
const SINE: f64 = 1e-9;

/// The most that any combination of errors within their sizes does at each pose, rad or m.
#[must_use]
pub fn worst_case(sensitivity: &Sensitivity, tolerances: &[Tolerance]) -> Vec<f64> {
    parallel::each(sensitivity.poses(), |pose| {
        let scaled = sensitivity.at_pose(pose).iter().zip(tolerances);
        longest(scaled.map(|(column, tolerance)| Vector3::from(*column) * tolerance.size))
    })
}

/// The length of the longest sum of the columns, each with either sign.
pub(super) fn longest(columns: impl Iterator<Item = Vector3<f64>>) -> f64 {
    let apart = merged(columns);
    let Some(first) = apart.first() else { return 0.0 };
    let Some(plane) = apart.iter().skip(1).map(|other| first.cross(other)).next() else {
        return first.norm();
    };
    let mut best = 0.0_f64;
    if apart.iter().all(|column| within(column, &plane)) {
        return longest_in_plane(&Vector3::zeros(), &plane, &apart).sqrt();
    }
    for (at, a) in apart.iter().enumerate() {
        for b in &apart[at + 1..] {
            let normal = a.cross(b);
            let (mut beside, mut flat) = (Vector3::zeros(), Vec::new());
            for column in &apart {
                if within(column, &normal) {
                    flat.push(*column);
                } else {
                    beside += column * column.dot(&normal).signum();
                }
            }
            best = best.max(longest_in_plane(&beside, &normal, &flat));
        }
    }
    best.sqrt()
}

/// Whether a column lies in the plane of a normal.
fn within(column: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
    column.dot(normal).abs() <= SINE * column.norm() * normal.norm()
}

/// The square of the longest sum of a vector and columns that lie in one plane, each with either sign.
fn longest_in_plane(beside: &Vector3<f64>, normal: &Vector3<f64>, flat: &[Vector3<f64>]) -> f64 {
    let mut best = 0.0_f64;
    for (edge, along) in flat.iter().enumerate() {
        let across = normal.cross(along);
        let others = flat.iter().enumerate().filter(|(other, _)| *other != edge);
        let corner: Vector3<f64> = others.map(|(_, column)| column * column.dot(&across).signum()).sum();
        for corner in [corner, -corner] {
            for along in [*along, -along] {
                best = best.max((beside + corner + along).norm_squared());
            }
        }
    }
    best
}

/// The columns that are not zero, those of one direction added up.
fn merged(columns: impl Iterator<Item = Vector3<f64>>) -> Vec<Vector3<f64>> {
    let columns: Vec<Vector3<f64>> = columns.collect();
    let largest = columns.iter().map(|column| norm_squared(&(*column).into())).fold(0.0, f64::max).sqrt();
    let mut apart: Vec<Vector3<f64>> = Vec::new();
    for column in columns {
        // A rounding error is no direction.
        if column.norm() <= 1e-14 * largest {
            continue;
        }
        let same =
            |other: &&mut Vector3<f64>| column.cross(other).norm() <= SINE * column.norm() * other.norm();
        match apart.iter_mut().find(same) {
            Some(other) => *other += column * column.dot(other).signum(),
            None => apart.push(column),
        }
    }
    apart
}
