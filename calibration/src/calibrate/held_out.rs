//! Before and after, on the data that were fitted and on data that no stage saw, in physical units: over every row, and
//! over the rows kept.
//!
//! Which held-out rows are gross outliers is for the searches that did not see them to say: a row is kept if what its
//! fold's search predicts of it lies nearer than where the robust weights end. The same rows are kept before and after.

use super::without::{Without, values_of};
use crate::diagnose::Rms;
use crate::diagnose::expected_rms;
use crate::diagnose::rms::BeforeAfter;
use crate::limits::REFITTED;
use crate::search::HeldOut;
use crate::search::SearchError;
use crate::search::columns::Columns;
use crate::search::context::{Context, declared};
use crate::search::elsewhere::{Elsewhere, Judged, elsewhere};
use crate::search::fitted::Fitted;
use crate::search::round::Round;
use crate::search::row_set::RowSet;
use effects::candidate::EffectId;
use fit::noise::Layout;
use fit::{FitResult, robust};
use observe::{Observations, SiUnit};

/// Unit by unit of the residuals: in sample; held out from the study's second file, or else from the nested folds; and in the outer thirds of the joints'
/// ranges, from searches that did not see them.
pub(super) fn rms<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    last: &Round<'_>,
    held_out: &HeldOut,
) -> Result<Judgement<'a>, SearchError> {
    let observations = whole.request.observations;
    let layout = &last.fitted.layout;
    // Where nothing was added, the last fit is that of the declaration, wherever the first one ended.
    let before = if last.fitted.found.is_empty() { &last.fitted.fit } else { before };
    let left = left(whole, before, last, held_out)?;
    let weight = &last.fitted.fit.residuals.weight;
    let kept = |row: usize| weight[row] > 0.0;
    let units = observations.poses.units();
    let of_row = observations.poses.unit_of_row();
    let thirds = elsewhere(whole, last, &units);
    let of_unit = |(place, &unit): (usize, &SiUnit)| {
        let in_sample =
            |fit: &FitResult| Figures::of(&fit.residuals.raw, layout, |row| of_row[row] == unit, kept);
        let [held_before, held_after] = match &left {
            None => [Figures::default(), Figures::default()],
            Some(Left { before, after, layout, within, judged }) => {
                let of_row = judged.poses.unit_of_row();
                [before, after].map(|left| {
                    let own = |row: usize| of_row[row] == unit;
                    Figures::of(left, layout, own, |row| within[row])
                })
            }
        };
        let [all, kept] = [|third: &Elsewhere| third.all, |third: &Elsewhere| third.kept].map(|part| {
            let own = thirds.iter().map(|third| part(&third[place]));
            own.fold(Judged::default(), std::ops::Add::add).rms()
        });
        let beside = |rms: Rms, at: usize| Rms {
            elsewhere_rms: all.map(|rms| rms[at]),
            elsewhere_rms_kept: kept.map(|rms| rms[at]),
            ..rms
        };
        BeforeAfter {
            unit,
            expected: expected_rms(observations, &last.fitted.fit, unit),
            before: beside(held_before.beside(in_sample(before)), 0),
            after: beside(held_after.beside(in_sample(&last.fitted.fit)), 1),
        }
    };
    let rms = units.iter().enumerate().map(of_unit).collect();
    Ok(Judgement { rms, left })
}

/// Figures, and what is behind those of held-out rows.
pub(super) struct Judgement<'a> {
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    /// None where nothing is held out, or where whole objects are.
    pub left: Option<Left<'a>>,
}

/// What held-out rows leave, component by component, before whitening.
pub(super) struct Left<'a> {
    /// By the declared errors alone.
    pub before: Vec<f64>,
    /// With the effects that searches without them found.
    pub after: Vec<f64>,
    pub layout: Layout,
    /// Which rows are within reach.
    pub within: Vec<bool>,
    /// The rows that are judged: those of the study, or of its second file.
    pub judged: &'a Observations,
}

