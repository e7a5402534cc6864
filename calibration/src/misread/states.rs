//! Rows of two kinds that no column tells apart: two targets, two prism constants, a play that rests on either side.
//!
//! Near the errors found so far the residual is J a + z C d + noise: z is 0 or 1 in each row, and d is by how much one error, or the shifts
//! of one body, differ between the kinds. Rows and d are found in turn, until no row changes.

use model_core::{ObservableId, Role, SymbolId, TransformKind};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::estimated;
use super::hypotheses::{Hypothesis, Reading};
use super::policy::{RARE, STATES_APART, STATES_FEWEST_SHARE, STATES_PRICE, STATES_SCATTERED};
use super::score::{Score, log_density, trimmed, width};
use crate::search::columns::Columns;
use fit::noise::Layout;
use observe::Observations;
use study::{Plan, Undeclared};

/// Rounds until no row changes.
const ROUNDS: usize = 30;

/// Singular values below this share of the largest are rounding.
const ROUNDING: f64 = 1e-9;

/// The rows of a sample with all that says which kind each could be.
pub(super) struct Rows<'a> {
    pub plan: &'a Plan,
    pub observations: &'a Observations,
    /// Columns of the file that the study does not name.
    pub labels: &'a [Undeclared],
    /// The logarithm of how much the residual changes with the numbers as they are written.
    pub jacobian: f64,
}

/// A way in which two kinds of rows may differ.
struct Candidate {
    errors: Vec<SymbolId>,
    /// How the residual changes with them.
    columns: DMatrix<f64>,
}

/// Rows in two kinds.
struct Parted {
    is_other: Vec<bool>,
    by: DVector<f64>,
    left: DVector<f64>,
}

