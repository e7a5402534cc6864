//! What is left after the last round: whether it has structure, where, and of what shape.

use model_core::SymbolId;

use super::round::Round;
use super::{CalibrateError, Loop, declared};
use crate::columns::{Columns, places};
use crate::effects::{Effect, Place, smooth, tensor};
use crate::report::{Remaining, Where};
use crate::search::{Problem, Smooth, remains};

/// Harmonics 2 to this order at one place are one function.
const SPELT_OUT: u32 = 5;

/// Points of the shape that is reported.
const POINTS: usize = 61;

/// Scans the last residual for smooth functions.
pub(crate) fn remaining(whole: &Loop<'_>, last: &Round) -> Result<Remaining, CalibrateError> {
    let observations = whole.request.observations;
    let candidates = [smooth(&whole.setting), tensor(&whole.setting)].concat();
    let values = &last.fit.values;
    let places = places(&candidates);
    let columns = Columns::at(&last.chain, observations, declared(whole), values, &places)?;
    let effects = columns.of_effects(&last.chain, &candidates, observations, values);
    let series = series(whole, last);
    let accepted = last
        .found
        .iter()
        .filter(|found| series.as_ref() != Some(&kind(&whole.catalogue[found.effect])))
        .flat_map(|found| &last.effects[found.effect]);
    let known: Vec<Vec<f64>> = (0..last.columns.declared.ncols())
        .map(|j| last.whitened(last.columns.declared.col_as_slice(j)))
        .chain(accepted.map(|column| last.whitened(column)))
        .collect();
    let unknown: Vec<Vec<f64>> = effects.iter().flatten().map(|column| last.whitened(column)).collect();
    let mut blocks = Vec::new();
    let mut start = 0;
    for effect in &effects {
        blocks.push(start..start + effect.len());
        start += effect.len();
    }
    let n = last.columns.residual.len();
    let matrix = |columns: &[Vec<f64>]| faer::Mat::from_fn(n, columns.len(), |i, j| columns[j][i]);
    let hold_out = &whole.request.plan.hold_out;
    let problem = Problem::new(
        matrix(&known).as_ref(),
        matrix(&unknown).as_ref(),
        &blocks,
        &last.whitened(&without_series(whole, last, series.as_ref())),
        &last.groups(whole),
        hold_out.folds,
        hold_out.seed,
    )?;
    let found = remains(&problem, &blocks, &whole.options);
    let Some(smooth) = found.smooth else {
        return Ok(Remaining { p_value: found.p_value, place: None, shape: Vec::new() });
    };
    let effect = &candidates[smooth.candidate];
    Ok(Remaining {
        p_value: found.p_value,
        place: Some(Where {
            body: last.chain.body(effect.place.body).name.clone(),
            dof: effect.place.freedom.word().to_owned(),
            driver: effect.driver.clone(),
        }),
        shape: shape(whole, effect, &smooth, values),
    })
}

/// Place and driver of an effect.
type Kind = (Place, String);

fn kind(effect: &Effect) -> Kind {
    (effect.place, effect.driver.clone())
}

/// A place where every harmonic of one driver was accepted, order after order: that is no set of sines but one
/// function that they spell out.
fn series(whole: &Loop<'_>, last: &Round) -> Option<Kind> {
    let accepted: Vec<&Effect> = last.found.iter().map(|found| &whole.catalogue[found.effect]).collect();
    accepted.iter().map(|effect| kind(effect)).find(|kind| {
        (2..=SPELT_OUT).all(|order| {
            let form = format!("harmonic {order}");
            accepted
                .iter()
                .any(|effect| effect.form == form && (effect.place, &effect.driver) == (kind.0, &kind.1))
        })
    })
}

/// The last residual with what the effects of a series explain put back.
fn without_series(whole: &Loop<'_>, last: &Round, series: Option<&Kind>) -> Vec<f64> {
    let mut residual = last.columns.residual.clone();
    for (found, errors) in last.found.iter().zip(&last.errors) {
        if series != Some(&kind(&whole.catalogue[found.effect])) {
            continue;
        }
        for (column, error) in last.effects[found.effect].iter().zip(errors) {
            let value = last.fit.values[error.index()];
            residual.iter_mut().zip(column).for_each(|(r, z)| *r += value * z);
        }
    }
    residual
}

/// Driver, value and two standard uncertainties over the range of the driver's readings.
fn shape(whole: &Loop<'_>, effect: &Effect, smooth: &Smooth, values: &[f64]) -> Vec<Vec<f64>> {
    let driver: Option<SymbolId> = whole.setting.chain.find_symbol(&effect.driver);
    let Some((driver, readings)) =
        driver.and_then(|id| whole.request.observations.column(id).map(|readings| (id, readings)))
    else {
        return Vec::new();
    };
    let low = readings.iter().copied().fold(f64::INFINITY, f64::min);
    let high = readings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut at = values.to_vec();
    let width = smooth.coefficients.len();
    (0..POINTS)
        .map(|point| {
            let q = low + (high - low) * point as f64 / (POINTS - 1) as f64;
            at[driver.index()] = q;
            let basis: Vec<f64> = effect.functions.iter().map(|function| function.amount.eval(&at)).collect();
            let value: f64 = basis.iter().zip(&smooth.coefficients).map(|(f, c)| f * c).sum();
            let variance: f64 = (0..width)
                .map(|i| {
                    let row = &smooth.covariance[i * width..(i + 1) * width];
                    basis[i] * row.iter().zip(&basis).map(|(c, f)| c * f).sum::<f64>()
                })
                .sum();
            vec![q, value, 2.0 * variance.max(0.0).sqrt()]
        })
        .collect()
}