/// Of the study's second file, or else of the folds; none where nothing is held out.
fn left<'a>(
    whole: &Context<'a>,
    before: &FitResult,
    last: &Round<'_>,
    held_out: &HeldOut,
) -> Result<Option<Left<'a>>, SearchError> {
    let observations = whole.request.observations;
    if let Some(second) = whole.request.second {
        let residual = |chain, values: &[f64]| Columns::at(chain, second, declared(whole), values, &[]);
        let chain = &whole.request.plan.chain;
        let before = residual(chain, &values_of(chain, before))?.residual;
        let after = residual(&last.fitted.chain, &last.fitted.fit.values)?.residual;
        let within = vec![true; second.rows()];
        return Ok(Some(Left { before, after, layout: Layout::of(second), within, judged: second }));
    }
    if last.search.problem.folds() < 2 {
        return Ok(None);
    }
    let [stepped, mut after] = predicted(whole, last, [&held_out.before, &held_out.after])?;
    let own = if is_refitted(whole, before) {
        let plan = whole.request.plan;
        let of_row = |row: usize| last.search.fold_of(last.fitted.layout.first(row));
        let folds = last.search.problem.folds();
        Without::of(&plan.chain, observations, &plan.fit, before)?.each(of_row, folds)?
    } else {
        stepped
    };
    // Where no search found anything, after is before.
    if last.fitted.found.is_empty() && held_out.chosen.iter().all(Vec::is_empty) {
        after.clone_from(&own);
    }
    let within = within_reach(whole, last, &after);
    Ok(Some(Left { before: own, after, layout: last.fitted.layout.clone(), within, judged: observations }))
}

/// Whether the declaration is fitted by itself without each fold. Where nobody knows where objects are, each of them is estimated
/// anew by the search's own step.
pub(super) fn is_refitted(whole: &Context<'_>, before: &FitResult) -> bool {
    let observations = whole.request.observations;
    observations.unknowns.is_none()
        && before.outcome.is_usable()
        && observations.poses.components() * before.parameters.len() <= REFITTED
}

/// In sample alone, where no search was made.
pub(crate) fn of_fit(observations: &Observations, fitted: &Fitted) -> Vec<BeforeAfter> {
    let residuals = &fitted.fit.residuals;
    let kept = |row: usize| residuals.weight.get(row).is_some_and(|&weight| weight > 0.0);
    let of_row = observations.poses.unit_of_row();
    let of_unit = |unit: SiUnit| {
        let own = |row: usize| of_row[row] == unit;
        let rms = Figures::default().beside(Figures::of(&residuals.raw, &fitted.layout, own, kept));
        let expected = expected_rms(observations, &fitted.fit, unit);
        BeforeAfter { unit, expected, before: rms, after: rms }
    };
    observations.poses.units().into_iter().map(of_unit).collect()
}

/// RMS of some residuals, each with how many rows it is over; none without rows.
#[derive(Default)]
struct Figures {
    /// Over every row.
    all: Option<(f64, usize)>,
    /// Over the rows kept.
    kept: Option<(f64, usize)>,
}

impl Figures {
    /// Over the rows `own`.
    fn of(
        residual: &[f64],
        layout: &Layout,
        own: impl Fn(usize) -> bool,
        kept: impl Fn(usize) -> bool,
    ) -> Self {
        let all = length(residual, layout, &own);
        Self { all, kept: length(residual, layout, |row| own(row) && kept(row)) }
    }

    /// These as held out, beside those in sample.
    fn beside(self, in_sample: Self) -> Rms {
        let rms = |figure: Option<(f64, usize)>| figure.map(|(rms, _)| rms);
        let count = |figure: Option<(f64, usize)>| figure.map_or(0, |(_, rows)| rows);
        Rms {
            rms: rms(in_sample.all),
            rms_kept: rms(in_sample.kept),
            held_out_rms: rms(self.all),
            held_out_rms_kept: rms(self.kept),
            held_out_rows: count(self.all),
            held_out_rows_kept: count(self.kept),
            elsewhere_rms: None,
            elsewhere_rms_kept: None,
        }
    }
}

