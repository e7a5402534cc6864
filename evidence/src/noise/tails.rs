//! Heavy tails: the weight of each row under a multivariate t, its degrees of freedom, and what treating them as known costs.

use std::f64::consts::PI;

use statrs::function::gamma::ln_gamma;

use crate::policy::{Policy, TAILS};

/// Weights of the rows with the degrees of freedom that fit best.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tails {
    /// Degrees of freedom; infinite for Gaussian tails.
    pub degrees: f64,
    /// Weight u of each row.
    pub weights: Vec<f64>,
    /// See [`super::Noise::adjust`].
    pub adjust: f64,
    /// See [`super::Noise::inflation`].
    pub inflation: f64,
}

impl Tails {
    /// The tails that the squared lengths of the rows' residuals (m components each) speak for.
    ///
    /// Source: Lange, Little and Taylor (1989), Robust statistical modeling using the t distribution.
    pub fn of(squares: &[f64], components: usize, policy: &Policy) -> Self {
        let (rows, m) = (squares.len() as f64, components as f64);
        let gaussian = {
            let variance = squares.iter().sum::<f64>() / (rows * m);
            -rows * m / 2.0 * ((2.0 * PI * variance).ln() + 1.0) + policy.price_tails
        };
        let mut best = (gaussian, None);
        for degrees in TAILS {
            let (weights, variance) = fitted(squares, m, degrees);
            let deviances: f64 = squares.iter().map(|square| (square / variance / degrees).ln_1p()).sum();
            let constant = ln_gamma(f64::midpoint(degrees, m)) - ln_gamma(degrees / 2.0);
            let density = rows * (constant - m / 2.0 * (degrees * PI * variance).ln());
            let likelihood = density - f64::midpoint(degrees, m) * deviances;
            if likelihood > best.0 {
                best = (likelihood, Some((degrees, weights, variance)));
            }
        }
        let Some((degrees, weights, variance)) = best.1 else {
            let weights = vec![1.0; squares.len()];
            return Self { degrees: f64::INFINITY, weights, adjust: 0.0, inflation: 1.0 };
        };
        let constant =
            ln_gamma(f64::midpoint(degrees, m)) - ln_gamma(degrees / 2.0) - m / 2.0 * (degrees * PI).ln();
        let (mut adjust, mut squared, mut slope, mut energy) = (0.0, 0.0, 0.0, 0.0);
        for (u, square) in weights.iter().zip(squares) {
            let d = square / variance;
            let t = constant - f64::midpoint(degrees, m) * (d / degrees).ln_1p();
            adjust += t - (m / 2.0 * u.ln() - m / 2.0 * (2.0 * PI).ln() - u * d / 2.0);
            squared += u * u * d / m / rows;
            slope += (u - 2.0 * u * d / ((degrees + d) * m)) / rows;
            energy += u * d / m / rows;
        }
        let mean = weights.iter().sum::<f64>() / rows;
        // The sandwich variance of a t estimate over what known weights would give.
        // Source: Huber (1981), Robust Statistics, chapter 6.
        let inflation = (squared / (slope * slope) / (energy / mean)).max(1.0);
        Self { degrees, weights, adjust: adjust - policy.price_tails, inflation }
    }
}

/// Weights and variance of a t with known degrees, by the EM recursion.
fn fitted(squares: &[f64], m: f64, degrees: f64) -> (Vec<f64>, f64) {
    let mut sorted = squares.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let median = if sorted.len().is_multiple_of(2) {
        f64::midpoint(sorted[middle - 1], sorted[middle])
    } else {
        sorted[middle]
    };
    let mut variance = (median / m).max(f64::MIN_POSITIVE);
    let mut weights = vec![1.0; squares.len()];
    // Each round takes off most of what is left; 25 leave less than the grid of degrees can tell.
    for _ in 0..25 {
        for (weight, square) in weights.iter_mut().zip(squares) {
            *weight = (degrees + m) / (degrees + square / variance);
        }
        let sum: f64 = weights.iter().zip(squares).map(|(weight, square)| weight * square).sum();
        variance = (sum / (squares.len() as f64 * m)).max(f64::MIN_POSITIVE);
    }
    (weights, variance)
}
