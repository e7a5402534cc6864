//! One step of a solution, and how far what is shown is from what is wanted.

use nalgebra::{DMatrix, DVector};

/// Directions that the joints hardly move, against the one that they move most.
const WEAK: f64 = 1e-9;

/// The angle between two bodies, rad, from their axes.
pub(super) fn turn(wanted: &[f64], shown: &[f64]) -> f64 {
    // The sum of squares of the three differences is 8 sin²(angle/2).
    2.0 * (apart(wanted, shown) / 8.0_f64.sqrt()).min(1.0).asin()
}

pub(super) fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The distance of two points, m.
pub(crate) fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    apart(a, b)
}

/// The shortest step that takes away what is left, damped; zero where the derivatives are no numbers. And the share of the worst moved of so
/// many directions in the best.
pub(super) fn step(
    slope: DMatrix<f64>,
    left: &DVector<f64>,
    damping: f64,
    freedoms: usize,
) -> (Vec<f64>, f64) {
    let joints = slope.ncols();
    if slope.iter().chain(left.iter()).any(|value| !value.is_finite()) {
        return (vec![0.0; joints], 1.0);
    }
    let parts = slope.svd(true, true);
    let (Some(u), Some(v)) = (&parts.u, &parts.v_t) else { unreachable!("both factors were asked for") };
    let most = parts.singular_values.max();
    let share = parts.singular_values.get(freedoms.saturating_sub(1)).map_or(0.0, |least| least / most);
    let mut step = vec![0.0; joints];
    for (at, &length) in parts.singular_values.iter().enumerate().filter(|(_, length)| **length > WEAK * most)
    {
        let along = u.column(at).dot(left) * length / (length * length + damping * most * most);
        step.iter_mut().zip(v.row(at).iter()).for_each(|(step, part)| *step += along * part);
    }
    (step, share)
}
