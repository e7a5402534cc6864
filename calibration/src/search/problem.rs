//! The whitened linear problem of a search, projected on what the declaration cannot explain.
//!
//! Notation: J the whitened declared columns, Z_c those of candidate c, r the whitened residual. With U an
//! orthonormal basis of the range of J, the rows kept are `[U | Z̃ | r̃]`, where Z̃ = (I − UUᵀ)Z with columns
//! of length one: well scaled and, in its first block, orthonormal, so that Gram matrices of subsets of the rows
//! (training folds) can be formed by adding and subtracting without loss.

mod simulated;
mod stated;

use std::ops::Range;
use std::sync::Arc;

use faer::{Mat, MatRef};

use super::folds::Folds;
use super::products::{add_products, mirrored, picked, taken_out};
use super::reach::Reach;
use effects::candidate::EffectId;

pub(crate) use stated::with_stated;

/// Share of a column's sum of squares that must be left by those before it (the declared ones, for a candidate) for it to
/// count.
pub(super) const VISIBLE: f64 = 1e-4;

/// The same where a length says what it has to be at least: rounding alone is no share.
const ROUNDED: f64 = 1e-8;

/// Singular values of the scaled declared columns below this share of the largest count as zero.
const RANK: f64 = 1e-9;

/// Rows that are copied at a time.
const AT_ONCE: usize = 4096;

/// Why a problem cannot be set up.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProblemError {
    /// The parts do not have the same number of rows.
    #[error("{what} has {found} rows where the residual has {expected}")]
    Rows {
        /// Which part.
        what: &'static str,
        /// Its rows.
        found: usize,
        /// The residual's rows.
        expected: usize,
    },
    /// A value is not finite.
    #[error(
        "{what}: a value is not finite, in component {row} of the search; some row observes what the chain cannot point at; \
         look at labels, stations, units and signs"
    )]
    NotFinite {
        /// Which part.
        what: &'static str,
        /// The first such component, counted from 0.
        row: usize,
    },
    /// The declared columns have no singular value decomposition.
    #[error("the singular values of the declared columns could not be computed")]
    Singular,
}

/// A whitened problem, ready to be searched.
#[derive(Debug, Clone)]
pub struct Problem {
    /// `[U | Z̃ | r̃]`, one row for each whitened component of an observation; shared by the same problem in other folds.
    rows: Arc<Mat<f64>>,
    /// Columns of U.
    declared: usize,
    /// Columns of each candidate in `rows`.
    blocks: Vec<Range<usize>>,
    /// What the declared columns leave of each candidate's sum of squares, 0 to 1.
    visible: Vec<f64>,
    /// The length of each candidate column after projection, before it was scaled to one.
    lengths: Vec<f64>,
    folds: Folds,
    /// Gram matrix of the rows of each fold.
    grams: Vec<Mat<f64>>,
    /// T with U = J·T, p × u.
    right: Mat<f64>,
    /// What candidates do at the data's poses and further out, if somebody said so.
    reach: Option<Reach>,
    /// Gram matrix of rows that lie in no fold, and of what is stated of the declared errors: part of every set of folds; none where
    /// there is neither.
    prior: Option<Mat<f64>>,
    /// UᵀZ and Uᵀr, u × (K + 1): what the declared columns took of each candidate column and of the residual.
    absorbed: Mat<f64>,
}

