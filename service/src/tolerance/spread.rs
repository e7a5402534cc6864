//! The root sum square: what to expect of independent errors at each pose, and the share of each error in it.

use model_core::budget::Sensitivity;

use super::Tolerance;

/// What to expect at each pose, and over all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// The root of the expected square at each pose, rad or m.
    pub by_pose: Vec<f64>,
    /// Its root mean square over the poses.
    pub rms: f64,
    /// The share of each error in the mean square, 0 to 1; what is missing to one comes from means that are not zero.
    pub shares: Vec<f64>,
}

impl Spread {
    /// From the squares of each error at each pose, pose by pose, and what else is expected at each.
    pub(super) fn new(errors: usize, poses: impl Iterator<Item = (Vec<f64>, f64)>) -> Self {
        let mut sums = vec![0.0; errors];
        let mut by_pose = Vec::new();
        for (squares, other) in poses {
            by_pose.push((squares.iter().sum::<f64>() + other).sqrt());
            sums.iter_mut().zip(&squares).for_each(|(sum, square)| *sum += square);
        }
        let count = by_pose.len().max(1) as f64;
        let mean = by_pose.iter().map(|value| value * value).sum::<f64>() / count;
        let share = |sum: f64| if mean > 0.0 { sum / count / mean } else { 0.0 };
        Self { rms: mean.sqrt(), shares: sums.into_iter().map(share).collect(), by_pose }
    }

    /// The largest of the poses, with its place among them.
    #[must_use]
    pub fn largest(&self) -> (usize, f64) {
        largest(&self.by_pose)
    }
}

/// The largest value and its place, the first of equals.
pub(super) fn largest(values: &[f64]) -> (usize, f64) {
    let better =
        |best: (usize, f64), (at, &value): (usize, &f64)| if value > best.1 { (at, value) } else { best };
    values.iter().enumerate().fold((0, 0.0), better)
}

/// What to expect of independent errors: √(Σ |cᵢ|² σᵢ² + |Σ cᵢ μᵢ|²) with the columns cᵢ of a pose.
///
/// `tolerances` in the order of the sensitivity's errors.
#[must_use]
pub fn root_sum_square(sensitivity: &Sensitivity, tolerances: &[Tolerance]) -> Spread {
    let sigma: Vec<f64> = tolerances.iter().map(Tolerance::standard_deviation).collect();
    let mean: Vec<f64> = tolerances.iter().map(Tolerance::mean).collect();
    let pose = |pose: usize| {
        let columns = sensitivity.at_pose(pose);
        let square = |(column, sigma): (&[f64; 3], &f64)| norm_squared(column) * sigma * sigma;
        let shift =
            [0, 1, 2].map(|axis| columns.iter().zip(&mean).map(|(c, mean)| c[axis] * mean).sum::<f64>());
        (columns.iter().zip(&sigma).map(square).collect(), norm_squared(&shift))
    };
    Spread::new(tolerances.len(), (0..sensitivity.poses()).map(pose))
}

pub(super) fn norm_squared(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum()
}
