//! Robust weights: the further an observation lies from what is predicted, the less it counts, and beyond a cutoff not at
//! all. Tukey's biweight of the norm of an observation's whitened components.
//!
//! Source: J. W. Tukey's biweight as in P. J. Huber, E. M. Ronchetti, Robust Statistics, 2nd ed., sections 4.8 and
//! 7.8; the constants for one to three components are computed by `tests/reference/biweight.py`.

/// Where the weight reaches zero, for 95 % efficiency at normal noise of one, two and three components.
const CUTOFF: [f64; 3] = [4.685_064_949, 5.122_986_090, 5.490_249_208];

/// By what the weighted mean square falls short of the variance.
const CONSISTENCY: [f64; 3] = [1.207_616_545, 1.176_955_563, 1.156_613_834];

/// The median of the norm of normal components.
const MEDIAN: [f64; 3] = [0.674_489_750, 1.177_410_023, 1.538_172_254];

/// Efficiency at normal noise, by choice of `CUTOFF`.
pub const EFFICIENCY: f64 = 0.95;

fn of(table: [f64; 3], components: usize) -> f64 {
    table[components.clamp(1, 3) - 1]
}

/// The norm at which an observation of so many components has no weight left.
#[must_use]
pub fn cutoff(components: usize) -> f64 {
    of(CUTOFF, components)
}

/// The factor that makes a weighted mean square a variance.
#[must_use]
pub fn consistency(components: usize) -> f64 {
    of(CONSISTENCY, components)
}

/// The median of the norm of so many normal components of variance one.
#[must_use]
pub fn median_norm(components: usize) -> f64 {
    of(MEDIAN, components)
}

/// The weight of an observation whose whitened components have this norm.
#[must_use]
pub fn weight(norm: f64, components: usize) -> f64 {
    let share = norm / cutoff(components);
    if share < 1.0 { (1.0 - share * share).powi(2) } else { 0.0 }
}

/// The weight's derivative by the norm.
#[must_use]
pub fn slope(norm: f64, components: usize) -> f64 {
    let cutoff = cutoff(components);
    let share = norm / cutoff;
    if share < 1.0 { -4.0 * share / cutoff * (1.0 - share * share) } else { 0.0 }
}

/// What the observation adds to the sum that the weights minimise: norm² near zero, cutoff² / 3 far away.
#[must_use]
pub fn loss(norm: f64, components: usize) -> f64 {
    let cutoff = cutoff(components);
    let share = norm / cutoff;
    let outside = if share < 1.0 { (1.0 - share * share).powi(3) } else { 0.0 };
    cutoff * cutoff / 3.0 * (1.0 - outside)
}

/// The median; of an even number the mean of the middle two. Zero of nothing.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    let even = values.len().is_multiple_of(2);
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp);
    match lower {
        Some(lower) if even => lower.midpoint(upper),
        _ => upper,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn weight_is_the_slope_of_the_loss_by_the_norm() {
        let step = 1e-6;
        for components in 1..=3 {
            for norm in [0.1, 1.0, 3.0, 5.0, 7.0] {
                let by_norm = (loss(norm + step, components) - loss(norm - step, components)) / (2.0 * step);
                assert_relative_eq!(by_norm, 2.0 * norm * weight(norm, components), epsilon = 1e-8);
                let change = weight(norm + step, components) - weight(norm - step, components);
                assert_relative_eq!(change / (2.0 * step), slope(norm, components), epsilon = 1e-8);
            }
        }
    }

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(vec![]), 0.0);
    }
}
