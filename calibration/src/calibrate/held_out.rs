//! Before and after, on the data that were fitted and on data that no stage saw, in physical units.
//!
//! Which held-out rows are gross outliers is for the searches that did not see them to say: a row counts unless what its
//! fold's search predicts of it lies as far off as where the robust weights end. The same rows count before and after,
//! and the figure over every row stands beside.

use super::round::Round;
use super::{CalibrateError, Loop, declared};
use crate::fit::{FitResult, robust};
use crate::report::Rms;
use crate::search::HeldOut;
use crate::search::columns::Columns;
use crate::search::row_set::Portion;

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
    last: &Round<'_>,
    held_out: &HeldOut,
) -> Result<BeforeAfter, CalibrateError> {
    let rows = &last.fitted.layout.row;
    let weight = &last.fitted.fit.residuals.weight;
    let in_sample = |residual: &[f64]| {
        length(residual, rows, |row| weight[row as usize] > 0.0).map_or(0.0, |(rms, _)| rms)
    };
    let (held_before, held_after) = match whole.request.second {
        Some(second) => {
            let residual = |chain, values: &[f64]| {
                Columns::at(chain, second, declared(whole), values, &[])
                    .map(|columns| Held::of(&columns.residual, &columns.row, |_| true))
            };
            (
                residual(&whole.request.plan.chain, &before.values)?,
                residual(&last.fitted.chain, &last.fitted.fit.values)?,
            )
        }
        None if last.posed.problem.folds() > 1 => {
            let [before, after] = predicted(whole, last, [&held_out.before, &held_out.after])?;
            let within = within_reach(whole, last, &after);
            let of = |residual: &[f64]| Held::of(residual, rows, |row| within[row as usize]);
            (of(&before), of(&after))
        }
        None => (Held::default(), Held::default()),
    };
    Ok(BeforeAfter {
        before: held_before.beside(in_sample(&before.residuals.raw)),
        after: held_after.beside(in_sample(&last.fitted.fit.residuals.raw)),
    })
}

/// RMS of residuals that no stage saw.
#[derive(Default)]
struct Held {
    /// Over the rows that count, and how many those are.
    counted: Option<(f64, usize)>,
    /// Over every row.
    all: Option<(f64, usize)>,
}

impl Held {
    fn of(residual: &[f64], rows: &[u32], counts: impl Fn(u32) -> bool) -> Self {
        Self { counted: length(residual, rows, counts), all: length(residual, rows, |_| true) }
    }

    fn beside(self, rms: f64) -> Rms {
        Rms {
            rms,
            held_out_rms: self.counted.map(|(rms, _)| rms),
            held_out_rows: self.counted.map_or(0, |(_, rows)| rows),
            held_out_rms_of_all: self.all.map(|(rms, _)| rms),
        }
    }
}

/// Per row whether a held-out residual is within reach of the robust weights; every row if the fit is not robust.
fn within_reach(whole: &Loop<'_>, last: &Round<'_>, residual: &[f64]) -> Vec<bool> {
    let observations = whole.request.observations;
    if !whole.request.plan.fit.robust {
        return vec![true; observations.rows()];
    }
    let mut white = residual.to_vec();
    last.fitted.fit.noise.without_memory().whiten(&mut white);
    let norms: Vec<f64> = last.fitted.layout.norms(&white).collect();
    norms.iter().zip(observations.measures()).map(|(&n, m)| n < robust::cutoff(m.components())).collect()
}

/// Per fold the coefficients of the columns of the problem that were used.
type Coefficients = [Vec<(usize, f64)>];

/// What each row's fold, fitted without it, leaves of it, before whitening, by either set of coefficients.
pub(crate) fn predicted<const N: usize>(
    whole: &Loop<'_>,
    last: &Round<'_>,
    coefficients: [&Coefficients; N],
) -> Result<[Vec<f64>; N], CalibrateError> {
    let mut left = [const { Vec::new() }; N];
    last.posed.each_portion(whole, &last.fitted, |components, portion| {
        for (left, coefficients) in left.iter_mut().zip(coefficients) {
            left.extend(predicted_of(last, coefficients, components.start, portion));
        }
    })?;
    Ok(left)
}

/// The same for a portion of the rows, whose components start at one of all.
fn predicted_of(
    last: &Round<'_>,
    coefficients: &Coefficients,
    start: usize,
    portion: &Portion<'_>,
) -> Vec<f64> {
    let problem = &last.posed.problem;
    let declared = portion.columns.declared.as_ref();
    let own: Vec<&Vec<f64>> = portion.effects.iter().flatten().collect();
    let mut left = problem.before_whitening(problem.residual(), declared, &portion.without);
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
        for (component, (left, value)) in left.iter_mut().zip(&values).enumerate() {
            *left -= by_fold[last.posed.fold_of(start + component)] * value;
        }
    }
    left
}

/// RMS over observations of the length of the residual, and how many they are; `None` without observations.
fn length(residual: &[f64], rows: &[u32], used: impl Fn(u32) -> bool) -> Option<(f64, usize)> {
    let (mut squares, mut count, mut last) = (0.0, 0_u32, None);
    for (value, &row) in residual.iter().zip(rows).filter(|&(_, &row)| used(row)) {
        squares += value * value;
        if last != Some(row) {
            count += 1;
            last = Some(row);
        }
    }
    (count > 0).then(|| (f64::sqrt(squares / f64::from(count)), count as usize))
}