impl Problem {
    /// Projects and scales.
    ///
    /// `declared` is n × p, `candidates` n × K with the columns of candidate c at `blocks[c]`, `residual` has n
    /// values that must not contain any candidate's share yet, and `groups` says which rows are not
    /// independent. Groups are dealt to `folds` folds at random (`seed`), evenly by rows.
    ///
    /// # Errors
    /// Where the row counts differ or a value is not finite.
    pub fn new(
        declared: MatRef<'_, f64>,
        candidates: MatRef<'_, f64>,
        blocks: &[Range<usize>],
        residual: &[f64],
        groups: &[u32],
        folds: usize,
        seed: u64,
    ) -> Result<Self, ProblemError> {
        let n = residual.len();
        for (what, found) in [
            ("the declared columns", declared.nrows()),
            ("the candidates", candidates.nrows()),
            ("the list of groups", groups.len()),
        ] {
            if found != n {
                return Err(ProblemError::Rows { what, found, expected: n });
            }
        }
        let (p, k) = (declared.ncols(), candidates.ncols());
        let mut rows = Mat::zeros(n, p + k + 1);
        rows.subcols_mut(0, p).copy_from(declared);
        rows.subcols_mut(p, k).copy_from(candidates);
        rows.col_as_slice_mut(p + k).copy_from_slice(residual);
        Self::of_rows(rows, p, blocks, &vec![0.0; k], Folds::deal(groups, folds, seed))
    }