impl Rows<'_> {
    /// The best way to part the rows; `None` where they are of one kind, or where an order, a joint or a column tells the kinds apart.
    pub fn parted(&self, as_read: &Score) -> Option<(Hypothesis, Score)> {
        let [series] = &self.observations.poses.series[..] else { return None };
        let (rows, stride) = (self.observations.rows(), series.measure.components());
        let errors: Vec<SymbolId> = estimated(self.plan).collect();
        let (residual, jacobian) = self.linearised(&errors, &as_read.values)?;
        let basis = basis(&jacobian);
        let left = &residual - &basis * basis.tr_mul(&residual);
        let candidates = self.candidates(series.observable, &errors, &jacobian);
        let number = candidates.len() as f64;
        let judged = candidates.into_iter().filter_map(|candidate| {
            let parted = part(&candidate.columns, &basis, &left, stride)?;
            let few = parted.is_other.iter().filter(|other| **other).count();
            let share = few as f64 / rows as f64;
            let is_apart = parted.spread(&candidate.columns, stride) * STATES_APART <= 1.0;
            if share < STATES_FEWEST_SHARE || !is_apart || !self.is_scattered(&parted.is_other, few) {
                return None;
            }
            let scored = self.scored(as_read, &parted, candidate.errors.len(), share, number)?;
            Some((candidate, parted, scored))
        });
        let (candidate, parted, (price, score)) =
            judged.max_by(|one, other| one.2.1.total.total_cmp(&other.2.1.total))?;
        Some((self.hypothesis(&candidate, &parted, price), score))
    }

    /// The residual, and how it falls as each error rises to what it is.
    fn linearised(&self, errors: &[SymbolId], values: &[f64]) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let columns = Columns::at(&self.plan.chain, self.observations, errors, values, &[]).ok()?;
        let declared = &columns.declared;
        let jacobian =
            DMatrix::from_fn(declared.nrows(), errors.len(), |row, column| declared[(row, column)]);
        let residual = DVector::from_vec(columns.residual);
        let is_finite = residual.iter().chain(jacobian.iter()).all(|value| value.is_finite());
        (!errors.is_empty() && is_finite).then_some((residual, jacobian))
    }

    /// Each error, and the shifts of each body together.
    fn candidates(
        &self,
        observable: ObservableId,
        errors: &[SymbolId],
        jacobian: &DMatrix<f64>,
    ) -> Vec<Candidate> {
        let of = |own: Vec<usize>| Candidate {
            errors: own.iter().map(|at| errors[*at]).collect(),
            columns: jacobian.select_columns(&own),
        };
        let mut sets: Vec<Vec<usize>> = (0..errors.len()).map(|at| vec![at]).collect();
        let way = self.plan.chain.way(observable);
        let mut bodies: Vec<_> = way.iter().map(|passed| passed.body).collect();
        bodies.dedup();
        for body in bodies {
            let is_shift = |at: &usize| {
                way.iter().any(|passed| {
                    passed.body == body
                        && passed.factor.kind == TransformKind::Translation
                        && matches!(passed.factor.role, Role::PositionError | Role::MotionError)
                        && passed.factor.amount.symbols().contains(&errors[*at])
                })
            };
            let shifts: Vec<usize> = (0..errors.len()).filter(is_shift).collect();
            if shifts.len() > 1 && !sets.contains(&shifts) {
                sets.push(shifts);
            }
        }
        sets.into_iter().map(of).collect()
    }

    /// Whether the kinds change often enough along the rows, along every reading and along its changes, and no column tells them.
    fn is_scattered(&self, is_other: &[bool], few: usize) -> bool {
        let rows = is_other.len();
        let by_chance = 2.0 * few as f64 * (rows - few) as f64 / rows as f64;
        let changes = |order: &[usize]| {
            order.windows(2).filter(|pair| is_other[pair[0]] != is_other[pair[1]]).count() as f64
        };
        let along = |values: &[f64]| {
            let mut order: Vec<usize> = (0..rows).collect();
            order.sort_by(|one, other| values[*one].total_cmp(&values[*other]));
            changes(&order)
        };
        let least = STATES_SCATTERED * by_chance;
        let is_free_of = |values: &[f64]| {
            let steps: Vec<f64> = (0..rows).map(|row| values[row] - values[row.saturating_sub(1)]).collect();
            along(values) >= least && along(&steps) >= least
        };
        let in_order: Vec<usize> = (0..rows).collect();
        changes(&in_order) >= least
            && self.observations.poses.columns.iter().all(|(_, values)| is_free_of(values))
            && self.labels.iter().all(|labels| !tells(&labels.of_row, is_other, few))
    }

    fn scored(
        &self,
        as_read: &Score,
        parted: &Parted,
        more: usize,
        share: f64,
        candidates: f64,
    ) -> Option<(f64, Score)> {
        let left = parted.left.as_slice();
        let (rows, numbers) = (parted.is_other.len() as f64, left.len() as f64);
        let entropy = -share * share.ln() - (1.0 - share) * (1.0 - share).ln();
        let price = STATES_PRICE - RARE.ln()
            + candidates.ln()
            + rows * entropy
            + 0.5 * (more as f64 + 1.0) * rows.ln();
        let width = width(left);
        let free = (numbers - (as_read.rank + more) as f64).max(1.0);
        let total = free / numbers * (self.jacobian + log_density(left, width)) - price - as_read.penalty;
        let norms: Vec<f64> = Layout::of(self.observations).norms(left).collect();
        let score = Score {
            total,
            scale: (width.ln() - self.jacobian / numbers).exp(),
            rms: trimmed(&norms),
            ..as_read.clone()
        };
        total.is_finite().then_some((price, score))
    }

    fn hypothesis(&self, candidate: &Candidate, parted: &Parted, price: f64) -> Hypothesis {
        let symbol = |id: &SymbolId| self.plan.chain.symbol(*id);
        let number = |row: usize| self.observations.row_numbers.get(row).unwrap_or_default();
        let rows =
            parted.is_other.iter().enumerate().filter(|(_, other)| **other).map(|(row, _)| number(row));
        let reading = Reading::TwoStates {
            errors: candidate.errors.iter().map(|id| symbol(id).name.clone()).collect(),
            by: parted.by.iter().copied().collect(),
            units: candidate.errors.iter().map(|id| symbol(id).quantity.into()).collect(),
            rows: rows.collect(),
            of: parted.is_other.len(),
        };
        Hypothesis::new(reading, Vec::new(), Vec::new(), price)
    }
}

impl Parted {
    /// How far rows of one kind spread along the difference of the kinds, over that difference: a third of it where nothing parts them.
    fn spread(&self, columns: &DMatrix<f64>, stride: usize) -> f64 {
        let apart = columns * &self.by;
        let (mut along, mut whole) = (0.0, 0.0);
        for row in 0..self.is_other.len() {
            let (own, left) = (apart.rows(row * stride, stride), self.left.rows(row * stride, stride));
            let square = own.norm_squared();
            if square > 0.0 {
                along += own.dot(&left).powi(2) / square;
                whole += square;
            }
        }
        (along / whole).sqrt()
    }
}

