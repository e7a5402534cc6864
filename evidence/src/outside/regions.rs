//! Regions of the measured rows that are left out, and distances between poses.

use faer::Mat;

use crate::policy::Policy;

/// Leading directions of the poses whose ends are left out on a chain of many joints.
const DIRECTIONS: usize = 3;
/// Fewest rows of a region.
const FEWEST: usize = 4;

/// An end of a joint or of a direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The low end.
    Low,
    /// The high end.
    High,
}

/// Rows that are left out together.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// The joint, or on a chain of many joints the leading direction of the poses.
    pub axis: usize,
    /// Which end.
    pub side: Side,
    /// The rows, in order.
    pub rows: Vec<usize>,
}

/// Both ends of each joint of a few, or of the leading directions of the poses of many.
#[must_use]
pub fn regions(poses: &[Vec<f64>], policy: &Policy) -> Vec<Region> {
    let rows = poses.len();
    let size = ((rows as f64 * policy.region_part).round() as usize).max(FEWEST);
    let joints = poses.first().map_or(0, Vec::len);
    if joints == 0 || size >= rows {
        return Vec::new();
    }
    let axes: Vec<Vec<f64>> = if joints as f64 <= policy.few_joints {
        (0..joints).map(|joint| poses.iter().map(|pose| pose[joint]).collect()).collect()
    } else {
        directions(poses)
    };
    let mut regions = Vec::with_capacity(2 * axes.len());
    for (axis, values) in axes.iter().enumerate() {
        let mut order: Vec<usize> = (0..rows).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
        for (side, part) in [(Side::Low, &order[..size]), (Side::High, &order[rows - size..])] {
            let mut rows = part.to_vec();
            rows.sort_unstable();
            regions.push(Region { axis, side, rows });
        }
    }
    regions
}

/// Coordinates of the poses along their leading directions, each joint by its spread.
fn directions(poses: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let spread = spreads(poses);
    let means = means(poses);
    let scaled = Mat::from_fn(poses.len(), spread.len(), |row, joint| {
        (poses[row][joint] - means[joint]) / spread[joint]
    });
    let Ok(svd) = scaled.thin_svd() else { return Vec::new() };
    let along = &scaled * svd.V();
    let count = DIRECTIONS.min(along.ncols());
    (0..count).map(|at| (0..poses.len()).map(|row| along[(row, at)]).collect()).collect()
}

fn means(poses: &[Vec<f64>]) -> Vec<f64> {
    let joints = poses.first().map_or(0, Vec::len);
    (0..joints).map(|joint| poses.iter().map(|pose| pose[joint]).sum::<f64>() / poses.len() as f64).collect()
}

/// Standard deviation of each joint; one where it does not move.
pub(super) fn spreads(poses: &[Vec<f64>]) -> Vec<f64> {
    let spread = |(joint, mean): (usize, f64)| {
        let sum: f64 = poses.iter().map(|pose| (pose[joint] - mean).powi(2)).sum();
        let deviation = (sum / poses.len() as f64).sqrt();
        if deviation > 0.0 { deviation } else { 1.0 }
    };
    means(poses).into_iter().enumerate().map(spread).collect()
}

/// Distance of a pose to the nearest of some rows, joints by their spread, a row itself left aside.
pub(super) fn nearest(
    pose: &[f64],
    poses: &[Vec<f64>],
    among: impl Iterator<Item = usize>,
    spread: &[f64],
) -> f64 {
    let distance = |row: usize| {
        let parts = pose.iter().zip(&poses[row]).zip(spread);
        parts.map(|((a, b), spread)| ((a - b) / spread).powi(2)).sum::<f64>()
    };
    among.map(distance).fold(f64::INFINITY, f64::min).sqrt()
}

/// The value below which a part of some values lies.
pub(super) fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = part * (sorted.len().saturating_sub(1)) as f64;
    let (low, high) = (at.floor() as usize, at.ceil() as usize);
    sorted.get(low).map_or(0.0, |&below| below + (sorted[high] - below) * (at - at.floor()))
}
