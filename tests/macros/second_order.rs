//! Exact and first-order form agree to second order.
//!
//! Source: Taylor's theorem. What the first-order form drops is, for small errors, a quadratic form in them, so that
//! halving all errors divides the difference by four: its logarithm against that of the errors has slope 2.

use trueaxis::model_core::SymbolKind;

use super::chains::{CASES, Case, count, numbers};

const POSES: usize = 20;
/// Sizes of errors, each half of the one before: from 3e-3 over more than three decades.
const LARGEST: f64 = 3e-3;
const HALVINGS: i32 = 11;

#[test]
fn halving_all_errors_divides_the_difference_by_four() {
    for case in &CASES {
        let exponent = fitted_exponent(case);
        assert!((exponent - 2.0).abs() < 0.02, "{} {}: exponent {exponent}", case.file, case.observable);
    }
}

/// The slope of log RMS difference against log size, by least squares.
fn fitted_exponent(case: &Case) -> f64 {
    let (chain, _) = case.chain();
    let errors = count(&chain, &[SymbolKind::Error]);
    let pose = count(&chain, &[SymbolKind::Joint, SymbolKind::Input]);
    let points: Vec<(f64, f64)> = (0..=HALVINGS)
        .map(|halving| {
            let size = LARGEST * 0.5_f64.powi(halving);
            let mut random = numbers(1);
            let mut square = 0.0;
            for _ in 0..POSES {
                let errors: Vec<f64> = random.by_ref().take(errors).map(|number| number * size).collect();
                let pose: Vec<f64> = random.by_ref().take(pose).collect();
                let answers = (case.answer)(&errors, &pose);
                square += (answers.error - answers.first_order).norm_squared();
            }
            (size.ln(), (square / POSES as f64).sqrt().ln())
        })
        .collect();
    let n = points.len() as f64;
    let (mean_x, mean_y) =
        (points.iter().map(|(x, _)| x).sum::<f64>() / n, points.iter().map(|(_, y)| y).sum::<f64>() / n);
    let covariance: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    covariance / variance
}
