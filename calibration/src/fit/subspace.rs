//! The combinations of parameters that the data determine, and steps within them.

use faer::{Mat, MatRef};

use super::partial::Partial;

/// Below this share of the largest singular value (columns scaled to length one) a combination counts as not seen.
const UNSEEN: f64 = 1e-8;

/// A combination that only appears away from the starting point (by products of errors) must be seen this well.
const NEWLY_SEEN: f64 = 1e-3;

/// The combinations that the data determine.
#[derive(Debug, Clone)]
pub struct Subspace {
    /// Length of each column of the whitened Jacobian; 1 for columns of zeros.
    scale: Vec<f64>,
    /// Orthonormal combinations of the scaled parameters, p × rank.
    basis: Mat<f64>,
    /// The rest of that space, p × (p − rank).
    unseen: Mat<f64>,
}

/// A step, and how far it moves the prediction.
#[derive(Debug, Clone)]
pub struct Step {
    /// Change of each parameter, SI.
    pub change: Vec<f64>,
    /// Norm of the change of the whitened prediction if it is linear: the step in standard uncertainties.
    pub length: f64,
}

impl Step {
    /// The same step, longer or shorter.
    #[must_use]
    pub fn times(self, stride: f64) -> Self {
        let change = self.change.into_iter().map(|change| stride * change).collect();
        Self { change, length: stride * self.length }
    }
}

impl Subspace {
    /// What is seen at the point where the partial was accumulated.
    #[must_use]
    pub fn determined(partial: &Partial) -> Self {
        Self::seen_better_than(partial, UNSEEN)
    }

    /// This subspace, or a larger one if products of errors make more visible at the estimate.
    #[must_use]
    pub fn extended(self, partial: &Partial) -> Self {
        let at_estimate = Self::seen_better_than(partial, NEWLY_SEEN);
        if at_estimate.rank() > self.rank() { at_estimate } else { self }
    }

    fn seen_better_than(partial: &Partial, tolerance: f64) -> Self {
        let p = partial.parameters;
        let factor = partial.factor();
        let jacobian = factor.submatrix(0, 0, p, p);
        let scale: Vec<f64> = (0..p)
            .map(|column| jacobian.col(column).norm_l2())
            .map(|length| if length > 0.0 && length.is_finite() { length } else { 1.0 })
            .collect();
        let scaled = Mat::from_fn(p, p, |row, column| jacobian[(row, column)] / scale[column]);
        let Ok(svd) = scaled.svd() else {
            // Only numbers that are none do not factor: nothing is seen then.
            return Self { scale, basis: Mat::zeros(p, 0), unseen: Mat::identity(p, p) };
        };
        let values = svd.S().column_vector();
        let largest = if p > 0 { values[0] } else { 0.0 };
        let rank = (0..p).filter(|&at| values[at] > tolerance * largest && values[at] > 0.0).count();
        let v = svd.V();
        Self { scale, basis: v.subcols(0, rank).to_owned(), unseen: v.subcols(rank, p - rank).to_owned() }
    }

    /// The number of combinations that are determined.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.basis.ncols()
    }

    /// The covariance of estimates that were made as if the rows were independent, when they are not: A⁻¹ B A⁻¹ with
    /// A = JᵀJ and B = KᵀK, K the coloured Jacobian. p × p.
    #[must_use]
    pub fn sandwich(&self, partial: &Partial, coloured: &Partial) -> Mat<f64> {
        let p = partial.parameters;
        let factor = coloured.factor();
        let root = factor.submatrix(0, 0, p, p) * self.covariance(partial);
        root.transpose() * &root
    }

    /// The step that minimises |r − J δ|² + damping · s² |δ|², s the largest singular value.
    #[must_use]
    pub fn step(&self, partial: &Partial, damping: f64) -> Step {
        let p = partial.parameters;
        let factor = partial.factor();
        let reduced = self.reduced(&factor);
        let Ok(svd) = reduced.thin_svd() else {
            return Step { change: vec![0.0; p], length: 0.0 };
        };
        let s = svd.S().column_vector();
        let right = factor.col(p).subrows(0, p);
        let along = svd.U().transpose() * right;
        let floor = if self.rank() > 0 { damping * s[0] * s[0] } else { 0.0 };
        let mut length = 0.0;
        let coordinates = Mat::from_fn(self.rank(), 1, |at, _| {
            let moved = s[at] * s[at] / (s[at] * s[at] + floor) * along[at];
            if s[at] > 0.0 {
                length += moved * moved;
                moved / s[at]
            } else {
                0.0
            }
        });
        let change = &self.basis * (svd.V() * coordinates);
        let change = (0..p).map(|at| change[(at, 0)] / self.scale[at]).collect();
        Step { change, length: length.sqrt() }
    }

    /// (JᵀJ)⁻¹ over what is determined, in SI; nothing over the rest. p × p.
    #[must_use]
    pub fn covariance(&self, partial: &Partial) -> Mat<f64> {
        let p = partial.parameters;
        let Ok(svd) = self.reduced(&partial.factor()).thin_svd() else {
            return Mat::zeros(p, p);
        };
        let s = svd.S().column_vector();
        let v = &self.basis * svd.V();
        let root = Mat::from_fn(p, self.rank(), |row, column| {
            if s[column] > 0.0 { v[(row, column)] / s[column] / self.scale[row] } else { 0.0 }
        });
        &root * root.transpose()
    }

    /// The combinations that are not determined, in SI parameters, columns of length one. p × (p − rank).
    #[must_use]
    pub fn null_space(&self) -> Mat<f64> {
        let mut null = Mat::from_fn(self.scale.len(), self.unseen.ncols(), |row, column| {
            self.unseen[(row, column)] / self.scale[row]
        });
        for column in 0..null.ncols() {
            let length = null.col(column).norm_l2();
            if length > 0.0 {
                for row in 0..null.nrows() {
                    null[(row, column)] /= length;
                }
            }
        }
        null
    }

    /// Per parameter, whether it has no part in what is not determined.
    #[must_use]
    pub fn separable(&self) -> Vec<bool> {
        (0..self.scale.len())
            .map(|row| (0..self.unseen.ncols()).all(|column| self.unseen[(row, column)].abs() < 1e-6))
            .collect()
    }

    /// The Jacobian's factor in the coordinates of the subspace, p × rank.
    fn reduced(&self, factor: &Mat<f64>) -> Mat<f64> {
        let p = self.scale.len();
        let jacobian: MatRef<'_, f64> = factor.as_ref().submatrix(0, 0, p, p);
        let scaled = Mat::from_fn(p, p, |row, column| jacobian[(row, column)] / self.scale[column]);
        scaled * &self.basis
    }
}
