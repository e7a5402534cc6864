//! Objects that are stated to within a standard uncertainty, in whole columns.
//!
//! Such an object explains of its rows no more than its uncertainty lets it. Its rows are whitened by that as well, about where it
//! is stated: W = (I + A·Aᵀ)^(−1/2), where A holds its whitened columns for one standard uncertainty. An object that is surely known
//! takes nothing out, and one that is hardly known nearly as much as an unknown one.

use faer::Mat;

use super::lanes::{add, dot};

/// One such object's rows.
#[derive(Debug, Clone)]
pub(super) struct Within {
    /// The object's components.
    at: Vec<usize>,
    /// Derivatives by the object's numbers before whitening.
    columns: Mat<f64>,
    /// Orthonormal whitened columns that span what the object moves.
    units: Vec<Vec<f64>>,
    /// What is left of each of them.
    left: Vec<f64>,
    /// What the share of each of them in a whitened column changes of the object's numbers, m.
    change_m: Mat<f64>,
}

impl Within {
    /// Of components with their derivatives by the object's numbers and what whitening multiplies them by; none where numbers
    /// that are no numbers do not factor.
    pub fn new(at: Vec<usize>, columns: Mat<f64>, scale: &[f64], sigma_m: f64) -> Option<Self> {
        let whitened =
            Mat::from_fn(at.len(), columns.ncols(), |i, j| columns[(i, j)] * scale[at[i]] * sigma_m);
        let svd = whitened.thin_svd().ok()?;
        let values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
        let units = (0..values.len()).map(|k| svd.U().col(k).iter().copied().collect());
        let left = values.iter().map(|d| (1.0 + d * d).sqrt().recip());
        let change_m = Mat::from_fn(columns.ncols(), values.len(), |j, k| {
            let d = values[k];
            sigma_m * svd.V()[(j, k)] * d / (1.0 + d * d)
        });
        Some(Self { at, units: units.collect(), left: left.collect(), change_m, columns })
    }

    /// Leaves of a whitened column what the object does not explain.
    pub fn reduce(&self, column: &mut [f64]) {
        let mut own: Vec<f64> = self.at.iter().map(|&at| column[at]).collect();
        for (unit, left) in self.units.iter().zip(&self.left) {
            let share = dot(unit, &own);
            add(&mut own, (left - 1.0) * share, unit);
        }
        self.at.iter().zip(&own).for_each(|(&at, value)| column[at] = *value);
    }

    /// Takes out of a column before whitening what the object, estimated from its own rows and where it is stated, explains of it.
    pub fn estimate_anew(&self, column: &mut [f64], scale: &[f64]) {
        let own: Vec<f64> = self.at.iter().map(|&at| column[at] * scale[at]).collect();
        let shares: Vec<f64> = self.units.iter().map(|unit| dot(unit, &own)).collect();
        let along = |j: usize| shares.iter().enumerate().map(|(k, s)| s * self.change_m[(j, k)]).sum::<f64>();
        let numbers: Vec<f64> = (0..self.columns.ncols()).map(along).collect();
        for (i, &at) in self.at.iter().enumerate() {
            column[at] -= numbers.iter().enumerate().map(|(j, b)| self.columns[(i, j)] * b).sum::<f64>();
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const SCALE: [f64; 4] = [1.0, 2.0, 0.5, 3.0];

    fn columns() -> Mat<f64> {
        Mat::from_fn(4, 2, |i, j| ((i * 7 + j * 5) as f64 * 0.9).sin())
    }

    fn whitened(column: usize) -> Vec<f64> {
        (0..4).map(|i| columns()[(i, column)] * SCALE[i]).collect()
    }

    /// Products of whitened columns are those of the inverse of I + s²·J·Jᵀ, which is 1 − J·(1/s² + JᵀJ)⁻¹·Jᵀ.
    #[test]
    fn rows_are_whitened_by_what_is_stated() {
        let sigma_m = 0.7;
        let own = Within::new(vec![0, 1, 2, 3], columns(), &SCALE, sigma_m).unwrap();
        let [a, b] = [0, 1].map(whitened);
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let given = [vec![0.3, -1.0, 2.0, 0.4], vec![1.0, 0.2, -0.5, 0.9]];
        let precision = sigma_m.powi(-2);
        let (aa, ab, bb) = (dot(&a, &a) + precision, dot(&a, &b), dot(&b, &b) + precision);
        let determinant = aa * bb - ab * ab;
        let product = |x: &[f64], y: &[f64]| {
            let ([xa, xb], [ya, yb]) = ([dot(x, &a), dot(x, &b)], [dot(y, &a), dot(y, &b)]);
            dot(x, y) - (bb * xa * ya - ab * (xa * yb + xb * ya) + aa * xb * yb) / determinant
        };
        let [mut x, mut y] = given.clone();
        own.reduce(&mut x);
        own.reduce(&mut y);
        assert_relative_eq!(dot(&x, &y), product(&given[0], &given[1]), epsilon = 1e-12);
        assert_relative_eq!(dot(&x, &x), product(&given[0], &given[0]), epsilon = 1e-12);
    }

    /// A surely known object follows nothing, and a hardly known one all that it can.
    #[test]
    fn an_object_follows_as_far_as_it_is_uncertain() {
        let moved: Vec<f64> = (0..4).map(|i| 2.0 * columns()[(i, 0)] - columns()[(i, 1)]).collect();
        for (sigma_m, followed) in [(1e-9, 0.0), (1e6, 1.0)] {
            let own = Within::new(vec![0, 1, 2, 3], columns(), &SCALE, sigma_m).unwrap();
            let mut left = moved.clone();
            own.estimate_anew(&mut left, &SCALE);
            for (left, moved) in left.iter().zip(&moved) {
                assert_relative_eq!(*left, (1.0 - followed) * moved, epsilon = 1e-9);
            }
        }
    }
}
