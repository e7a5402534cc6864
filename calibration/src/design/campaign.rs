//! A first campaign: the fewest poses with which wanted errors are known as surely as is wanted.
//!
//! The information of a pose is that of a fit at zero errors. What a prior says of the errors counts, where there is one. Without
//! one, combinations of errors that no candidate shows have no uncertainty, and errors with a part in them are lost.

use fit::{FitError, Model};
use model_core::{Chain, SymbolId, SymbolKind};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use observe::{Measure, Poses, Series};

use super::exchange::{Aim, Choice, Rule};
use model_core::ObservableId;

/// Poses of a campaign at most, where nobody fixes their number.
pub const MOST: usize = 400;

/// Sweeps of exchange at most, for each number of poses that is tried.
const SWEEPS: usize = 3;

/// Combinations that the candidates show less than this, against the one that they show best, are not shown: squares of singular
/// values, so that it is the rounding of the derivatives.
const SHOWN: f64 = 1e-12;

/// A part of an error in a combination that no pose shows: below this it is rounding.
const PART: f64 = 1e-6;

/// What is asked of a campaign.
#[derive(Debug, Clone)]
pub struct Wanted<'a> {
    /// What is observed.
    pub observable: ObservableId,
    /// What its numbers are.
    pub measure: Measure,
    /// The standard deviation of each residual component, rad or m.
    pub sigma: &'a [f64],
    /// The errors that are to be known, and the standard uncertainty that is wanted of each, SI.
    pub errors: &'a [(SymbolId, f64)],
    /// The errors that are estimated.
    pub estimated: &'a [SymbolId],
    /// The standard deviation of each of them before anything is measured, SI; none where nothing is known.
    pub prior: Option<&'a [f64]>,
    /// So many poses; none: as few as do.
    pub count: Option<usize>,
}

/// A campaign, and what it promises.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaign {
    /// The poses, as numbers of candidates.
    pub poses: Vec<usize>,
    /// Of each wanted error its standard uncertainty with these poses, SI; none where they do not determine it.
    pub expected: Vec<Option<f64>>,
    /// Of each wanted error what no number of poses among the candidates does better than, SI; infinite where they do not show it.
    pub limit: Vec<f64>,
    /// Of each wanted error the errors that the candidates show only together with it.
    pub beside: Vec<Vec<SymbolId>>,
    /// About how many poses do, where [`MOST`] do not.
    pub needed: Option<f64>,
}

/// The fewest candidates found that do, or the best of the number that is asked for.
///
/// # Errors
/// As a fit at the candidates would have.
pub fn propose(
    chain: &Chain,
    candidates: &[(SymbolId, Vec<f64>)],
    wanted: &Wanted<'_>,
) -> Result<Campaign, FitError> {
    let rows = rows(chain, candidates, wanted)?;
    let space = Space::new(&rows, wanted);
    let rows: Vec<DMatrix<f64>> = rows.iter().map(|row| row * &space.basis).collect();
    let lost = |at: &usize| space.limit[*at] >= wanted.errors[*at].1;
    let known = |at: &usize| space.limit[*at].is_finite();
    // Errors out of reach would draw all poses to themselves.
    let mut aimed: Vec<usize> = (0..wanted.errors.len()).filter(|at| !lost(at)).collect();
    if aimed.is_empty() {
        aimed = (0..wanted.errors.len()).filter(known).collect();
    }
    let columns: Vec<DVector<f64>> =
        aimed.iter().map(|&at| space.of[at].clone() / wanted.errors[at].1).collect();
    let mut found = Choice::new(space.before.clone());
    let mut needed = None;
    if !columns.is_empty() {
        let aim = Aim::Largest(DMatrix::from_columns(&columns));
        let often = wanted.count.unwrap_or(MOST).div_ceil(rows.len().max(1)).max(super::OFTEN);
        let search =
            Search { rule: Rule { rows: &rows, aim: &aim, often }, columns: &columns, space: &space };
        (found, needed) = search.found(wanted.count);
    }
    let covariance = space.covariance(&rows, &found.chosen);
    let expected = |at: usize| {
        let variance = space.of[at].dot(&(&covariance * &space.of[at]));
        // What a single direction of the start still holds is not known.
        let is_known = space.limit[at].is_finite() && variance.is_finite() && variance < space.unknown(at);
        is_known.then(|| variance.max(0.0).sqrt())
    };
    Ok(Campaign {
        expected: (0..wanted.errors.len()).map(expected).collect(),
        poses: found.chosen,
        limit: space.limit.clone(),
        beside: space.beside.clone(),
        needed,
    })
}

