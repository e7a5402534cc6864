//! Elsewhere: the search repeated without an outer third of a joint's range, and judged there.
//!
//! Random folds lie among the rows that were searched; effects that cancel each other do well on them. Poses where nothing
//! was measured are what an amended chain is for.

use faer::Mat;
use model_core::{SymbolId, SymbolKind};

use super::folds::Folds;
use super::problem::Problem;
use super::state::State;
use crate::search::context::Context;
use crate::search::round::Round;
use observe::SiUnit;

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

/// Both outer thirds of each joint's range where the data are enough for it; of each one figure for each unit of residuals.
pub(crate) fn elsewhere(whole: &Context<'_>, last: &Round<'_>, units: &[SiUnit]) -> Vec<Vec<Elsewhere>> {
    let observations = &*last.search.rows.observations;
    if observations.unknowns.is_some() {
        // A region cuts through objects: what stands inside and outside would be one unknown.
        return Vec::new();
    }
    let mut thirds = Vec::new();
    for (id, readings) in &observations.poses.columns {
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
    let each = parallel::each_of(thirds, |(joint, from, to)| judged(whole, last, units, joint, from, to));
    each.into_iter().flatten().collect()
}

fn judged(
    whole: &Context<'_>,
    last: &Round<'_>,
    units: &[SiUnit],
    joint: SymbolId,
    from: f64,
    to: f64,
) -> Option<Vec<Elsewhere>> {
    let rows = &last.search.rows;
    let problem = last.search.of_rows();
    let readings = rows.observations.poses.column(joint)?;
    let held: Vec<bool> =
        rows.columns.row.iter().map(|&row| (from..=to).contains(&readings[row as usize])).collect();
    let least = ROWS_FOR_AN_ERROR * problem.declared();
    let out = held.iter().filter(|&&held| held).count();
    if out < least || held.len() - out < least {
        return None;
    }
    let of_rows = &problem.group_of_row()[..held.len()];
    let folds = Folds::held_out(of_rows, &held).with_stated(&vec![None; problem.stated()]);
    let mut seen = problem.with_folds(folds);
    if let Some(reach) = problem.reach() {
        seen = seen.with_reach(reach.without(|component| !held[component], joint));
    }
    let before = State::declared(&seen, |fold| fold == 0).coefficients();
    let after = last.repeated(whole, &seen, |fold| fold == 0).1.coefficients();
    let (before, after) = (left(last, &seen, &before), left(last, &seen, &after));
    let mut by_row = std::collections::BTreeMap::new();
    for component in (0..held.len()).filter(|&component| held[component]) {
        let (judged, kept) = by_row.entry(rows.columns.row[component]).or_insert((Judged::default(), true));
        judged.rows = 1;
        judged.before += before[component] * before[component];
        judged.after += after[component] * after[component];
        *kept &= rows.counts(component);
    }
    let of_row = rows.observations.poses.unit_of_row();
    let of_unit = |&unit: &SiUnit| {
        let sum = |some: &dyn Fn(bool) -> bool| {
            let own = by_row.iter().filter(|(row, (_, kept))| of_row[**row as usize] == unit && some(*kept));
            own.map(|(_, (judged, _))| *judged).fold(Judged::default(), std::ops::Add::add)
        };
        Elsewhere { all: sum(&|_| true), kept: sum(&|kept| kept) }
    };
    Some(units.iter().map(of_unit).collect())
}

/// What coefficients leave of every component, before whitening.
fn left(last: &Round<'_>, problem: &Problem, coefficients: &[(usize, f64)]) -> Vec<f64> {
    let rows = &last.search.rows;
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