/// Per row whether a held-out residual is within reach of the robust weights; every row if the fit is not robust.
fn within_reach(whole: &Context<'_>, last: &Round<'_>, residual: &[f64]) -> Vec<bool> {
    let observations = whole.request.observations;
    if !whole.request.plan.fit.robust {
        return vec![true; observations.rows()];
    }
    let sigma = last.fitted.fit.noise.sigma_without_memory();
    let layout = &last.fitted.layout;
    let is_within = |(residual, sigma): (&[f64], &[f64])| {
        let white = residual.iter().zip(sigma).map(|(value, sigma)| value / sigma);
        white.map(|value| value * value).sum::<f64>().sqrt() < robust::cutoff(residual.len())
    };
    layout.by_row(residual).zip(layout.by_row(&sigma)).map(is_within).collect()
}

/// Per fold the coefficients of the columns of the problem that were used.
type Coefficients = [Vec<(usize, f64)>];

/// What each row's fold, fitted without it, leaves of it, before whitening, by either set of coefficients.
pub(crate) fn predicted<const N: usize>(
    whole: &Context<'_>,
    last: &Round<'_>,
    coefficients: [&Coefficients; N],
) -> Result<[Vec<f64>; N], SearchError> {
    let candidates = last.search.candidates(whole);
    let used = coefficients.iter().flat_map(|of_folds| of_folds.iter().flatten());
    let used = used.filter_map(|&(column, _)| column.checked_sub(last.search.problem.declared()));
    let mut wanted: Vec<EffectId> = used.map(|candidate| candidates[candidate].0).collect();
    wanted.sort_unstable();
    let wanted = |effect: EffectId| wanted.binary_search(&effect).is_ok();
    let predicted = |components: &[usize], row_set: &RowSet<'_>| {
        let of = |coefficients| predicted_of(last, &candidates, coefficients, components, row_set);
        (components.to_vec(), coefficients.map(of))
    };
    let mut left = [(); N].map(|()| vec![0.0; last.fitted.layout.components()]);
    last.search.each_row_set(whole, &last.fitted, wanted, predicted, |(components, parts)| {
        for (left, part) in left.iter_mut().zip(parts) {
            components.iter().zip(part).for_each(|(&component, value)| left[component] = value);
        }
    })?;
    Ok(left)
}

/// The same for some of the rows, which have these components of all.
fn predicted_of(
    last: &Round<'_>,
    candidates: &[(EffectId, usize)],
    coefficients: &Coefficients,
    components: &[usize],
    row_set: &RowSet<'_>,
) -> Vec<f64> {
    let problem = &last.search.problem;
    let declared = row_set.columns.declared.as_ref();
    let mut left = problem.before_whitening(problem.residual(), declared, &row_set.without);
    let mut columns: Vec<usize> = coefficients.iter().flatten().map(|&(column, _)| column).collect();
    columns.sort_unstable();
    columns.dedup();
    for column in columns {
        let values = match column.checked_sub(problem.declared()) {
            None => problem.basis_before_whitening(column, declared),
            Some(candidate) => {
                let (effect, function) = candidates[candidate];
                problem.before_whitening(column, declared, &row_set.effects[effect.0][function])
            }
        };
        let by_fold: Vec<f64> = coefficients
            .iter()
            .map(|fold| fold.iter().find(|&&(c, _)| c == column).map_or(0.0, |&(_, b)| b))
            .collect();
        for (&component, (left, value)) in components.iter().zip(left.iter_mut().zip(&values)) {
            *left -= by_fold[last.search.fold_of(component)] * value;
        }
    }
    row_set.with_objects_anew(left)
}

/// RMS over observations of the length of the residual, and how many they are; `None` without observations. Rows at which
/// the chain has no finite value have no residual, and do not count.
fn length(residual: &[f64], layout: &Layout, used: impl Fn(usize) -> bool) -> Option<(f64, usize)> {
    let (mut squares, mut count) = (0.0, 0_u32);
    for (row, own) in layout.by_row(residual).enumerate() {
        let square: f64 = own.iter().map(|value| value * value).sum();
        if used(row) && square.is_finite() {
            squares += square;
            count += 1;
        }
    }
    (count > 0).then(|| (f64::sqrt(squares / f64::from(count)), count as usize))
}
