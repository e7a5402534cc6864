//! The normal equations of one step: the data along the determined combinations, and a weak prior along the rest.
//!
//! What the data do not determine has a normal prior of its size about where it starts. Where products of errors let it move
//! the prediction, it moves as far as they ask for within that size, and what stays open enters the uncertainties.

use faer::Mat;

use super::partial::Partial;
use super::subspace::Subspace;

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

/// What becomes of the combinations that the data do not determine.
#[derive(Debug, Clone, PartialEq)]
pub enum Rest {
    /// They stay where they are.
    Still,
    /// They have their prior; they are so far from its mean, in units of their sizes, length p − rank.
    Prior(Vec<f64>),
}

impl Rest {
    /// What the prior adds to the objective.
    #[must_use]
    pub fn objective(&self) -> f64 {
        match self {
            Self::Still => 0.0,
            Self::Prior(strain) => strain.iter().map(|strain| strain * strain).sum(),
        }
    }
}

impl Subspace {
    /// The step δ that minimises |r − J δ|² + |strain|² + damping · s² |δ|², s the largest singular value and |δ| in units of
    /// the sizes.
    #[must_use]
    pub fn step(&self, partial: &Partial, damping: f64, rest: &Rest) -> Step {
        let p = self.parameters();
        let (matrix, right) = self.stacked(partial, rest);
        let Ok(svd) = matrix.thin_svd() else {
            return Step { change: vec![0.0; p], length: 0.0 };
        };
        let s = svd.S().column_vector();
        let along = svd.U().transpose() * &right;
        let floor = if s.nrows() > 0 { damping * s[0] * s[0] } else { 0.0 };
        let mut length = 0.0;
        let coordinates = Mat::from_fn(s.nrows(), 1, |at, _| {
            let moved = s[at] * s[at] / (s[at] * s[at] + floor) * along[(at, 0)];
            if s[at] > 0.0 {
                length += moved * moved;
                moved / s[at]
            } else {
                0.0
            }
        });
        let change = self.free(rest) * (svd.V() * coordinates);
        let change = (0..p).map(|at| change[(at, 0)] * self.size()[at]).collect();
        Step { change, length: length.sqrt() }
    }

    /// A matrix whose product with its own transpose is (JᵀJ)⁻¹, with the prior's part in the brackets, over what is free to
    /// move; SI, p rows.
    #[must_use]
    pub fn covariance_root(&self, partial: &Partial, rest: &Rest) -> Mat<f64> {
        let (matrix, _) = self.stacked(partial, rest);
        let free = self.free(rest);
        let Ok(svd) = matrix.thin_svd() else {
            return Mat::zeros(self.parameters(), free.ncols());
        };
        let s = svd.S().column_vector();
        let v = free * svd.V();
        Mat::from_fn(v.nrows(), v.ncols(), |row, column| {
            if s[column] > 0.0 { v[(row, column)] / s[column] * self.size()[row] } else { 0.0 }
        })
    }

    /// A matrix whose product with its own transpose is the precision of the prior, SI; p rows, no columns without a prior.
    #[must_use]
    pub(super) fn precision_root(&self, rest: &Rest) -> Mat<f64> {
        let others = if *rest == Rest::Still { 0 } else { self.rest().ncols() };
        Mat::from_fn(self.parameters(), others, |row, column| self.rest()[(row, column)] / self.size()[row])
    }

    /// How many independent numbers of the data the estimates use up: the rank, and what the prior leaves to the data.
    #[must_use]
    pub fn used(&self, partial: &Partial, rest: &Rest) -> f64 {
        let root = self.covariance_root(partial, rest);
        let by_prior = self.precision_root(rest).transpose() * &root;
        root.ncols() as f64 - by_prior.squared_norm_l2()
    }

    /// The combinations that may move, of parameters in units of their size: the determined ones, then the rest if it may.
    fn free(&self, rest: &Rest) -> Mat<f64> {
        let (basis, others) = (self.basis(), self.rest());
        let width = if *rest == Rest::Still { basis.ncols() } else { self.parameters() };
        Mat::from_fn(self.parameters(), width, |row, column| match column.checked_sub(basis.ncols()) {
            None => basis[(row, column)],
            Some(other) => others[(row, other)],
        })
    }

    /// The Jacobian's factor in the coordinates of what may move, above the prior's rows; and the residual.
    fn stacked(&self, partial: &Partial, rest: &Rest) -> (Mat<f64>, Mat<f64>) {
        let p = self.parameters();
        let factor = partial.factor();
        let jacobian = Mat::from_fn(p, p, |row, column| factor[(row, column)] * self.size()[column]);
        let data = jacobian * self.free(rest);
        let strain: &[f64] = match rest {
            Rest::Still => &[],
            Rest::Prior(strain) => strain,
        };
        let matrix = Mat::from_fn(p + strain.len(), data.ncols(), |row, column| match row.checked_sub(p) {
            None => data[(row, column)],
            Some(own) => f64::from(u8::from(column == self.rank() + own)),
        });
        let right = Mat::from_fn(p + strain.len(), 1, |row, _| match row.checked_sub(p) {
            None => factor[(row, p)],
            Some(own) => -strain[own],
        });
        (matrix, right)
    }
}
