//! The combinations of parameters that the data determine, and steps within them.

use faer::{Mat, MatRef};

use super::partial::Partial;

/// Below this share of the largest singular value (columns scaled to length one) a combination counts as not seen.
const UNSEEN: f64 = 1e-8;

/// A combination that only appears away from the starting point (by products of errors) must be seen this well.
const NEWLY_SEEN: f64 = 1e-3;

/// And the data must ask for it: by how much the sum of squares, in variances, must become less, in all and for each
/// combination.
const ASKED_FOR: [f64; 2] = [16.0, 4.0];

/// A column this much shorter than the longest is zero but for rounding: a quarter turn's cosine, say.
const ROUNDING: f64 = 1e-14;

/// Below this share of its largest part, a part of an undetermined combination is rounding.
const NO_PART: f64 = 1e-6;

/// The combinations that the data determine.
#[derive(Debug, Clone)]
pub struct Subspace {
    /// Length of each column of the whitened Jacobian; 1 for columns of zeros.
    scale: Vec<f64>,
    /// Orthonormal combinations of the scaled parameters, p × rank.
    basis: Mat<f64>,
    /// The rest of that space in reduced echelon form, p × (p − rank).
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

    /// This subspace, or a larger one if products of errors make more visible at the estimate and the residual asks for
    /// it: where errors are small, what only their products show is not determined but by accident.
    #[must_use]
    pub fn extended(self, partial: &Partial) -> Self {
        let at_estimate = Self::seen_better_than(partial, NEWLY_SEEN);
        let more = at_estimate.rank().saturating_sub(self.rank());
        let gain = |subspace: &Self| subspace.step(partial, 0.0).length.powi(2);
        let [in_all, for_each] = ASKED_FOR;
        let asked_for = || gain(&at_estimate) - gain(&self) > in_all + for_each * more as f64;
        if more > 0 && asked_for() { at_estimate } else { self }
    }

    fn seen_better_than(partial: &Partial, tolerance: f64) -> Self {
        let p = partial.parameters;
        let factor = partial.factor();
        let lengths: Vec<f64> = (0..p).map(|column| partial.length(column)).collect();
        let longest = lengths.iter().copied().filter(|length| length.is_finite()).fold(0.0, f64::max);
        let visible = |length: f64| length > ROUNDING * longest && length.is_finite();
        let scale = lengths.iter().map(|&length| if visible(length) { length } else { 1.0 }).collect();
        let scaled = Mat::from_fn(p, p, |row, column| {
            if visible(lengths[column]) { factor[(row, column)] / lengths[column] } else { 0.0 }
        });
        let Ok(svd) = scaled.svd() else {
            // Only numbers that are none do not factor: nothing is seen then.
            return Self { scale, basis: Mat::zeros(p, 0), unseen: Mat::identity(p, p) };
        };
        let values = svd.S().column_vector();
        let largest = if p > 0 { values[0] } else { 0.0 };
        let rank = (0..p).filter(|&at| values[at] > tolerance * largest && values[at] > 0.0).count();
        let v = svd.V();
        let unseen = echelon(v.subcols(rank, p - rank).to_owned());
        Self { scale, basis: v.subcols(0, rank).to_owned(), unseen }
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
        let root = self.covariance_root(partial);
        &root * root.transpose()
    }

    /// A matrix whose product with its own transpose is the [covariance](Self::covariance), p × rank: J times it has
    /// orthonormal columns.
    #[must_use]
    pub fn covariance_root(&self, partial: &Partial) -> Mat<f64> {
        let p = partial.parameters;
        let Ok(svd) = self.reduced(&partial.factor()).thin_svd() else {
            return Mat::zeros(p, self.rank());
        };
        let s = svd.S().column_vector();
        let v = &self.basis * svd.V();
        Mat::from_fn(p, self.rank(), |row, column| {
            if s[column] > 0.0 { v[(row, column)] / s[column] / self.scale[row] } else { 0.0 }
        })
    }