/// The derivatives of each candidate's residual components by the estimated errors, in units of the noise.
fn rows(
    chain: &Chain,
    candidates: &[(SymbolId, Vec<f64>)],
    wanted: &Wanted<'_>,
) -> Result<Vec<DMatrix<f64>>, FitError> {
    let count = candidates.first().map_or(0, |(_, values)| values.len());
    let series = Series {
        observable: wanted.observable,
        measure: wanted.measure,
        rows: 0..count,
        source: "the candidates".to_owned(),
    };
    let mut columns = candidates.to_vec();
    columns.sort_by_key(|(id, _)| *id);
    let poses = Poses { series: vec![series], columns };
    let model = Model::new(chain, &poses, wanted.estimated)?;
    let mut values = chain.nominal_values();
    chain.symbols_of(SymbolKind::Error).for_each(|error| values[error.index()] = 0.0);
    let (m, p) = (wanted.measure.components(), wanted.estimated.len());
    let made = model.map_poses(&poses, &values, |_, _, block| {
        let columns: Vec<&[f64]> = block.columns().collect();
        let row = |row: usize| {
            DMatrix::from_fn(m, p, |component, parameter| {
                let at = component * block.rows + row;
                let derivative = model.column_of()[parameter].map_or(0.0, |column| columns[column][at]);
                derivative / wanted.sigma[component]
            })
        };
        let defined = |at: usize| block.defined[at];
        // A pose without a value shows nothing, and so is never chosen.
        (0..block.rows).map(|at| if defined(at) { row(at) } else { DMatrix::zeros(m, p) }).collect::<Vec<_>>()
    })?;
    let finite = |row: DMatrix<f64>| {
        let is_finite = row.iter().all(|value| value.is_finite());
        if is_finite { row } else { DMatrix::zeros(m, p) }
    };
    Ok(made.into_iter().flatten().map(finite).collect())
}

/// What the candidates show, in units in which each error's column over all of them has length one.
struct Space {
    /// From what is shown to the errors in their own units, one a row.
    basis: DMatrix<f64>,
    /// The covariance before anything is measured.
    before: DMatrix<f64>,
    /// The inverse of the same.
    information: DMatrix<f64>,
    /// Each wanted error as a combination of what is shown.
    of: Vec<DVector<f64>>,
    /// What any number of poses leaves of each.
    limit: Vec<f64>,
    /// The errors that each is shown with only.
    beside: Vec<Vec<SymbolId>>,
    /// Whether something is known before.
    is_prior: bool,
}

/// The information before anything is measured, where nothing is known: just about none.
const ALMOST_NONE: f64 = 1e-9;

/// An error is not determined where more than this is left of its variance before anything is measured.
const UNKNOWN: f64 = 1e-3;

