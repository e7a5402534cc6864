//! Which of many pointings to measure, and what they make of the errors' covariance.
//!
//! All are measured at first, and those that tell least are left out one by one: what brings numbers of its own tells nothing
//! until several pointings say where it is, so that to take up one after the other would begin nowhere.

use nalgebra::DMatrix;

use super::known::inverse;
use crate::design::Criterion;

/// The whitened rows of one pointing: where its columns stand, and the columns.
#[derive(Clone)]
pub(super) struct Pointed {
    pub at: Vec<usize>,
    pub columns: DMatrix<f64>,
}

/// The covariance with some rows measured, by the sum of what is known; `None` where that is not finite.
///
/// Not row by row: what nobody knew before is known a million times as surely after, and the digits of a difference would be gone.
pub(super) fn measured<'a>(
    covariance: &DMatrix<f64>,
    rows: impl Iterator<Item = &'a Pointed>,
) -> Option<DMatrix<f64>> {
    let mut information = inverse(covariance.clone())?;
    for rows in rows {
        let own = rows.columns.transpose() * &rows.columns;
        for (i, &to) in rows.at.iter().enumerate() {
            rows.at.iter().enumerate().for_each(|(j, &other)| information[(to, other)] += own[(i, j)]);
        }
    }
    inverse(information)
}

/// Takes rows out again.
fn without(covariance: &mut DMatrix<f64>, rows: &Pointed) {
    let spread = spread(covariance, rows, covariance.nrows());
    let Some(inverse) = own(&spread, rows).try_inverse() else { return };
    *covariance += &spread * inverse * spread.transpose();
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

/// 1 − the covariance of what the rows would show.
fn own(spread: &DMatrix<f64>, rows: &Pointed) -> DMatrix<f64> {
    let m = rows.columns.nrows();
    DMatrix::from_fn(m, m, |i, j| {
        let of = rows.at.iter().enumerate().map(|(k, &at)| rows.columns[(i, k)] * spread[(at, j)]);
        f64::from(u8::from(i == j)) - of.sum::<f64>()
    })
}

/// How bad a covariance of errors is.
pub(super) fn badness(covariance: &DMatrix<f64>, scale: &[f64], criterion: Criterion) -> f64 {
    match criterion {
        Criterion::D => covariance.clone().cholesky().map_or(f64::NAN, |factor| {
            2.0 * factor.l().diagonal().iter().map(|value| value.ln()).sum::<f64>()
        }),
        Criterion::A => {
            scale.iter().enumerate().map(|(at, scale)| covariance[(at, at)] * scale * scale).sum()
        }
    }
}

/// Leaves out all but so many pointings, those that tell least of the first numbers, as many as `scale` has; which stay, and the
/// covariance of those numbers with them.
pub(super) fn chosen(
    covariance: &DMatrix<f64>,
    pointings: &[Pointed],
    count: usize,
    scale: &[f64],
    criterion: Criterion,
) -> Option<(Vec<usize>, DMatrix<f64>)> {
    let errors = scale.len();
    let mut now = measured(covariance, pointings.iter())?;
    let mut stay: Vec<usize> = (0..pointings.len()).collect();
    while stay.len() > count.max(1) {
        let own_covariance = now.view((0, 0), (errors, errors)).into_owned();
        let loss = |pointing: usize| {
            let rows = &pointings[pointing];
            let spread = spread(&now, rows, now.nrows());
            let inverse = own(&spread, rows).try_inverse()?;
            let of_errors = spread.rows(0, errors);
            let after = &own_covariance + of_errors * inverse * of_errors.transpose();
            Some(badness(&after, scale, criterion)).filter(|loss| loss.is_finite())
        };
        let losses = stay.iter().enumerate().filter_map(|(at, &pointing)| Some((at, loss(pointing)?)));
        // The last of those that are alike, so that the first of a list stay.
        let (least, _) = losses.min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
        without(&mut now, &pointings[stay.remove(least)]);
    }
    let after = measured(covariance, stay.iter().map(|&at| &pointings[at]))?;
    Some((stay, after.view((0, 0), (errors, errors)).into_owned()))
}
