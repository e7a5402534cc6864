//! The ladder of models: each rung is fitted to all folds but one and judged on that one.
//!
//! Rungs below the declaration have fits of their own; those of the declaration and of its effects are the figures of [`super::held_out`]. The
//! simplest model is the lowest rung that the best one beats by no more than the standard error of the difference, row by row: both saw the same rows.
//! Source of the rule: L. Breiman, J. Friedman, R. Olshen and C. Stone, Classification and Regression Trees (1984), section 3.4.3.

mod acts;

use std::collections::{BTreeMap, BTreeSet};

use model_core::SymbolId;

use super::confirm::Judged;
use super::held_out::{Left, is_refitted};
use super::without::Without;
use crate::diagnose::rms::BeforeAfter;
use crate::diagnose::{Ladder, LeftOut, Rung, RungName, WhyNot, largest_plausible};
use crate::limits::FEWEST;
use crate::search::SearchError;
use crate::search::columns::Columns;
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use acts::{Acts, acts};
use fit::noise::{Layout, NoiseOptions};
use fit::{FitOptions, FitResult, fit, residuals};
use observe::SiUnit;

/// A rung, and what it leaves of held-out rows, component by component.
struct Tried {
    name: RungName,
    adds: Vec<String>,
    errors: usize,
    left: Vec<f64>,
}

/// The ladder; none where nothing or hardly anything is held out, or where rows observe objects that nobody knows: nothing says then where an instrument as
/// delivered sees them.
pub(super) fn ladder(
    whole: &Context<'_>,
    before: &FitResult,
    judged: &Judged<'_>,
) -> Result<Option<Ladder>, SearchError> {
    let before = if judged.round.fitted.found.is_empty() { &judged.round.fitted.fit } else { before };
    if !is_refitted(whole, before) {
        return Ok(None);
    }
    let Some(own) = &judged.left else { return Ok(None) };
    if own.judged.units().iter().collect::<BTreeSet<_>>().len() < FEWEST {
        return Ok(None);
    }
    let chain = &whole.request.plan.chain;
    let series = &whole.request.observations.poses.series;
    let estimated = declared(whole);
    let roles: Vec<Acts> = estimated.iter().map(|&symbol| acts(chain, series, symbol)).collect();
    let some = |least: Acts| -> Vec<SymbolId> {
        estimated.iter().zip(&roles).filter(|(_, role)| **role <= least).map(|(id, _)| *id).collect()
    };
    let names = |role: Acts| -> Vec<String> {
        let own = estimated.iter().zip(&roles).filter(|(_, own)| **own == role);
        own.map(|(id, _)| chain.symbol(*id).name.clone()).collect()
    };
    let nominal = {
        let plain = fit::Model::without_columns(chain, &own.judged.poses);
        residuals(&plain, own.judged, &held_at_zero(whole, estimated))?
    };
    let mut rungs = vec![Tried { name: RungName::AsDelivered, adds: Vec::new(), errors: 0, left: nominal }];
    let mut left_out = Vec::new();
    let mut carried = Vec::new();
    for (name, role) in [(RungName::Placed, Acts::Places), (RungName::Zeros, Acts::Index)] {
        let (estimate, mut adds) = (some(role), names(role));
        let mut leave = |why| left_out.push(LeftOut { name, why });
        if adds.is_empty() || estimate.len() == estimated.len() {
            carried.extend(adds);
            leave(WhyNot::AddsNothing);
            continue;
        }
        carried.append(&mut adds);
        let errors = estimate.len();
        match of_some(whole, before, &judged.round, own, estimate)? {
            Some(left) => rungs.push(Tried { name, adds: std::mem::take(&mut carried), errors, left }),
            None => leave(WhyNot::NotConverged),
        }
    }
    carried.extend(names(Acts::Geometry));
    let errors = estimated.len();
    rungs.push(Tried { name: RungName::Geometry, adds: carried, errors, left: own.before.clone() });
    let found = &judged.round.fitted.found;
    if found.is_empty() {
        left_out.push(LeftOut { name: RungName::Effects, why: WhyNot::AddsNothing });
    } else {
        let adds = found.iter().map(|found| whole.catalogue[found.effect].name.clone()).collect();
        let errors = errors + judged.round.fitted.errors.iter().map(Vec::len).sum::<usize>();
        rungs.push(Tried { name: RungName::Effects, adds, errors, left: own.after.clone() });
    }
    Ok(put_together(own, rungs, left_out, &judged.rms))
}

/// The values of all symbols where some of what is estimated stands at its nominal value.
fn held_at_zero(whole: &Context<'_>, held: &[SymbolId]) -> Vec<f64> {
    let plan = whole.request.plan;
    let nominal = plan.chain.nominal_values();
    let mut values = plan.fit.start.clone();
    // Functions to search for bring symbols of their own.
    values.extend(nominal.iter().skip(values.len()));
    held.iter().for_each(|id| values[id.index()] = nominal[id.index()]);
    values
}

