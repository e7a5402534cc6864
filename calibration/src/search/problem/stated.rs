//! What is stated beside the data: of stations, each number an observation of its own, and of how large coefficients are expected.

use faer::{Mat, MatRef};

use super::Problem;

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

    /// Rows that lie in no fold: some of those that state something.
    pub(super) fn in_none(&self) -> Vec<usize> {
        let rows = self.rows.nrows();
        (rows - self.stated()..rows).filter(|&row| self.fold_of_row(row) == self.folds()).collect()
    }
}