/// An orthonormal basis of what the columns of a matrix span.
fn basis(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let svd = matrix.clone().svd(true, false);
    let Some(u) = svd.u else { unreachable!("it was asked for") };
    let largest = svd.singular_values.max();
    let kept: Vec<usize> =
        (0..u.ncols()).filter(|at| svd.singular_values[*at] > ROUNDING * largest).collect();
    u.select_columns(&kept)
}

/// Rows in two kinds that differ along some columns; the smaller kind is the other one.
fn part(columns: &DMatrix<f64>, basis: &DMatrix<f64>, left: &DVector<f64>, stride: usize) -> Option<Parted> {
    let rows = left.len() / stride;
    let mut is_other = first_guess(columns, left, stride)?;
    let mut last = None;
    for _ in 0..ROUNDS {
        let mut own = columns.clone();
        for row in (0..rows).filter(|row| !is_other[*row]) {
            own.rows_mut(row * stride, stride).fill(0.0);
        }
        let free = &own - basis * basis.tr_mul(&own);
        let by = free.clone().svd(true, true).solve(left, ROUNDING * free.amax()).ok()?;
        let left_of = left - &free * &by;
        let moved = columns * &by;
        let part = |vector: &DVector<f64>, row: usize| vector.rows(row * stride, stride).into_owned();
        let changed: Vec<bool> = (0..rows)
            .map(|row| {
                let (left, moved) = (part(&left_of, row), part(&moved, row));
                let without = if is_other[row] { &left + &moved } else { left };
                (&without - &moved).norm_squared() < without.norm_squared()
            })
            .collect();
        let is_settled = changed == is_other;
        last = Some(Parted { is_other: is_other.clone(), by, left: left_of });
        if is_settled {
            break;
        }
        is_other = changed;
    }
    let mut parted = last?;
    if 2 * parted.is_other.iter().filter(|other| **other).count() > rows {
        parted.is_other.iter_mut().for_each(|other| *other = !*other);
        parted.by.neg_mut();
    }
    Some(parted)
}

/// The rows on either side of the widest parting of what each row alone says of the difference.
fn first_guess(columns: &DMatrix<f64>, left: &DVector<f64>, stride: usize) -> Option<Vec<bool>> {
    let rows = left.len() / stride;
    let alone = |row: usize| {
        let own = columns.rows(row * stride, stride).into_owned();
        let svd = own.clone().svd(true, true);
        svd.solve(&left.rows(row * stride, stride).into_owned(), 1e-3 * columns.amax()).ok()
    };
    let said: Vec<DVector<f64>> = (0..rows).map(alone).collect::<Option<_>>()?;
    // A row that the difference hardly moves says little of it.
    let weights: Vec<f64> = (0..rows).map(|row| columns.rows(row * stride, stride).norm_squared()).collect();
    let whole: f64 = weights.iter().sum();
    let weighted = || said.iter().zip(&weights);
    let middle = weighted().map(|(own, weight)| own * *weight).sum::<DVector<f64>>() / whole;
    let mut spread = DMatrix::zeros(middle.len(), middle.len());
    for (own, weight) in weighted() {
        let off = own - &middle;
        spread += *weight * &off * off.transpose();
    }
    let eigen = SymmetricEigen::new(spread);
    let along = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let mut at: Vec<(f64, usize)> =
        said.iter().enumerate().map(|(row, own)| ((own - &middle).dot(&along), row)).collect();
    at.sort_by(|one, other| one.0.total_cmp(&other.0));
    // Most of the variance lies between the two parts.
    let all: f64 = at.iter().map(|(value, row)| value * weights[*row]).sum();
    let (mut below, mut few) = (0.0, 0.0);
    let mut best = (f64::NEG_INFINITY, 0);
    for (number, (value, row)) in at.iter().enumerate().take(rows - 1) {
        below += value * weights[*row];
        few += weights[*row];
        let between = below * below / few + (all - below) * (all - below) / (whole - few);
        if between > best.0 {
            best = (between, number + 1);
        }
    }
    let mut is_other = vec![false; rows];
    at[best.1..].iter().for_each(|(_, row)| is_other[*row] = true);
    Some(is_other)
}

/// Whether labels tell the kinds: of the smaller kind fewer than a tenth stand with the wrong label.
fn tells(labels: &[usize], is_other: &[bool], few: usize) -> bool {
    let most = labels.iter().copied().max().unwrap_or(0);
    let wrong: usize = (0..=most)
        .map(|label| {
            let own = || labels.iter().zip(is_other).filter(|(other, _)| **other == label);
            let others = own().filter(|(_, other)| **other).count();
            others.min(own().count() - others)
        })
        .sum();
    10 * wrong < few
}
