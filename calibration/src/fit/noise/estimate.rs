//! The noise model from residuals: first the floors, then what varies with the joints, then what remembers.

use model_core::Chain;

use super::{Layout, Noise, NoiseOptions, serial, variance};
use crate::data::Observations;
use crate::fit::robust;

/// Floors from medians alone: what a fit starts from, before it has weights.
#[must_use]
pub fn from_medians(
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
    residual: &[f64],
) -> Noise {
    let stated = stated(options, observations, layout);
    let median = |kind| {
        let scaled = of_kind(layout, kind).map(|at| (residual[at] / stated[at]).abs()).collect();
        robust::median(scaled) / robust::median_norm(1)
    };
    let floor = match options.known() {
        Some(sigma) => vec![sigma; layout.kinds],
        None => (0..layout.kinds).map(median).collect(),
    };
    finish(Noise { floor, ..Noise::default() }, observations, layout, &stated)
}

/// The noise that has these floors and nothing else.
#[must_use]
pub fn of_floors(
    floor: Vec<f64>,
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
) -> Noise {
    let stated = stated(options, observations, layout);
    finish(Noise { floor, ..Noise::default() }, observations, layout, &stated)
}

/// The noise model from raw residuals, the weights of the rows, and the number of combinations that were fitted.
#[must_use]
pub fn estimate(
    chain: &Chain,
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
    residual: &[f64],
    weight: &[f64],
    rank: usize,
) -> Noise {
    let stated = stated(options, observations, layout);
    let robust_weights = weight.iter().any(|&weight| weight < 1.0);
    let n = layout.components() as f64;
    let lost = n / (n - rank as f64).max(1.0);
    let floors = |spread: &[f64]| -> Vec<f64> {
        (0..layout.kinds)
            .map(|kind| {
                let (mut weights, mut squares) = (0.0, 0.0);
                let mut stride = 1;
                for at in of_kind(layout, kind) {
                    let row = layout.row[at] as usize;
                    weights += weight[row];
                    squares += weight[row] * (residual[at] / spread[at]).powi(2);
                    stride = layout.first[row + 1] - layout.first[row];
                }
                let consistency = if robust_weights { robust::consistency(stride) } else { 1.0 };
                if weights > 0.0 { (consistency * lost * squares / weights).sqrt() } else { 0.0 }
            })
            .collect()
    };
    let floor = options.known().map_or_else(|| floors(&stated), |sigma| vec![sigma; layout.kinds]);
    let mut noise = finish(Noise { floor, ..Noise::default() }, observations, layout, &stated);
    if options.variance && options.sigma.is_none() {
        let scaled: Vec<f64> = residual.iter().zip(&noise.sigma).map(|(r, sigma)| r / sigma).collect();
        if let Some((model, factor)) = variance::fit(chain, observations, layout, &scaled, weight) {
            let spread: Vec<f64> =
                stated.iter().zip(&layout.row).map(|(sigma, &row)| sigma * factor[row as usize]).collect();
            noise = Noise { floor: floors(&spread), variance: Some(model), ..Noise::default() };
            noise = finish(noise, observations, layout, &spread);
        }
    }
    if options.serial && observations.in_sequence {
        let scaled: Vec<f64> = residual.iter().zip(&noise.sigma).map(|(r, sigma)| r / sigma).collect();
        if let Some(found) = serial::fit(layout, &scaled) {
            for sigma in &mut noise.sigma {
                *sigma /= found.gain();
            }
            noise.serial = Some(found);
        }
    }
    noise
}

/// What the data state per component, up to a factor: 1 where they state nothing.
fn stated(options: &NoiseOptions, observations: &Observations, layout: &Layout) -> Vec<f64> {
    if observations.sigma.is_empty() || options.sigma.is_some() {
        return vec![1.0; layout.components()];
    }
    let mut stated = Vec::with_capacity(layout.components());
    for (ends, sigma) in layout.first.windows(2).zip(&observations.sigma) {
        stated.extend(sigma.iter().take(ends[1] - ends[0]));
    }
    stated
}

fn of_kind(layout: &Layout, kind: usize) -> impl Iterator<Item = usize> {
    (0..layout.components()).filter(move |&at| usize::from(layout.kind[at]) == kind)
}

/// Spreads the floors over the components. No standard deviation is smaller than what the numbers resolve.
fn finish(mut noise: Noise, observations: &Observations, layout: &Layout, spread: &[f64]) -> Noise {
    let resolution = resolution(observations);
    noise.sigma = (0..layout.components())
        .map(|at| (noise.floor[usize::from(layout.kind[at])] * spread[at]).max(resolution))
        .collect();
    noise.runs = if observations.in_sequence { layout.runs.clone() } else { Vec::new() };
    noise
}

/// The smallest difference that means something: rounding of the largest measured number, through a few operations.
#[must_use]
pub fn resolution(observations: &Observations) -> f64 {
    let largest =
        observations.measured.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    8.0 * f64::EPSILON * largest.max(f64::MIN_POSITIVE / f64::EPSILON)
}
