//! Before and after, on the data that were fitted and on data that no stage saw, in physical units.

use super::round::Round;
use super::{CalibrateError, Loop, declared};
use crate::columns::Columns;
use crate::fit::FitResult;
use crate::report::Rms;
use crate::search::HeldOut;

/// RMS before and after.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BeforeAfter {
    pub before: Rms,
    pub after: Rms,
}

/// In sample over the rows with weight in the last fit; held out from the study's second file, or else from the nested
/// folds over the same rows.
pub(crate) fn rms(
    whole: &Loop<'_>,
    before: &FitResult,
    last: &Round,
    held_out: &HeldOut,
) -> Result<BeforeAfter, CalibrateError> {
    let rows = &last.columns.row;
    let weight = &last.fit.residuals.weight;
    let used = |residual: &[f64]| length(residual, rows, |row| weight[row as usize] > 0.0);
    let (held_before, held_after) = match whole.request.second {
        Some(second) => {
            let residual = |chain, values: &[f64]| {
                Columns::at(chain, second, declared(whole), values, &[])
                    .map(|columns| length(&columns.residual, &columns.row, |_| true))
            };
            (residual(&whole.request.plan.chain, &before.values)?, residual(&last.chain, &last.fit.values)?)
        }
        None if last.problem.folds() > 1 => {
            (used(&predicted(last, &held_out.before)), used(&predicted(last, &held_out.after)))
        }
        None => (None, None),
    };
    let in_sample = |residual: &[f64]| used(residual).unwrap_or(0.0);
    Ok(BeforeAfter {
        before: Rms { rms: in_sample(&before.residuals.raw), held_out_rms: held_before },
        after: Rms { rms: in_sample(&last.columns.residual), held_out_rms: held_after },
    })
}

/// What each row's fold, fitted without it, leaves of it, before whitening.
fn predicted(last: &Round, coefficients: &[Vec<(usize, f64)>]) -> Vec<f64> {
    let problem = &last.problem;
    let declared = last.columns.declared.as_ref();
    let own: Vec<&Vec<f64>> = last.effects.iter().flatten().collect();
    let mut left = problem.before_whitening(problem.residual(), declared, &last.without);
    let mut columns: Vec<usize> = coefficients.iter().flatten().map(|&(column, _)| column).collect();
    columns.sort_unstable();
    columns.dedup();
    for column in columns {
        let values = match column.checked_sub(problem.declared()) {
            None => problem.basis_before_whitening(column, declared),
            Some(candidate) => problem.before_whitening(column, declared, own[candidate]),
        };
        let by_fold: Vec<f64> = coefficients
            .iter()
            .map(|fold| fold.iter().find(|&&(c, _)| c == column).map_or(0.0, |&(_, b)| b))
            .collect();
        for (row, (left, value)) in left.iter_mut().zip(&values).enumerate() {
            *left -= by_fold[problem.fold_of_row(row)] * value;
        }
    }
    left
}

/// RMS over observations of the length of the residual; `None` without observations.
fn length(residual: &[f64], rows: &[u32], used: impl Fn(u32) -> bool) -> Option<f64> {
    let (mut squares, mut count, mut last) = (0.0, 0.0, None);
    for (value, &row) in residual.iter().zip(rows).filter(|&(_, &row)| used(row)) {
        squares += value * value;
        if last != Some(row) {
            count += 1.0;
            last = Some(row);
        }
    }
    (count > 0.0).then(|| f64::sqrt(squares / count))
}