impl Space {
    fn new(rows: &[DMatrix<f64>], wanted: &Wanted<'_>) -> Self {
        let p = wanted.estimated.len();
        let mut all = DMatrix::zeros(p, p);
        rows.iter().for_each(|row| all += row.transpose() * row);
        let length = |at: usize| if all[(at, at)] > 0.0 { all[(at, at)].sqrt() } else { 1.0 };
        let scale: Vec<f64> = (0..p).map(length).collect();
        let scaled = DMatrix::from_fn(p, p, |i, j| all[(i, j)] / scale[i] / scale[j]);
        let parts = SymmetricEigen::new(scaled);
        let most = parts.eigenvalues.iter().copied().fold(0.0, f64::max);
        let shown: Vec<usize> = (0..p).filter(|&at| parts.eigenvalues[at] > SHOWN * most).collect();
        let hidden: Vec<usize> = (0..p).filter(|at| !shown.contains(at)).collect();
        let vectors =
            |some: &[usize]| DMatrix::from_fn(p, some.len(), |row, at| parts.eigenvectors[(row, some[at])]);
        let (seen, unseen) = (vectors(&shown), vectors(&hidden));
        let places: Vec<usize> = wanted
            .errors
            .iter()
            .filter_map(|(error, _)| wanted.estimated.iter().position(|other| other == error))
            .collect();
        let onto = &unseen * unseen.transpose();
        let beside = |&at: &usize| -> Vec<SymbolId> {
            let others = (0..p).filter(|&other| other != at && onto[(other, at)].abs() > PART);
            others.map(|other| wanted.estimated[other]).collect()
        };
        let beside = places.iter().map(beside).collect();
        let unscale = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(p, matrix.ncols(), |row, at| matrix[(row, at)] / scale[row])
        };
        match wanted.prior {
            None => {
                let basis = unscale(&seen);
                let k = shown.len();
                let is_hidden = |at: usize| onto[(at, at)].max(0.0).sqrt() > PART;
                Self {
                    of: places.iter().map(|&at| basis.row(at).transpose()).collect(),
                    limit: places.iter().map(|&at| if is_hidden(at) { f64::INFINITY } else { 0.0 }).collect(),
                    before: DMatrix::identity(k, k) / ALMOST_NONE,
                    information: DMatrix::identity(k, k) * ALMOST_NONE,
                    basis,
                    beside,
                    is_prior: false,
                }
            }
            Some(prior) => {
                // In units of the prior: what no pose shows keeps its spread.
                let basis = DMatrix::from_diagonal(&DVector::from_row_slice(prior));
                let stays =
                    DMatrix::from_fn(p, hidden.len(), |row, at| unseen[(row, at)] / scale[row] / prior[row]);
                // What no pose shows is empty where all is shown, and an empty matrix has no parts.
                let left = (!hidden.is_empty()).then(|| stays.svd(true, false));
                let limit = |&at: &usize| {
                    let Some((u, sizes)) =
                        left.as_ref().and_then(|own| Some((own.u.as_ref()?, &own.singular_values)))
                    else {
                        return 0.0;
                    };
                    let axes = (0..u.ncols()).filter(|&axis| sizes[axis] > 0.0);
                    prior[at] * axes.map(|axis| u[(at, axis)].powi(2)).sum::<f64>().sqrt()
                };
                Self {
                    of: places.iter().map(|&at| basis.row(at).transpose()).collect(),
                    limit: places.iter().map(limit).collect(),
                    before: DMatrix::identity(p, p),
                    information: DMatrix::identity(p, p),
                    basis,
                    beside,
                    is_prior: true,
                }
            }
        }
    }

    /// The variance from which a wanted error counts as undetermined: a part of that before anything is measured.
    fn unknown(&self, at: usize) -> f64 {
        if self.is_prior { f64::INFINITY } else { UNKNOWN * self.of[at].norm_squared() / ALMOST_NONE }
    }

    /// The covariance with some candidates, from all of their rows at once; the rows are in terms of what is shown.
    fn covariance(&self, rows: &[DMatrix<f64>], chosen: &[usize]) -> DMatrix<f64> {
        let mut information = self.information.clone();
        chosen.iter().for_each(|&at| information += rows[at].transpose() * &rows[at]);
        information.cholesky().map_or_else(|| self.before.clone(), |own| own.inverse())
    }
}

/// The search for the number of poses.
struct Search<'a> {
    rule: Rule<'a>,
    columns: &'a [DVector<f64>],
    space: &'a Space,
}

impl Search<'_> {
    /// The poses; and about how many do where these are too few.
    fn found(&self, count: Option<usize>) -> (Choice, Option<f64>) {
        let mut grown = Choice::new(self.space.before.clone());
        if let Some(count) = count {
            grown.grow(&self.rule, count);
            let best = self.exchanged(grown, false);
            return (best, None);
        }
        while self.worst(&grown) > 1.0 && grown.chosen.len() < MOST {
            let before = grown.chosen.len();
            grown.grow(&self.rule, before + 1);
            if grown.chosen.len() == before {
                break;
            }
        }
        if self.worst(&grown) > 1.0 {
            let needed = grown.chosen.len() as f64 * self.worst(&grown);
            return (grown, Some(needed));
        }
        // Exchange does with fewer what choosing one by one does.
        let components = self.rule.rows.first().map_or(1, DMatrix::nrows);
        let (mut few, mut best) = ((self.columns.len() / components).saturating_sub(1), grown);
        let order = best.chosen.clone();
        while best.chosen.len() > few + 1 {
            let middle = (few + best.chosen.len()) / 2;
            let mut tried = Choice::new(self.space.before.clone());
            tried.chosen = order[..middle].to_vec();
            tried.covariance = self.space.covariance(self.rule.rows, &tried.chosen);
            let tried = self.exchanged(tried, true);
            if self.worst(&tried) <= 1.0 { best = tried } else { few = middle }
        }
        (best, None)
    }

    /// The best of some sweeps of exchange; the first that does, where that is enough.
    fn exchanged(&self, mut choice: Choice, is_enough: bool) -> Choice {
        let mut best = choice.clone();
        for _ in 0..SWEEPS {
            if is_enough && self.worst(&best) <= 1.0 || !choice.exchange(&self.rule) {
                break;
            }
            choice.covariance = self.space.covariance(self.rule.rows, &choice.chosen);
            if self.worst(&choice) < self.worst(&best) {
                best = choice.clone();
            }
        }
        best
    }

    /// The largest variance of what is wanted, over the wanted one.
    fn worst(&self, choice: &Choice) -> f64 {
        let variance = |of: &DVector<f64>| of.dot(&(&choice.covariance * of));
        self.columns.iter().map(variance).fold(0.0, f64::max)
    }
}
