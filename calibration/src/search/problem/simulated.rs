//! The same columns with other residuals: what simulations search again and again.

use std::sync::Arc;

use faer::Mat;

use super::{Problem, ProblemError, check_finite};

impl Problem {
    /// What the declared columns leave of a column of whitened components, and what they take of it.
    fn split(&self, column: &[f64]) -> (Mat<f64>, Mat<f64>) {
        let basis = self.rows.subcols(0, self.declared);
        let mut left = Mat::from_fn(self.rows.nrows(), 1, |i, _| column.get(i).copied().unwrap_or(0.0));
        let mut taken = Mat::zeros(self.declared, 1);
        for _ in 0..2 {
            let share = basis.transpose() * &left;
            left -= basis * &share;
            taken += share;
        }
        (left, taken)
    }

    /// What the declared columns leave of a column of whitened components.
    #[must_use]
    pub fn project(&self, column: &[f64]) -> Vec<f64> {
        self.split(column).0.col_as_slice(0).to_vec()
    }

    /// The same columns with another residual: what simulations search again and again, where nothing is stated of coefficients.
    ///
    /// # Errors
    /// A residual of another length, or one that is not finite.
    pub fn with_residual(&self, residual: &[f64]) -> Result<Self, ProblemError> {
        let (found, expected) = (residual.len(), self.rows.nrows());
        if found != expected {
            return Err(ProblemError::Rows { what: "the new residual", found, expected });
        }
        check_finite("the residual", faer::ColRef::from_slice(residual).as_mat())?;
        let (left, taken) = self.split(residual);
        let last = self.residual();
        debug_assert!(self.prior.is_none(), "what is stated has a residual of its own");
        let mut problem = self.clone();
        let rows = Arc::make_mut(&mut problem.rows);
        rows.col_mut(last).copy_from(left.col(0));
        problem.absorbed.col_mut(last - self.declared).copy_from(taken.col(0));
        for j in 0..=last {
            let mut products = vec![0.0; problem.grams.len()];
            let (column, residual) = (problem.rows.col_as_slice(j), left.col_as_slice(0));
            for (row, (z, r)) in column.iter().zip(residual).enumerate() {
                products[self.fold_of_row(row)] += z * r;
            }
            for (gram, product) in problem.grams.iter_mut().zip(products) {
                gram[(j, last)] = product;
                gram[(last, j)] = product;
            }
        }
        Ok(problem)
    }
}
