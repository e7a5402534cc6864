//! Effects, or a memory of the noise? Along a slow path through the joints noise that remembers looks like smooth functions of
//! them. What the accepted effects explain is theirs only if they do it better than one number that says how much a row
//! remembers of the row before.
//!
//! Source of the price of a choice: J. Chen and Z. Chen, "Extended Bayesian information criteria for model selection with
//! large model spaces", Biometrika 95 (2008).

use faer::Mat;

use super::contest::ln_choices;
use super::round::Round;
use super::sweep::Sweep;
use fit::noise::Run;
use fit::noise::serial::{FEWEST, Model, longest, models};
use fit::noise::space;

/// Twice the logarithm of the likelihood that a memory gains over white noise at least, to be held against effects.
///
/// Source: the upper 5 % point of the chi-squared distribution with two degrees of freedom.
const GAINS: f64 = 5.99;

/// By how much effects must explain the data better, in the same unit: where the two do about as well, nothing but the order of
/// the rows speaks for either.
const BETTER: f64 = 6.0;

/// Whether a memory of the row before, beside the declared errors alone, explains the data of a round as well as the effects
/// that it accepted, or nearly so, whatever memory there is beside them.
pub(crate) fn explains(last: &Round<'_>) -> bool {
    let rows = &last.search.rows;
    let mut groups = rows.observations.groups.clone();
    groups.sort_unstable();
    groups.dedup();
    let grouped = groups.len() < rows.observations.groups.len();
    let in_sequence = rows.observations.in_sequence;
    // Groups that somebody declared say what belongs together, unless rows are in an order of acquisition as well.
    if last.fitted.found.is_empty() || (grouped && !in_sequence) {
        return false;
    }
    let declared: Vec<Vec<f64>> = (0..rows.columns.declared.ncols())
        .map(|column| rows.whiten_but_for_memory(rows.columns.declared.col_as_slice(column)))
        .collect();
    let mut with_effects = declared.clone();
    for found in &last.fitted.found {
        let own = rows.effects[found.effect.0].iter();
        with_effects.extend(own.map(|column| rows.whiten_but_for_memory(column)));
    }
    let values = rows.whiten_but_for_memory(&rows.without);
    let Some(length) = longest(rows.runs()).filter(|length| *length >= 4) else { return false };
    if values.len() < FEWEST + with_effects.len() {
        return false;
    }
    let each = (values.len() as f64).ln();
    let effects = (with_effects.len() - declared.len()) as f64 * each
        + 2.0 * ln_choices(last.sets.len(), last.fitted.found.len());
    let deviance =
        |columns: &[Vec<f64>], model: Option<&Model>| deviance(rows.runs(), columns, &values, model);
    let axes = space::axes(&rows.observations);
    let models: Vec<_> = models(length, rows.runs(), axes.as_deref()).collect();
    let remembering = |columns: &[Vec<f64>]| {
        let tried = parallel::each_of(&models, |(model, _)| deviance(columns, Some(model)));
        tried.into_iter().fold(f64::INFINITY, f64::min) + 2.0 * each
    };
    let (white, memory) = (deviance(&declared, None), remembering(&declared));
    let explained = deviance(&with_effects, None).min(remembering(&with_effects));
    white - memory + 2.0 * each > GAINS && memory <= explained + effects + BETTER
}

/// −2 ln of the likelihood of values that some columns were fitted to.
fn deviance(runs: &[Run], columns: &[Vec<f64>], values: &[f64], model: Option<&Model>) -> f64 {
    let count = columns.len();
    let mut white = Mat::from_fn(values.len(), count + 1, |row, column| {
        if column == count { values[row] } else { columns[column][row] }
    });
    let ln_determinant = model.map_or(0.0, |model| {
        (0..=count).for_each(|column| model.whiten(white.col_as_slice_mut(column), runs));
        model.ln_determinant(runs)
    });
    let mut sweep = Sweep::new(white.transpose() * &white);
    (0..count).for_each(|column| {
        sweep.add(column);
    });
    values.len() as f64 * sweep.entry(count, count).max(f64::MIN_POSITIVE).ln() + ln_determinant
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave of forty rows in even noise is no memory, and a slow walk is no wave.
    #[test]
    fn a_wave_and_a_walk_are_told_apart() {
        let noise = |row: usize| ((row as f64 * 0.754_877_666).fract() - 0.5) * 3.46;
        let runs = [Run { start: 0, end: 400, stride: 1 }];
        let mean = vec![1.0; 400];
        let wave: Vec<f64> = (0..400).map(|row| (row as f64 * 0.157).cos()).collect();
        let waving: Vec<f64> = (0..400).map(|row| noise(row) + 2.0 * wave[row]).collect();
        let mut at = 0.0;
        let mut walk = Vec::new();
        for row in 0..400 {
            at += 0.3 * noise(7 * row + 3 * row * row);
            walk.push(noise(row) + at);
        }
        let best = |values: &[f64]| {
            let of = |(model, _)| deviance(&runs, std::slice::from_ref(&mean), values, Some(&model));
            models(400, &runs, None).map(of).fold(f64::INFINITY, f64::min)
        };
        let explained = |values: &[f64]| deviance(&runs, &[mean.clone(), wave.clone()], values, None);
        assert!(explained(&waving) < best(&waving) - 20.0);
        assert!(best(&walk) < explained(&walk) - 20.0);
    }
}