    /// The same from one matrix `[J | Z | r]` with so many declared columns, which it makes its own, and from groups that are dealt
    /// already. A candidate's column of which less than its `least` is left, in whitened units for a coefficient of one, shows nothing.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn of_rows(
        mut rows: Mat<f64>,
        declared: usize,
        blocks: &[Range<usize>],
        least: &[f64],
        folds: Folds,
    ) -> Result<Self, ProblemError> {
        let (n, k) = (rows.nrows(), rows.ncols() - declared - 1);
        if folds.rows() != n {
            return Err(ProblemError::Rows { what: "the list of groups", found: folds.rows(), expected: n });
        }
        check_finite("the declared columns", rows.subcols(0, declared))?;
        check_finite("the candidates", rows.subcols(declared, k))?;
        check_finite("the residual", rows.subcols(declared + k, 1))?;

        let (basis, right) = range(rows.subcols(0, declared))?;
        let u = basis.ncols();
        if u < declared {
            let mut fewer = Mat::zeros(n, u + k + 1);
            fewer.subcols_mut(u, k + 1).copy_from(rows.subcols(declared, k + 1));
            rows = fewer;
        }
        rows.subcols_mut(0, u).copy_from(&basis);
        let before: Vec<f64> = (0..k).map(|j| rows.col(u + j).squared_norm_l2()).collect();
        let absorbed = taken_out(basis.as_ref(), rows.subcols_mut(u, k + 1));
        let after: Vec<f64> = (0..k).map(|j| rows.col(u + j).squared_norm_l2()).collect();
        let mut lengths = vec![0.0; k];
        for j in 0..k {
            let share = if least[j] > 0.0 { ROUNDED } else { VISIBLE };
            let seen = after[j] > (share * before[j]).max(least[j] * least[j]) && after[j] > 0.0;
            lengths[j] = if seen { after[j].sqrt() } else { 0.0 };
            let scale = if seen { 1.0 / lengths[j] } else { 0.0 };
            rows.col_as_slice_mut(u + j).iter_mut().for_each(|value| *value *= scale);
        }
        let visible = blocks
            .iter()
            .map(|block| {
                let total: f64 = before[block.clone()].iter().sum();
                let left: f64 = after[block.clone()].iter().sum();
                if total > 0.0 { left / total } else { 0.0 }
            })
            .collect();
        let blocks = blocks.iter().map(|block| block.start + u..block.end + u).collect();

        let mut problem = Self {
            rows: Arc::new(rows),
            declared: u,
            blocks,
            visible,
            lengths,
            folds,
            grams: Vec::new(),
            right,
            absorbed,
            reach: None,
            prior: None,
        };
        problem.form_grams();
        let in_none = problem.in_none();
        problem.prior = (!in_none.is_empty()).then(|| problem.gram_of(&in_none));
        Ok(problem)
    }

    /// The same with what its candidates do at the data's poses and further out.
    #[must_use]
    pub fn with_reach(self, reach: Reach) -> Self {
        Self { reach: Some(reach), ..self }
    }

    /// The same with its rows in other folds.
    #[must_use]
    pub fn with_folds(&self, folds: Folds) -> Self {
        let mut other = Self { folds, ..self.clone() };
        other.form_grams();
        other
    }

    /// What its candidates do at the data's poses and further out, if somebody said so.
    #[must_use]
    pub fn reach(&self) -> Option<&Reach> {
        self.reach.as_ref()
    }

    /// The Gram matrix of each fold's rows.
    fn form_grams(&mut self) {
        let of_fold = |fold| self.gram_of(&self.rows_of_folds(|other| other == fold));
        self.grams = parallel::each(self.folds(), of_fold);
    }

    /// The Gram matrix of some rows.
    fn gram_of(&self, members: &[usize]) -> Mat<f64> {
        let width = self.rows.ncols();
        let mut gram = Mat::zeros(width, width);
        // Of some rows at a time: those of a fold may be most of a matrix that is large.
        members.chunks(AT_ONCE).for_each(|some| add_products(gram.as_mut(), self.rows_at(some).as_ref()));
        mirrored(gram.as_mut());
        gram
    }

    /// The rows that lie in the folds chosen, in order.
    #[must_use]
    pub fn rows_of_folds(&self, chosen: impl Fn(usize) -> bool) -> Vec<usize> {
        (0..self.rows.nrows()).filter(|&row| chosen(self.fold_of_row(row))).collect()
    }

    /// The rows of each fold.
    #[must_use]
    pub fn rows_of_each_fold(&self) -> Vec<Vec<usize>> {
        (0..self.folds()).map(|fold| self.rows_of_folds(|other| other == fold)).collect()
    }

    /// A copy of some rows.
    #[must_use]
    pub fn rows_at(&self, members: &[usize]) -> Mat<f64> {
        picked((*self.rows).as_ref(), members)
    }

    /// The Gram matrix of the rows in the folds chosen and in none, and how many rows those are (or were, before they were merged).
    #[must_use]
    pub fn gram(&self, chosen: impl Fn(usize) -> bool) -> (Mat<f64>, usize) {
        let width = self.rows.ncols();
        let mut sum = Mat::zeros(width, width);
        let mut count = self.in_none().len();
        for (fold, gram) in self.grams.iter().enumerate().filter(|&(fold, _)| chosen(fold)) {
            sum += gram;
            count += self.folds.rows_of_fold[fold];
        }
        self.prior.iter().for_each(|prior| sum += prior);
        (sum, count)
    }

    /// The Gram matrix of one fold's rows.
    #[must_use]
    pub fn fold_gram(&self, fold: usize) -> MatRef<'_, f64> {
        self.grams[fold].as_ref()
    }

    /// How many folds there are.
    #[must_use]
    pub fn folds(&self) -> usize {
        self.folds.count()
    }

    /// The fold that a row lies in; the number of folds where it lies in none.
    #[must_use]
    pub fn fold_of_row(&self, row: usize) -> usize {
        self.folds.of_row(row)
    }

    /// Group of each row, numbered from 0.
    #[must_use]
    pub fn group_of_row(&self) -> &[u32] {
        &self.folds.group_of_row
    }

    /// How many groups there are.
    #[must_use]
    pub fn groups(&self) -> usize {
        self.folds.groups()
    }

    /// `[U | Z̃ | r̃]`.
    #[must_use]
    pub fn rows(&self) -> MatRef<'_, f64> {
        (*self.rows).as_ref()
    }

    /// Rank of the declared columns.
    #[must_use]
    pub fn declared(&self) -> usize {
        self.declared
    }

    /// The column that holds the residual.
    #[must_use]
    pub fn residual(&self) -> usize {
        self.rows.ncols() - 1
    }

    /// The candidates, as the catalogue numbers them.
    pub fn candidates(&self) -> impl ExactSizeIterator<Item = EffectId> + use<> {
        (0..self.blocks.len()).map(EffectId)
    }

    /// The columns of a candidate that the declared ones leave anything of.
    #[must_use]
    pub fn columns(&self, candidate: EffectId) -> Vec<usize> {
        self.blocks[candidate.0].clone().filter(|&j| self.lengths[j - self.declared] > 0.0).collect()
    }

    /// All columns of a candidate.
    #[must_use]
    pub fn block(&self, candidate: EffectId) -> Range<usize> {
        self.blocks[candidate.0].clone()
    }

    /// What the declared columns leave of a candidate's sum of squares, 0 (absorbed) to 1.
    #[must_use]
    pub fn visible(&self, candidate: EffectId) -> f64 {
        self.visible[candidate.0]
    }

    /// One candidate column or the residual (the last) in its own units: what is left of it, before whitening, after
    /// the declared columns took their (whitened) share. `declared` and `own` are the columns before whitening.
    #[must_use]
    pub fn before_whitening(&self, column: usize, declared: MatRef<'_, f64>, own: &[f64]) -> Vec<f64> {
        let at = column - self.declared;
        let share = self.share(column);
        let mut left = own.to_vec();
        for (j, share) in share.iter().enumerate() {
            left.iter_mut().zip(declared.col(j).iter()).for_each(|(l, d)| *l -= share * d);
        }
        if let Some(&length) = self.lengths.get(at).filter(|&&length| length > 0.0) {
            left.iter_mut().for_each(|l| *l /= length);
        }
        left
    }

    /// A column of the basis of the declared ones before whitening.
    #[must_use]
    pub fn basis_before_whitening(&self, column: usize, declared: MatRef<'_, f64>) -> Vec<f64> {
        let mut sum = vec![0.0; declared.nrows()];
        for j in 0..declared.ncols() {
            let t = self.right[(j, column)];
            sum.iter_mut().zip(declared.col(j).iter()).for_each(|(s, d)| *s += t * d);
        }
        sum
    }

    /// How a unit of a candidate's column (or of the residual, the last), left out, would move each declared
    /// parameter.
    #[must_use]
    pub fn share(&self, column: usize) -> Vec<f64> {
        let at = column - self.declared;
        (0..self.right.nrows())
            .map(|j| (0..self.declared).map(|u| self.right[(j, u)] * self.absorbed[(u, at)]).sum())
            .collect()
    }

    /// The length of a candidate's column after projection, in whitened units for a coefficient of one.
    #[must_use]
    pub fn length(&self, column: usize) -> f64 {
        self.lengths[column - self.declared]
    }
}

