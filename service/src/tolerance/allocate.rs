//! Sizes for a wanted error: those of least cost whose root sum square over the poses is what is wanted.

use model_core::budget::Sensitivity;

use super::Tolerance;
use super::spread::norm_squared;

/// What is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// The root sum square over the poses, rad or m.
    pub wanted: f64,
    /// What each error's present size costs; half of it costs twice that.
    pub costs: Vec<f64>,
    /// The smallest size that each error can be held to, SI.
    pub finest: Vec<f64>,
}

/// Sizes that keep a wanted error.
#[derive(Debug, Clone, PartialEq)]
pub struct Allocation {
    /// The size of each error, SI; none where the error does nothing here, so that it may have any.
    pub sizes: Vec<Option<f64>>,
    /// The cost now, and that of the allocation, of the errors that do something.
    pub costs: (f64, f64),
}

/// Why no sizes keep a wanted error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotAllocated {
    /// The finest sizes do more.
    #[error(
        "with every error at its finest the root sum square is {smallest:e}, above the {wanted:e} that is wanted"
    )]
    Unreachable {
        /// The least that can be reached, rad or m.
        smallest: f64,
        /// What is wanted, rad or m.
        wanted: f64,
    },
    /// Means that are not zero move everything at once.
    #[error(
        "the table's mean is not zero, and sizes are allocated to errors that may go either way; shift the table"
    )]
    Mean,
    /// Nothing to allocate to.
    #[error("no error with a size does anything at these poses")]
    Nothing,
}

/// Allocates: of the sizes sᵢ with Σ aᵢ sᵢ² = wanted², those of least Σ kᵢ sᵢ⁰ / sᵢ, none below its finest.
///
/// Source: the reciprocal cost of a tolerance, K. W. Chase and W. H. Greenwood, "Design issues in mechanical tolerance
/// analysis", Manufacturing Review 1 (1988) 50-59. By Lagrange, sᵢ³ is proportional to kᵢ sᵢ⁰ / aᵢ.
///
/// # Errors
/// See [`NotAllocated`].
pub fn allocate(
    sensitivity: &Sensitivity,
    tolerances: &[Tolerance],
    wish: &Wish,
) -> Result<Allocation, NotAllocated> {
    if tolerances.iter().any(|tolerance| tolerance.distribution.mean().abs() > 1e-9) {
        return Err(NotAllocated::Mean);
    }
    let poses = sensitivity.poses().max(1) as f64;
    // The mean square for a size of one.
    let weights: Vec<f64> = tolerances
        .iter()
        .enumerate()
        .map(|(error, tolerance)| {
            let columns =
                (0..sensitivity.poses()).map(|pose| norm_squared(&sensitivity.at_pose(pose)[error]));
            columns.sum::<f64>() / poses * tolerance.distribution.standard_deviation().powi(2)
        })
        .collect();
    let most = weights.iter().zip(tolerances).map(|(a, t)| a * t.size * t.size).fold(0.0, f64::max);
    if most == 0.0 {
        return Err(NotAllocated::Nothing);
    }
    let acts: Vec<bool> =
        weights.iter().zip(tolerances).map(|(a, t)| a * t.size * t.size > 1e-24 * most).collect();
    let shape: Vec<f64> = (0..weights.len())
        .map(|at| if acts[at] { (wish.costs[at] * tolerances[at].size / weights[at]).cbrt() } else { 0.0 })
        .collect();
    let sizes = |scale: f64| -> Vec<f64> {
        shape.iter().zip(&wish.finest).map(|(shape, finest)| (scale * shape).max(*finest)).collect()
    };
    let reached = |sizes: &[f64]| {
        let squares = sizes.iter().zip(&weights).zip(&acts).filter(|(_, acts)| **acts);
        squares.map(|((size, weight), _)| weight * size * size).sum::<f64>().sqrt()
    };
    let smallest = reached(&sizes(0.0));
    if smallest >= wish.wanted || wish.wanted.is_nan() {
        return Err(NotAllocated::Unreachable { smallest, wanted: wish.wanted });
    }
    // Above this scale the errors without a finest size alone reach what is wanted.
    let (mut low, mut high) = (0.0, 1.0);
    while reached(&sizes(high)) < wish.wanted {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if reached(&sizes(middle)) < wish.wanted { low = middle } else { high = middle }
    }
    let found = sizes(low);
    let cost = |sizes: &dyn Fn(usize) -> f64| {
        let acting = (0..weights.len()).filter(|&at| acts[at]);
        acting.map(|at| wish.costs[at] * tolerances[at].size / sizes(at)).sum::<f64>()
    };
    let costs = (cost(&|at| tolerances[at].size), cost(&|at| found[at]));
    let sizes = found.into_iter().zip(&acts).map(|(size, acts)| acts.then_some(size)).collect();
    Ok(Allocation { sizes, costs })
}