    /// The combinations that are not determined, in SI parameters, columns of length one, each with as few parts as the
    /// others leave it. p × (p − rank).
    #[must_use]
    pub fn null_space(&self) -> Mat<f64> {
        let mut null = Mat::from_fn(self.scale.len(), self.unseen.ncols(), |row, column| {
            self.unseen[(row, column)] / self.scale[row]
        });
        for column in null.col_iter_mut() {
            let length = column.norm_l2();
            if length > 0.0 {
                column.iter_mut().for_each(|part| *part /= length);
            }
        }
        null
    }

    /// Per parameter, whether it has no part in what is not determined.
    #[must_use]
    pub fn separable(&self) -> Vec<bool> {
        self.unseen.row_iter().map(|row| row.iter().all(|&part| part == 0.0)).collect()
    }

    /// The parameters that undetermined combinations link, set by set in their order, each with the number of combinations
    /// of the set that are not determined. A parameter that moves nothing is a set of its own.
    #[must_use]
    pub fn linked(&self) -> Vec<(Vec<usize>, usize)> {
        let mut sets: Vec<(Vec<usize>, usize)> = Vec::new();
        for column in self.unseen.col_iter() {
            let parts: Vec<usize> = (0..column.nrows()).filter(|&row| column[row] != 0.0).collect();
            let apart = |set: &(Vec<usize>, usize)| set.0.iter().all(|member| !parts.contains(member));
            let (mut rest, joined): (Vec<_>, Vec<_>) = sets.into_iter().partition(apart);
            let count = 1 + joined.iter().map(|(_, count)| count).sum::<usize>();
            let mut members: Vec<usize> = joined.into_iter().flat_map(|set| set.0).chain(parts).collect();
            members.sort_unstable();
            members.dedup();
            rest.push((members, count));
            sets = rest;
        }
        sets.sort();
        sets
    }

    /// The Jacobian's factor in the coordinates of the subspace, p × rank.
    fn reduced(&self, factor: &Mat<f64>) -> Mat<f64> {
        let p = self.scale.len();
        let jacobian: MatRef<'_, f64> = factor.as_ref().submatrix(0, 0, p, p);
        let scaled = Mat::from_fn(p, p, |row, column| jacobian[(row, column)] / self.scale[column]);
        scaled * &self.basis
    }
}

/// The same column space in reduced echelon form: each column has a row, its largest part, in which the others are zero.
/// What is left in other rows are the parts that it cannot do without, so that parameters which nothing links share no
/// column, and one that moves nothing has a column to itself.
fn echelon(mut columns: Mat<f64>) -> Mat<f64> {
    let (rows, count) = columns.shape();
    let mut used = vec![false; rows];
    for done in 0..count {
        let free = (0..rows).filter(|&row| !used[row]).flat_map(|row| (done..count).map(move |at| (row, at)));
        let largest = free.max_by(|&a, &b| columns[a].abs().total_cmp(&columns[b].abs()));
        let Some((pivot, at)) = largest.filter(|&at| columns[at] != 0.0) else { break };
        used[pivot] = true;
        for row in 0..rows {
            let own = columns[(row, at)];
            columns[(row, at)] = columns[(row, done)];
            columns[(row, done)] = own;
        }
        let head = columns[(pivot, done)];
        for row in 0..rows {
            columns[(row, done)] /= head;
        }
        for other in (0..count).filter(|&other| other != done) {
            let share = columns[(pivot, other)];
            for row in 0..rows {
                columns[(row, other)] -= share * columns[(row, done)];
            }
            columns[(pivot, other)] = 0.0;
        }
    }
    for column in columns.col_iter_mut() {
        let largest = column.norm_max();
        column.iter_mut().filter(|part| part.abs() < NO_PART * largest).for_each(|part| *part = 0.0);
    }
    columns
}