/// Checks that a matrix is finite throughout.
fn check_finite(what: &'static str, matrix: MatRef<'_, f64>) -> Result<(), ProblemError> {
    for j in 0..matrix.ncols() {
        if let Some(row) = (0..matrix.nrows()).find(|&i| !matrix[(i, j)].is_finite()) {
            return Err(ProblemError::NotFinite { what, row });
        }
    }
    Ok(())
}

/// An orthonormal basis U of the range of a matrix, its columns scaled to length one before rank is decided, and the T
/// with U = matrix · T.
fn range(matrix: MatRef<'_, f64>) -> Result<(Mat<f64>, Mat<f64>), ProblemError> {
    let kept: Vec<usize> = (0..matrix.ncols()).filter(|&j| matrix.col(j).squared_norm_l2() > 0.0).collect();
    if kept.is_empty() || matrix.nrows() == 0 {
        return Ok((Mat::zeros(matrix.nrows(), 0), Mat::zeros(matrix.ncols(), 0)));
    }
    let lengths: Vec<f64> = kept.iter().map(|&j| matrix.col(j).norm_l2()).collect();
    let scaled = Mat::from_fn(matrix.nrows(), kept.len(), |i, j| matrix[(i, kept[j])] / lengths[j]);
    let svd = scaled.thin_svd().map_err(|_| ProblemError::Singular)?;
    let singular = svd.S().column_vector();
    let rank = (0..singular.nrows()).filter(|&i| singular[i] > RANK * singular[0]).count();
    let mut right = Mat::zeros(matrix.ncols(), rank);
    for (i, &j) in kept.iter().enumerate() {
        for r in 0..rank {
            right[(j, r)] = svd.V()[(i, r)] / (singular[r] * lengths[i]);
        }
    }
    Ok((svd.U().subcols(0, rank).to_owned(), right))
}
