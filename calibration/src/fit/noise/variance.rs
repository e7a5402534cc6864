//! A variance that depends on the joints: log-linear in cos q, sin q, cos 2q, sin 2q of each joint and in the
//! logarithm of measured ranges.
//!
//! Source: A. C. Harvey, Estimating Regression Models with Multiplicative Heteroscedasticity, Econometrica 44 (1976):
//! maximum likelihood by Fisher scoring.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use model_core::{Chain, Quantity, SymbolKind};

use super::{Layout, VarianceModel, VarianceTerm};
use crate::data::Observations;

/// Components per coefficient below which no variance model is looked for.
const COMPONENTS_PER_TERM: usize = 15;

/// The model and, per row, the factor on the standard deviation; `None` if the data do not bear one out.
pub fn fit(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    scaled: &[f64],
    weight: &[f64],
) -> Option<(VarianceModel, Vec<f64>)> {
    let terms = terms(chain, observations);
    let kept: Vec<usize> = (0..scaled.len()).filter(|&at| weight[layout.row[at] as usize] > 0.0).collect();
    if terms.is_empty() || kept.len() < COMPONENTS_PER_TERM * terms.len() {
        return None;
    }
    let columns: Vec<Vec<f64>> = terms.iter().map(|term| column(*term, observations)).collect();
    let design = Mat::from_fn(kept.len(), terms.len() + 1, |row, term| match term.checked_sub(1) {
        None => 1.0,
        Some(term) => columns[term][layout.row[kept[row]] as usize],
    });
    let factored = design.col_piv_qr();
    let squares: Vec<f64> = kept.iter().map(|&at| scaled[at] * scaled[at]).collect();
    let level = squares.iter().sum::<f64>() / kept.len() as f64;
    if level <= 0.0 {
        return None;
    }
    let mut log_variance = vec![level.ln(); kept.len()];
    let mut coefficients = Mat::from_fn(terms.len() + 1, 1, |at, _| if at == 0 { level.ln() } else { 0.0 });
    for _ in 0..30 {
        let score = Mat::from_fn(kept.len(), 1, |at, _| squares[at] / log_variance[at].exp() - 1.0);
        let step = factored.solve_lstsq(score);
        coefficients += &step;
        let fitted = &design * &coefficients;
        for (at, value) in log_variance.iter_mut().enumerate() {
            // A factor of 1e9 between variances is beyond any instrument, and keeps the exponential finite.
            *value = fitted[(at, 0)].clamp(level.ln() - 20.0, level.ln() + 20.0);
        }
        if step.norm_max() < 1e-6 {
            break;
        }
    }
    let deviance = |log_variance: f64, square: f64| log_variance + square / log_variance.exp();
    let gain: f64 = squares
        .iter()
        .zip(&log_variance)
        .map(|(&square, &fitted)| deviance(level.ln(), square) - deviance(fitted, square))
        .sum();
    // Heavy tails make variances look uneven: the likelihood ratio is scaled by what the fourth moment says.
    let standardised = squares.iter().zip(&log_variance).map(|(square, fitted)| square / fitted.exp());
    let excess = standardised.map(|ratio| (ratio - 1.0).powi(2)).sum::<f64>() / kept.len() as f64 / 2.0;
    if gain / excess.max(1.0) < terms.len() as f64 * (kept.len() as f64).ln() {
        return None;
    }
    let factor = (0..observations.rows())
        .map(|row| {
            let log: f64 =
                (0..terms.len()).map(|term| coefficients[(term + 1, 0)] * columns[term][row]).sum();
            (log.clamp(-20.0, 20.0) / 2.0).exp()
        })
        .collect();
    let terms = terms.into_iter().enumerate().map(|(at, term)| (term, coefficients[(at + 1, 0)])).collect();
    Some((VarianceModel { terms }, factor))
}

fn terms(chain: &Chain, observations: &Observations) -> Vec<VarianceTerm> {
    let mut terms = Vec::new();
    for (id, values) in &observations.poses.columns {
        let symbol = chain.symbol(*id);
        match (symbol.kind, symbol.quantity) {
            (SymbolKind::Joint, Quantity::Angle) => {
                for multiple in 1..=2 {
                    terms.extend([VarianceTerm::Cos(*id, multiple), VarianceTerm::Sin(*id, multiple)]);
                }
            }
            (SymbolKind::Input, Quantity::Length) if values.iter().all(|&range| range > 0.0) => {
                terms.push(VarianceTerm::LogRange(*id));
            }
            _ => {}
        }
    }
    terms
}

/// The function at every row, less its mean.
fn column(term: VarianceTerm, observations: &Observations) -> Vec<f64> {
    let (id, function): (_, Box<dyn Fn(f64) -> f64>) = match term {
        VarianceTerm::Cos(id, multiple) => (id, Box::new(move |q: f64| (f64::from(multiple) * q).cos())),
        VarianceTerm::Sin(id, multiple) => (id, Box::new(move |q: f64| (f64::from(multiple) * q).sin())),
        VarianceTerm::LogRange(id) => (id, Box::new(f64::ln)),
    };
    let readings = observations
        .poses
        .column(id)
        .unwrap_or_else(|| unreachable!("a variance goes with what the observations have readings of"));
    let values: Vec<f64> = readings.iter().map(|&value| function(value)).collect();
    let mean = values.iter().sum::<f64>() / (values.len() as f64).max(1.0);
    values.into_iter().map(|value| value - mean).collect()
}
