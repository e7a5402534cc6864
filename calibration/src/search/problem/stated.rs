//! What is stated beside the data: of stations, each number an observation of its own, and of how large coefficients are expected.

use faer::{Mat, MatRef};

use super::Problem;
use crate::search::folds::Folds;
use observe::unknowns::OfStation;

/// Whitened rows and their folds with what is stated of stations behind them, each number a row; those of several stations are held out
/// station by station.
pub(crate) fn with_stated(mut rows: Mat<f64>, folds: Folds, stated: &[OfStation]) -> (Mat<f64>, Folds) {
    let (count, width) = rows.shape();
    rows.resize_with(count + stated.len(), width, |_, _| 0.0);
    for (row, own) in (count..).zip(stated) {
        rows[(row, own.at)] = 1.0 / own.sigma;
        rows[(row, width - 1)] = own.away / own.sigma;
    }
    let several = stated.iter().any(|own| own.station != stated[0].station);
    let units: Vec<Option<u32>> = stated.iter().map(|own| several.then_some(own.station)).collect();
    (rows, folds.with_stated(&units))
}

impl Problem {
    /// The same with rows that state something of the declared columns' coefficients alone, and their residual, and with the size that each
    /// candidate's coefficient is expected to have at most; they belong to no fold. Without sizes a fold that hardly sees a candidate
    /// would take it for anything.
    #[must_use]
    pub fn with_prior(self, stated: MatRef<'_, f64>, residual: &[f64], sizes: &[f64]) -> Self {
        let (u, k) = (self.declared, self.rows.ncols() - self.declared - 1);
        let of_basis = stated * &self.right;
        let taken = &of_basis * &self.absorbed;
        let rows = Mat::from_fn(stated.nrows(), u + k + 1, |i, j| match j.checked_sub(u) {
            None => of_basis[(i, j)],
            Some(at) if at == k => residual[i] - taken[(i, k)],
            Some(at) if self.lengths[at] > 0.0 => -taken[(i, at)] / self.lengths[at],
            Some(_) => 0.0,
        });
        let mut prior = rows.transpose() * &rows;
        self.prior.iter().for_each(|own| prior += own);
        for (at, size) in sizes.iter().enumerate().filter(|(at, _)| self.lengths[*at] > 0.0) {
            prior[(u + at, u + at)] += (size * self.lengths[at]).powi(-2);
        }
        Self { prior: Some(prior), ..self }
    }

    /// The Gram matrix of what lies in no fold, if anything does.
    #[must_use]
    pub fn prior(&self) -> Option<MatRef<'_, f64>> {
        self.prior.as_ref().map(Mat::as_ref)
    }

    /// How many rows, the last, state something by themselves.
    #[must_use]
    pub fn stated(&self) -> usize {
        self.folds.stated
    }

    /// The first row that states something by itself; the number of rows where none does.
    #[must_use]
    pub fn first_stated(&self) -> usize {
        self.rows.nrows() - self.stated()
    }

    /// Rows that lie in no fold: some of those that state something.
    pub(super) fn in_none(&self) -> Vec<usize> {
        let stated = self.first_stated()..self.rows.nrows();
        stated.filter(|&row| self.fold_of_row(row) == self.folds()).collect()
    }
}
