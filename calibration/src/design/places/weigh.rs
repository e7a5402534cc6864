//! Which of many pointings to measure, and what they make of the errors' covariance.
//!
//! All are measured at first, and those that tell least are left out one by one: what brings numbers of its own tells nothing
//! until several pointings say where it is, so that to take up one after the other would begin nowhere.

use nalgebra::DMatrix;

use crate::design::Criterion;

/// The whitened rows of one pointing: where its columns stand, and the columns.
#[derive(Clone)]
pub(super) struct Pointed {
    pub at: Vec<usize>,
    pub columns: DMatrix<f64>,
}

/// The covariance with rows added (sign 1) or taken out (sign −1).
pub(super) fn with(covariance: &mut DMatrix<f64>, rows: &Pointed, sign: f64) {
    let spread = spread(covariance, rows, covariance.nrows());
    let Some(inverse) = own(&spread, rows, sign).try_inverse() else { return };
    let change = &spread * inverse * spread.transpose() * sign;
    *covariance -= change;
}

/// The covariance of the first numbers with those that the rows see.
fn spread(covariance: &DMatrix<f64>, rows: &Pointed, first: usize) -> DMatrix<f64> {
    let mut spread = DMatrix::zeros(first, rows.columns.nrows());
    for (component, row) in rows.columns.row_iter().enumerate() {
        for (&at, value) in rows.at.iter().zip(row.iter()).filter(|(_, value)| **value != 0.0) {
            for number in 0..first {
                spread[(number, component)] += covariance[(number, at)] * value;
            }
        }
    }
    spread
}

/// 1 ± the covariance of what the rows would show.
fn own(spread: &DMatrix<f64>, rows: &Pointed, sign: f64) -> DMatrix<f64> {
    let m = rows.columns.nrows();
    DMatrix::from_fn(m, m, |i, j| {
        let of = rows.at.iter().enumerate().map(|(k, &at)| rows.columns[(i, k)] * spread[(at, j)]);
        sign * of.sum::<f64>() + f64::from(u8::from(i == j))
    })
}

/// How bad a covariance of errors is.
pub(super) fn badness(covariance: &DMatrix<f64>, scale: &[f64], criterion: Criterion) -> f64 {
    match criterion {
        Criterion::D => {
            covariance.clone().cholesky().map_or(f64::NAN, |factor| {
                2.0 * factor.l().diagonal().iter().map(|value| value.ln()).sum::<f64>()
            })
        }
        Criterion::A => scale.iter().enumerate().map(|(at, scale)| covariance[(at, at)] * scale * scale).sum(),
    }
}

/// Leaves out all but so many pointings, those that tell least of the first `errors` numbers; the numbers of those that stay,
/// and the covariance with them.
pub(super) fn chosen(
    mut covariance: DMatrix<f64>,
    pointings: &[Pointed],
    count: usize,
    scale: &[f64],
    criterion: Criterion,
) -> (Vec<usize>, DMatrix<f64>) {
    pointings.iter().for_each(|rows| with(&mut covariance, rows, 1.0));
    let mut stay: Vec<usize> = (0..pointings.len()).collect();
    while stay.len() > count.max(1) {
        let errors = scale.len();
        let own_covariance = covariance.view((0, 0), (errors, errors)).into_owned();
        let loss = |pointing: usize| {
            let rows = &pointings[pointing];
            let spread = spread(&covariance, rows, covariance.nrows());
            let without = own(&spread, rows, -1.0);
            let inverse = without.try_inverse()?;
            let of_errors = spread.rows(0, errors);
            let after = &own_covariance + of_errors * inverse * of_errors.transpose();
            Some(badness(&after, scale, criterion)).filter(|loss| loss.is_finite())
        };
        let losses = stay.iter().enumerate().filter_map(|(at, &pointing)| Some((at, loss(pointing)?)));
        // The last of those that are alike, so that the first of a list stay.
        let Some((least, _)) = losses.min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))) else { break };
        with(&mut covariance, &pointings[stay.remove(least)], -1.0);
    }
    (stay, covariance)
}
