//! What an observation remembers of the one before: ARMA(1,1) by conditional maximum likelihood.

use super::{Layout, Serial};

/// Components below which no serial correlation is looked for.
const FEWEST: usize = 60;

/// The closest to 1 that a coefficient may come.
const LARGEST: f64 = 0.999;

/// Values further out than this count as this far, so that outliers do not decide.
const CLIP: f64 = 3.0;

/// The serial correlation of values of variance one, in order; `None` if the data do not bear it out.
pub fn fit(layout: &Layout, scaled: &[f64]) -> Option<Serial> {
    if scaled.len() < FEWEST {
        return None;
    }
    let clipped: Vec<f64> = scaled.iter().map(|value| value.clamp(-CLIP, CLIP)).collect();
    let sum = |serial: Serial| {
        let mut column = clipped.clone();
        for &run in &layout.runs {
            serial.whiten(&mut column, run);
        }
        column.iter().map(|e| e * e).sum::<f64>()
    };
    let serial = |[autoregressive, moving_average]: [f64; 2]| Serial { autoregressive, moving_average };
    let without: f64 = clipped.iter().map(|x| x * x).sum();
    let mut best = ([0.0, 0.0], without);
    for autoregressive in [-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9, 0.97, 0.99, 0.995] {
        for moving_average in [-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9] {
            let at = [autoregressive, moving_average];
            let value = sum(serial(at));
            if value < best.1 {
                best = (at, value);
            }
        }
    }
    // Pattern search from the best of the grid: two parameters, a smooth function.
    let mut reach = 0.15;
    while reach > 1e-4 {
        let around =
            [[reach, 0.0], [-reach, 0.0], [0.0, reach], [0.0, -reach], [reach, -reach], [-reach, reach]];
        let moved = around.map(|step| {
            let at = [0, 1].map(|axis| (best.0[axis] + step[axis]).clamp(-LARGEST, LARGEST));
            (at, sum(serial(at)))
        });
        match moved.into_iter().filter(|(_, value)| *value < best.1).min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some(better) => best = better,
            None => reach /= 2.0,
        }
    }
    let n = clipped.len() as f64;
    // Twice the gain in log likelihood against what two parameters must earn.
    let gain = n * (without / best.1.max(f64::MIN_POSITIVE)).ln();
    (gain > 2.0 * n.ln()).then(|| serial(best.0))
}
