//! Joints that stood still, and ranges of what stands still: several rows read the same, each with its noise.
//!
//! Where the residual is the noise of that very reading, whatever is steep in it follows the noise: rows in the order of such readings
//! look as if they had structure, and a high harmonic explains them. Objects take all that could explain the joint's own
//! turn, and leave only that. So effects are judged at the mean of the readings.

use std::cell::LazyCell;
use std::iter::repeat_n;

use model_core::{Chain, Quantity, SymbolId, SymbolKind, exact};

use super::ByReading;
use fit::noise::Layout;
use fit::{FitError, FitResult, Model, pulled, robust};
use observe::{Observations, SiUnit, golden};

/// Readings that differ by so many times their noise are of a joint that moved between them, and so are those that spread over so many
/// times as much.
const MOVED: f64 = 4.0;
const SPREAD: f64 = 3.0 * MOVED;

/// A joint stood still if at least this share of the rows read a turn that others read as well.
const MOSTLY: f64 = 0.5;

/// Residuals follow what readings differ by at least so closely where that is noise: one where they hold all of it, zero where the joint
/// moved.
const FOLLOWED: f64 = 0.5;

/// Rows at which it is asked what a joint moves.
const ASKED: usize = 100;

/// How far it is turned or moved there, rad or m.
const STEP: f64 = 1e-4;

/// The readings of all rows, those of joints that stood still at their mean; `None` where none did.
pub(super) fn still(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    fit: &FitResult,
) -> Result<Option<ByReading>, FitError> {
    let is_read = |id: SymbolId| {
        let symbol = chain.symbol(id);
        matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input)
            && matches!(symbol.quantity, Quantity::Angle | Quantity::Length)
    };
    let places = places(observations);
    let model = LazyCell::new(|| Model::without_columns(chain, &observations.poses));
    let mut still = Vec::new();
    let columns = observations.poses.columns.iter().enumerate().filter(|(_, (id, _))| is_read(*id));
    for (column, (id, readings)) in columns {
        let noise = noise_of(chain, observations, layout, fit, *id);
        let Some(at_rest) = noise.and_then(|noise| at_rest(readings, &places, noise)) else { continue };
        let by_step = pulled(&model, observations, &fit.values, column, |_| STEP)?;
        let differ: Vec<f64> = readings.iter().zip(&at_rest).map(|(read, rest)| read - rest).collect();
        if followed(layout, fit, &by_step, &differ) >= FOLLOWED {
            still.push((column, at_rest));
        }
    }
    if still.is_empty() {
        return Ok(None);
    }
    let mut columns = observations.poses.columns.clone();
    still.into_iter().for_each(|(column, at_rest)| columns[column].1 = at_rest);
    Ok(Some(columns))
}

/// How closely residuals follow what readings differ by: the share of it that fits them best. `by_step` is what a small step of the joint
/// does to them.
fn followed(layout: &Layout, fit: &FitResult, by_step: &[f64], differ: &[f64]) -> f64 {
    let (raw, sigma) = (&fit.residuals.raw, &fit.noise.sigma);
    let of_each = layout.row_of_each().zip(by_step.iter().zip(raw).zip(sigma));
    let [product, square] = of_each.fold([0.0; 2], |[product, square], (row, ((step, left), sigma))| {
        let (by, weight) = (step / STEP * differ[row] / sigma, fit.residuals.weight[row]);
        [product + weight * by * left / sigma, square + weight * by * by]
    });
    if square > 0.0 { product / square } else { 0.0 }
}

/// What each row observes, from where: a joint moves from one to the next.
fn places(observations: &Observations) -> Vec<(Option<u32>, u32)> {
    match &observations.unknowns {
        None => repeat_n((None, 0), observations.rows()).collect(),
        Some(unknowns) => unknowns.object.iter().copied().zip(unknowns.station.iter().copied()).collect(),
    }
}

/// How large the noise of readings is at most, rad or m: what turns or moves the joint so far moves the components by their noise;
/// `None` where it moves nothing.
fn noise_of(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    fit: &FitResult,
    joint: SymbolId,
) -> Option<f64> {
    let mut least: Vec<f64> = Vec::new();
    for series in observations.poses.series.iter().filter(|series| !series.rows.is_empty()) {
        let path = exact::Path::new(chain, series.observable);
        for number in 0..ASKED {
            let row = series.rows.start + (golden::share(number) * series.rows.len() as f64) as usize;
            let own = layout.of_rows(row..row + 1);
            let sigma = fit.noise.sigma[own].iter().copied().fold(0.0, f64::max);
            let mut values = fit.values[..chain.symbols.len()].to_vec();
            observations.poses.columns.iter().for_each(|(id, read)| values[id.index()] = read[row]);
            let mut there = |by: f64| {
                let read = values[joint.index()];
                values[joint.index()] = read + by;
                let point = path.value(&values);
                values[joint.index()] = read;
                point
            };
            let moved = (there(STEP) - there(-STEP)).norm() / (2.0 * STEP);
            // A joint turns what is seen as an angle by no more than itself.
            let moved = if series.measure.unit() == SiUnit::METRE { moved } else { moved.min(1.0) };
            if moved > 0.0 {
                least.push(sigma / moved);
            }
        }
    }
    (!least.is_empty()).then(|| robust::median(least))
}

/// Readings of rows at some places, with the mean of those that only noise of this size sets apart; `None` where the joint did not mostly
/// stand still.
fn at_rest<P: Ord>(readings: &[f64], places: &[P], noise: f64) -> Option<Vec<f64>> {
    let mut order: Vec<usize> = (0..readings.len()).collect();
    order.sort_by(|&a, &b| places[a].cmp(&places[b]).then(readings[a].total_cmp(&readings[b])));
    let mut at_rest = readings.to_vec();
    let mut rows = 0;
    let is_near =
        |&a: &usize, &b: &usize| places[a] == places[b] && readings[b] - readings[a] <= MOVED * noise;
    for near in order.chunk_by(is_near) {
        let spread = readings[near[near.len() - 1]] - readings[near[0]];
        if spread > 0.0 && spread <= SPREAD * noise {
            let mean = near.iter().map(|&row| readings[row]).sum::<f64>() / near.len() as f64;
            near.iter().for_each(|&row| at_rest[row] = mean);
            rows += near.len();
        }
    }
    (rows as f64 >= MOSTLY * readings.len() as f64 && rows > 0).then_some(at_rest)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A joint that stood still at two places is at the mean of either, by itself or by what is observed there; one that went on step by
    /// step is where it was read.
    #[test]
    fn readings_that_differ_by_noise_alone_are_one() {
        let read: Vec<f64> = (0..6).flat_map(|i| [f64::from(i) * 0.1, 5.0 + f64::from(i) * 0.1]).collect();
        let means = |at: &[f64]| at.iter().map(|value| (value * 1e9).round() / 1e9).collect::<Vec<_>>();
        let all = at_rest(&read, &[0; 12], 0.05).unwrap();
        assert_eq!(means(&all), [0.25, 5.25].repeat(6));
        let halves: Vec<usize> = (0..12).map(|row| usize::from(row >= 6)).collect();
        let by_half = at_rest(&read, &halves, 0.05).unwrap();
        assert_eq!(means(&by_half), [[0.1, 5.1].repeat(3), [0.4, 5.4].repeat(3)].concat());
        let slow: Vec<f64> = (0..40).map(|step| 0.1 * f64::from(step)).collect();
        assert_eq!(at_rest(&slow, &[0; 40], 0.05), None);
        assert_eq!(at_rest(&[1.0; 20], &[0; 20], 0.05), None, "nothing to be taken out");
    }
}
