//! Uneven noise: the logarithm of the variance as a linear function of joints, inputs and the stated uncertainty.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use crate::policy::Policy;
use crate::problem::Rows;

/// Relative standard deviation of each value, and what the model of it costs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Deviations {
    pub values: Vec<f64>,
    /// Nats: one a feature and a constant, so that a model is used only where it gains more.
    pub price: f64,
}

/// Features of the rows that a variance may depend on, each with mean zero and about unit size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Features {
    /// Values of each feature: of a row, or of each value where it is the stated uncertainty.
    columns: Vec<Vec<f64>>,
    components: usize,
}

impl Features {
    /// Joints and inputs with their squares, and the logarithm of the stated uncertainty.
    pub fn of(rows: &Rows, stated: &[f64]) -> Self {
        let components = stated.len() / rows.count;
        let spread =
            |values: &[f64]| values.iter().flat_map(|&value| vec![value; components]).collect::<Vec<f64>>();
        let mut columns = Vec::new();
        let all = rows
            .joints
            .iter()
            .map(|joint| &joint.values)
            .chain(rows.inputs.iter().map(|input| &input.values));
        for values in all {
            let Some(scaled) = standard(values) else { continue };
            // A square's standard deviation is about 1.4.
            let square: Vec<f64> = scaled.iter().map(|value| (value * value - 1.0) / 1.4).collect();
            columns.extend([spread(&scaled), spread(&square)]);
        }
        let logarithms: Vec<f64> = stated.iter().map(|weight| -weight.ln()).collect();
        columns.extend(standard(&logarithms));
        Self { columns, components }
    }

    /// Relative standard deviation of each value, from residuals and the weights of their rows.
    ///
    /// Source: Verbyla (1993), Modelling variance heterogeneity: residual maximum likelihood and diagnostics.
    pub fn deviations(&self, residual: &[f64], row_weights: &[f64], policy: &Policy) -> Deviations {
        let (values, m, k) = (residual.len(), self.components, self.columns.len());
        let squares: Vec<f64> = residual
            .iter()
            .enumerate()
            .map(|(at, r)| (row_weights[at / m] * r * r).max(f64::MIN_POSITIVE))
            .collect();
        let rows = (values / m) as f64;
        let each: Vec<f64> =
            (0..m).map(|own| squares.iter().skip(own).step_by(m).sum::<f64>() / rows).map(f64::ln).collect();
        let all = (squares.iter().sum::<f64>() / values as f64).ln();
        let by_component: Vec<f64> = (0..values).map(|at| ((each[at % m] - all) / 2.0).exp()).collect();
        let likelihood_one = -0.5 * (all + 1.0) * values as f64;
        let likelihood_each = -0.5 * rows * each.iter().map(|own| own + 1.0).sum::<f64>();
        let feature = |value: usize, at: usize| {
            if at < m { f64::from(value % m == at) } else { self.columns[at - m][value] }
        };
        let design = Mat::from_fn(values, m + k, feature);
        let ridge = |at: usize| if at < m { 0.0 } else { policy.ridge_variance };
        let mut theta: Vec<f64> = each.iter().copied().chain(std::iter::repeat_n(0.0, k)).collect();
        let eta = |theta: &[f64]| -> Vec<f64> {
            let theta = Mat::from_fn(theta.len(), 1, |at, _| theta[at]);
            let product = &design * theta;
            (0..values).map(|at| product[(at, 0)]).collect()
        };
        let penalised = |theta: &[f64]| {
            let eta = eta(theta);
            let fit: f64 = eta.iter().zip(&squares).map(|(eta, square)| eta + square * (-eta).exp()).sum();
            -0.5 * fit - 0.5 * theta.iter().enumerate().map(|(at, t)| ridge(at) * t * t).sum::<f64>()
        };
        let mut hessian = design.transpose() * &design * faer::Scale(0.5);
        for at in 0..m + k {
            hessian[(at, at)] += ridge(at);
        }
        let Ok(factor) = hessian.llt(Side::Lower) else {
            return Deviations { values: vec![1.0; values], price: 0.0 };
        };
        let mut reached = penalised(&theta);
        for _ in 0..12 {
            let eta = eta(&theta);
            let pull = Mat::from_fn(values, 1, |at, _| (squares[at] * (-eta[at]).exp() - 1.0) / 2.0);
            let mut gradient = design.transpose() * pull;
            for at in 0..m + k {
                gradient[(at, 0)] -= ridge(at) * theta[at];
            }
            let step = factor.solve(&gradient);
            // A whole step overflows where one residual is far larger than the rest: halved until the likelihood grows.
            let tried = (0..20).find_map(|half| {
                let size = 0.5f64.powi(half);
                let next: Vec<f64> =
                    theta.iter().enumerate().map(|(at, t)| t + size * step[(at, 0)]).collect();
                let value = penalised(&next);
                (value.is_finite() && value >= reached).then_some((next, value))
            });
            let Some((next, value)) = tried else { break };
            let moved = next.iter().zip(&theta).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            (theta, reached) = (next, value);
            if moved < 1e-3 {
                break;
            }
        }
        let eta = eta(&theta);
        let likelihood =
            -0.5 * eta.iter().zip(&squares).map(|(eta, square)| eta + square * (-eta).exp()).sum::<f64>();
        let price = k as f64 + policy.price_variance;
        if k > 0 && likelihood - likelihood_each > price {
            Deviations { values: eta.iter().map(|eta| ((eta - all) / 2.0).exp()).collect(), price }
        } else if likelihood_each - likelihood_one > policy.price_variance {
            Deviations { values: by_component, price: policy.price_variance }
        } else {
            Deviations { values: vec![1.0; values], price: 0.0 }
        }
    }
}

/// Values less their mean over their standard deviation; none where they are all one.
fn standard(values: &[f64]) -> Option<Vec<f64>> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let deviation = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    (deviation > f64::EPSILON.sqrt() * largest)
        .then(|| values.iter().map(|value| (value - mean) / deviation).collect())
}
