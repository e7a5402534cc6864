//! The sweep operator: regression on a Gram matrix, one column at a time, reversible.
//!
//! A Gram matrix of the columns `[declared | candidates | residual]` holds everything that a linear search
//! asks: after sweeping a set of columns the rest of the matrix is the Gram matrix of what those columns leave,
//! and the swept rows hold the regression coefficients. Sweeping a column again in reverse takes it out.
//!
//! Source: Goodnight, "A tutorial on the SWEEP operator", The American Statistician 33 (1979).

use faer::Mat;

/// What is left of a column of unit length below which it counts as explained by those swept before it.
const DEPENDENT: f64 = 1e-7;

/// A Gram matrix with some of its columns swept.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// It stays symmetric: the lower half alone is read and kept.
    matrix: Mat<f64>,
    /// The diagonal before any sweep: the scale that a pivot is judged by.
    scale: Vec<f64>,
    swept: Vec<bool>,
}

impl Sweep {
    /// Starts from a Gram matrix, of which the lower half is read.
    #[must_use]
    pub fn new(gram: Mat<f64>) -> Self {
        let scale: Vec<f64> = (0..gram.ncols()).map(|i| gram[(i, i)]).collect();
        Self::scaled(gram, scale)
    }

    /// Starts from what others have left of a Gram matrix, with the diagonal that it had before them.
    #[must_use]
    pub fn scaled(gram: Mat<f64>, scale: Vec<f64>) -> Self {
        let swept = vec![false; scale.len()];
        Self { matrix: gram, scale, swept }
    }

    /// Regresses everything on `column` as well. Returns false, and does nothing, where the columns swept before
    /// leave nothing of it.
    pub fn add(&mut self, column: usize) -> bool {
        if self.swept[column] || !self.has_pivot(column) {
            return false;
        }
        self.pivot(column, 1.0);
        self.swept[column] = true;
        true
    }

    /// Takes a column out of the regression again.
    pub fn remove(&mut self, column: usize) {
        if self.swept[column] {
            self.pivot(column, -1.0);
            self.swept[column] = false;
        }
    }

    fn has_pivot(&self, column: usize) -> bool {
        self.matrix[(column, column)] > DEPENDENT * self.scale[column].max(f64::MIN_POSITIVE)
    }

    fn pivot(&mut self, k: usize, sign: f64) {
        let d = self.matrix[(k, k)];
        let pivot: Vec<f64> = (0..self.scale.len()).map(|i| self.entry(i, k)).collect();
        for j in 0..pivot.len() {
            let factor = pivot[j] / d;
            if j == k || factor == 0.0 {
                continue;
            }
            for (target, &p) in self.matrix.col_as_slice_mut(j)[j..].iter_mut().zip(&pivot[j..]) {
                *target -= p * factor;
            }
        }
        for (i, &p) in pivot.iter().enumerate() {
            self.matrix[(i.max(k), i.min(k))] = if i == k { -1.0 / d } else { sign * p / d };
        }
    }

    /// Whether a column is in the regression.
    #[must_use]
    pub fn contains(&self, column: usize) -> bool {
        self.swept[column]
    }

    /// An entry: for two unswept columns, the inner product of what the swept ones leave of them; for a swept
    /// `i` and an unswept `j`, the coefficient of `i` in the regression of `j`; for two swept ones, minus the
    /// inverse of their Gram matrix.
    #[must_use]
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.matrix[(i.max(j), i.min(j))]
    }

    /// The drop in the residual's sum of squares from adding a block of columns, and the block's rank.
    #[must_use]
    pub fn gain(&self, block: &[usize], residual: usize) -> (f64, usize) {
        let k = block.len();
        if let &[column] = block {
            if self.swept[column] || !self.has_pivot(column) {
                return (0.0, 0);
            }
            let score = self.entry(column, residual);
            return (score * score / self.matrix[(column, column)], 1);
        }
        let whitener = self.whitener(block);
        let gain = (0..whitener.ncols())
            .map(|c| {
                let score: f64 = (0..k).map(|i| whitener[(i, c)] * self.entry(block[i], residual)).sum();
                score * score
            })
            .sum();
        (gain, whitener.ncols())
    }

    /// The k × rank matrix T that makes what is left of a block of columns orthonormal: TᵀGT = I.
    #[must_use]
    pub fn whitener(&self, block: &[usize]) -> Mat<f64> {
        let k = block.len();
        let product = |a: &[f64], b: &[f64]| -> f64 {
            (0..k)
                .flat_map(|i| (0..k).map(move |j| (i, j)))
                .map(|(i, j)| a[i] * b[j] * self.entry(block[i], block[j]))
                .sum()
        };
        let mut found: Vec<Vec<f64>> = Vec::new();
        for (i, &column) in block.iter().enumerate().filter(|&(_, &column)| !self.swept[column]) {
            let mut vector = vec![0.0; k];
            vector[i] = 1.0;
            for _ in 0..2 {
                for known in &found {
                    let part = product(&vector, known);
                    vector.iter_mut().zip(known).for_each(|(v, &u)| *v -= part * u);
                }
            }
            let left = product(&vector, &vector);
            if left > DEPENDENT * self.scale[column].max(f64::MIN_POSITIVE) {
                vector.iter_mut().for_each(|v| *v /= left.sqrt());
                found.push(vector);
            }
        }
        Mat::from_fn(k, found.len(), |i, c| found[c][i])
    }
}