/// What a fit of some of the errors leaves of held-out rows; none where it does not converge.
fn of_some(
    whole: &Context<'_>,
    before: &FitResult,
    round: &Round<'_>,
    own: &Left<'_>,
    estimate: Vec<SymbolId>,
) -> Result<Option<Vec<f64>>, SearchError> {
    let (plan, observations) = (whole.request.plan, whole.request.observations);
    let held: Vec<SymbolId> = plan.fit.estimate.iter().copied().filter(|id| !estimate.contains(id)).collect();
    let mut start = held_at_zero(whole, &held);
    estimate.iter().for_each(|id| start[id.index()] = before.values[id.index()]);
    let options = FitOptions {
        start,
        sizes: plan.fit.sizes.iter().copied().filter(|(id, _)| estimate.contains(id)).collect(),
        noise: NoiseOptions { variance: false, serial: false, ..plan.fit.noise.by_residuals() },
        other_starts: false,
        estimate,
        ..plan.fit.clone()
    };
    let fitted = fit(&plan.chain, observations, &options)?;
    if !fitted.outcome.is_usable() {
        return Ok(None);
    }
    if whole.request.second.is_some() {
        let columns = Columns::at(&plan.chain, own.judged, &options.estimate, &fitted.values, &[])?;
        return Ok(Some(columns.residual));
    }
    let of_row = |row: usize| round.search.fold_of(round.fitted.layout.first(row));
    let folds = round.search.problem.folds();
    Without::of(&plan.chain, observations, &options, &fitted)?.each(of_row, folds).map(Some)
}

fn put_together(
    own: &Left<'_>,
    rungs: Vec<Tried>,
    left_out: Vec<LeftOut>,
    rms: &[BeforeAfter],
) -> Option<Ladder> {
    let main = rms.first()?.unit;
    let most = largest_plausible(own.judged, main);
    let squares: Vec<Vec<f64>> = rungs.iter().map(|rung| squares(&own.layout, &rung.left)).collect();
    let of_row = own.judged.poses.unit_of_row();
    let simplest = simplest(own, rms, &squares, &of_row)?;
    let told = rungs.into_iter().zip(&squares).map(|(Tried { name, adds, errors, .. }, squares)| {
        let mean = |is_in: &dyn Fn(usize) -> bool| Mean::of(own, squares, is_in);
        let is_main = |row: usize| of_row[row] == main;
        let sensible = |rms: f64| rms.is_finite() && rms <= most;
        let kept = mean(&|row| is_main(row) && own.within[row]);
        let held_out_rms_kept = kept.map(|own| own.value.sqrt()).filter(|rms| sensible(*rms));
        let elsewhere = match name {
            RungName::Geometry => rms[0].before.elsewhere_rms,
            RungName::Effects => rms[0].after.elsewhere_rms,
            RungName::AsDelivered | RungName::Placed | RungName::Zeros => None,
        };
        Rung {
            name,
            adds,
            errors,
            held_out_rms: mean(&is_main).map(|own| own.value.sqrt()).filter(|rms| sensible(*rms)),
            held_out_rms_kept,
            standard_error: kept
                .zip(held_out_rms_kept)
                .filter(|(_, rms)| *rms > 0.0)
                .and_then(|(own, rms)| Some(own.standard_error? / (2.0 * rms))),
            elsewhere_rms: elsewhere.filter(|rms| sensible(*rms)),
        }
    });
    let rungs: Vec<Rung> = told.collect();
    let simplest = rungs.get(simplest)?.name;
    Some(Ladder { unit: main, rungs, left_out, simplest, written: RungName::Geometry })
}

/// The lowest rung that the best does not beat by more than the standard error of the difference, over rows of all units in terms of their noise.
fn simplest(own: &Left<'_>, rms: &[BeforeAfter], squares: &[Vec<f64>], of_row: &[SiUnit]) -> Option<usize> {
    let noise = |unit: SiUnit| rms.iter().find(|own| own.unit == unit).map_or(1.0, BeforeAfter::noise);
    let weight: Vec<f64> = of_row.iter().map(|&unit| noise(unit).powi(-2)).collect();
    let weighed = |squares: &[f64]| -> Vec<f64> {
        squares.iter().zip(&weight).map(|(square, weight)| square * weight).collect()
    };
    let all: Vec<Vec<f64>> = squares.iter().map(|own| weighed(own)).collect();
    let is_in = |row: usize| own.within[row];
    let means: Vec<f64> =
        all.iter().map(|rung| Mean::of(own, rung, &is_in).map_or(f64::INFINITY, |mean| mean.value)).collect();
    let best = (0..means.len()).min_by(|&one, &other| means[one].total_cmp(&means[other]))?;
    let is_as_good = |rung: &usize| {
        let differences: Vec<f64> = all[*rung].iter().zip(&all[best]).map(|(own, best)| own - best).collect();
        let mean = Mean::of(own, &differences, &is_in);
        mean.is_some_and(|mean| mean.value <= mean.standard_error.unwrap_or(0.0))
    };
    (0..=best).find(is_as_good)
}

/// The squared length of what each row leaves.
fn squares(layout: &Layout, left: &[f64]) -> Vec<f64> {
    layout.by_row(left).map(|own| own.iter().map(|value| value * value).sum()).collect()
}

/// A mean over rows, and its standard error as far as units of rows that belong together say it.
#[derive(Clone, Copy)]
struct Mean {
    value: f64,
    standard_error: Option<f64>,
}

impl Mean {
    fn of(own: &Left<'_>, values: &[f64], is_in: &dyn Fn(usize) -> bool) -> Option<Self> {
        let units = own.judged.units();
        let mut sums: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
        for (row, value) in values.iter().enumerate().filter(|(row, value)| is_in(*row) && value.is_finite())
        {
            let (sum, count) = sums.entry(units[row]).or_default();
            *sum += value;
            *count += 1.0;
        }
        let (sum, count) = sums.values().fold((0.0, 0.0), |(sum, count), own| (sum + own.0, count + own.1));
        if count == 0.0 {
            return None;
        }
        let value = sum / count;
        let groups = sums.len() as f64;
        let scatter: f64 = sums.values().map(|own| (own.0 - own.1 * value).powi(2)).sum();
        let standard_error = (groups > 1.0).then(|| (scatter * groups / (groups - 1.0)).sqrt() / count);
        Some(Self { value, standard_error })
    }
}
