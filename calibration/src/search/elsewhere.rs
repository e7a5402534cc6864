//! Elsewhere: the search repeated without an outer third of a joint's range, and judged there.
//!
//! Random folds lie among the rows that were searched; effects that cancel each other do well on them. Poses where nothing
//! was measured are what an amended chain is for.

use faer::Mat;
use model_core::{SymbolId, SymbolKind};
use rayon::prelude::*;

use super::folds::Folds;
use super::problem::Problem;
use super::select::{State, class_columns, select};
use crate::search::context::Context;
use crate::search::round::Round;

/// Different readings below which a joint has no regions.
const DIFFERENT: usize = 12;

/// Rows to learn from and rows to judge on at least, for each of the declared errors.
const ROWS_FOR_AN_ERROR: usize = 3;

/// What the search makes of an outer third of a joint's range without having seen it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Elsewhere {
    /// Over every row there.
    pub all: Judged,
    /// Over the rows that the last fit gives any weight.
    pub kept: Judged,
}

/// Sums of squares of the lengths of residuals, SI, over some rows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Judged {
    pub rows: usize,
    /// By the declared errors alone.
    pub before: f64,
    /// With the effects that the search found without those rows.
    pub after: f64,
}

impl std::ops::Add for Judged {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (before, after) = (self.before + other.before, self.after + other.after);
        Self { rows: self.rows + other.rows, before, after }
    }
}

impl Judged {
    /// Root mean squares before and after; none without rows.
    pub fn rms(self) -> Option<[f64; 2]> {
        (self.rows > 0).then(|| [self.before, self.after].map(|sum| (sum / self.rows as f64).sqrt()))
    }
}

/// Both outer thirds of each joint's range where the data are enough for it.
pub(crate) fn elsewhere(whole: &Context<'_>, last: &Round<'_>) -> Vec<Elsewhere> {
    let found = |region: &Region<'_, '_>| {
        let before = State::declared(&region.seen, |fold| fold == 0).coefficients();
        let after =
            select(&region.seen, &last.classes, &[], |fold| fold == 0, &whole.options).state.coefficients();
        region.judged([&before, &after])
    };
    thirds(whole, last).into_par_iter().filter_map(|third| Some(found(&Region::of(last, third)?))).collect()
}

/// Of none, of the first and so on of the accepted effects, the mean square of what they leave in the outer thirds, fitted to the
/// other two each time; no more than the first entry without such regions.
pub(crate) fn along_the_way(whole: &Context<'_>, last: &Round<'_>) -> Vec<f64> {
    let blocks = class_columns(last.posed.of_rows(), &last.classes);
    let accepted = last.accepted_classes();
    let of_region = |region: Region<'_, '_>| -> Vec<Judged> {
        let mut state = State::declared(&region.seen, |fold| fold == 0);
        let before = state.coefficients();
        let step = |class: &usize| {
            state.add(&blocks[*class]);
            region.judged([&before, &state.coefficients()]).kept
        };
        accepted.iter().map(step).collect()
    };
    let regions: Vec<Vec<Judged>> = thirds(whole, last)
        .into_par_iter()
        .filter_map(|third| Some(of_region(Region::of(last, third)?)))
        .collect();
    let sum = |at: usize| regions.iter().map(|way| way[at]).fold(Judged::default(), std::ops::Add::add);
    let steps: Vec<Judged> = (0..accepted.len()).map(sum).filter(|judged| judged.rows > 0).collect();
    let before = steps.first().map(|first| first.before / first.rows as f64);
    before.into_iter().chain(steps.iter().map(|step| step.after / step.rows as f64)).collect()
}

/// An outer third of a joint's readings, from one to another.
type Third = (SymbolId, f64, f64);

fn thirds(whole: &Context<'_>, last: &Round<'_>) -> Vec<Third> {
    let observations = &*last.posed.rows.observations;
    let mut thirds = Vec::new();
    for (id, readings) in &observations.columns {
        if whole.setting.chain.symbol(*id).kind != SymbolKind::Joint {
            continue;
        }
        let mut sorted = readings.clone();
        sorted.sort_by(f64::total_cmp);
        let third = sorted.len() / 3;
        if third == 0 {
            continue;
        }
        let ends = [(sorted[0], sorted[third - 1]), (sorted[sorted.len() - third], sorted[sorted.len() - 1])];
        sorted.dedup();
        if sorted.len() >= DIFFERENT {
            thirds.extend(ends.map(|(from, to)| (*id, from, to)));
        }
    }
    thirds
}

/// The problem without the rows of an outer third, which lie in its second fold.
struct Region<'a, 'b> {
    last: &'a Round<'b>,
    held: Vec<bool>,
    seen: Problem,
}

impl<'a, 'b> Region<'a, 'b> {
    /// `None` where too few rows lie there, or are left.
    fn of(last: &'a Round<'b>, (joint, from, to): Third) -> Option<Self> {
        let rows = &last.posed.rows;
        let problem = last.posed.of_rows();
        let readings = rows.observations.column(joint)?;
        let held: Vec<bool> =
            rows.columns.row.iter().map(|&row| (from..=to).contains(&readings[row as usize])).collect();
        let least = ROWS_FOR_AN_ERROR * problem.declared();
        let out = held.iter().filter(|&&held| held).count();
        if out < least || held.len() - out < least {
            return None;
        }
        let folds = Folds::held_out(problem.group_of_row(), &held);
        let mut seen = problem.with_folds(folds);
        if let Some(reach) = problem.reach() {
            seen = seen.with_reach(reach.without(|component| !held[component], joint));
        }
        Some(Self { last, held, seen })
    }

    /// What coefficients before and after leave of the rows held out.
    fn judged(&self, coefficients: [&[(usize, f64)]; 2]) -> Elsewhere {
        let rows = &self.last.posed.rows;
        let [before, after] = coefficients.map(|of| left(self.last, &self.seen, of));
        let mut by_row = std::collections::BTreeMap::new();
        for component in (0..self.held.len()).filter(|&component| self.held[component]) {
            let (judged, kept) =
                by_row.entry(rows.columns.row[component]).or_insert((Judged::default(), true));
            judged.rows = 1;
            judged.before += before[component] * before[component];
            judged.after += after[component] * after[component];
            *kept &= rows.counts(component);
        }
        let sum = |some: &dyn Fn(bool) -> bool| {
            let own = by_row.values().filter(|(_, kept)| some(*kept)).map(|(judged, _)| *judged);
            own.fold(Judged::default(), std::ops::Add::add)
        };
        Elsewhere { all: sum(&|_| true), kept: sum(&|kept| kept) }
    }
}

/// What coefficients leave of every component, before whitening.
fn left(last: &Round<'_>, problem: &Problem, coefficients: &[(usize, f64)]) -> Vec<f64> {
    let rows = &last.posed.rows;
    let declared: faer::MatRef<'_, f64> = Mat::as_ref(&rows.columns.declared);
    let own: Vec<&Vec<f64>> = rows.effects.iter().flatten().collect();
    let mut left = problem.before_whitening(problem.residual(), declared, &rows.without);
    for &(column, coefficient) in coefficients {
        let values = match column.checked_sub(problem.declared()) {
            None => problem.basis_before_whitening(column, declared),
            Some(candidate) => problem.before_whitening(column, declared, own[candidate]),
        };
        left.iter_mut().zip(&values).for_each(|(left, value)| *left -= coefficient * value);
    }
    left
}
