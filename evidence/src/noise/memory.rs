//! Memory: part of the noise is carried from row to row in the order of measuring.

/// Correlation (1 − part) I + part R of the rows, R = carried^distance, in each component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory {
    /// How much of one row's value the next one keeps.
    pub carried: f64,
    /// Part of the variance that has memory.
    pub part: f64,
}

/// The whitening of a memory as a recursion over the rows: the same for every column.
///
/// Source: Kalman (1960), A new approach to linear filtering and prediction problems: innovations of a first-order
/// process seen through white noise. It equals the tridiagonal form C⁻¹ = (part I + (1 − part) T)⁻¹ T, T = R⁻¹.
#[derive(Debug, Clone)]
pub(crate) struct Filter {
    carried: f64,
    gains: Vec<f64>,
    deviations: Vec<f64>,
}

impl Memory {
    /// The recursion for so many rows.
    pub(crate) fn filter(self, rows: usize) -> Filter {
        let (mut gains, mut deviations) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let mut variance = self.part;
        for _ in 0..rows {
            let seen = variance + 1.0 - self.part;
            let gain = variance / seen;
            gains.push(gain);
            deviations.push(seen.sqrt());
            let carried = self.carried * self.carried;
            variance = carried * variance * (1.0 - gain) + self.part * (1.0 - carried);
        }
        Filter { carried: self.carried, gains, deviations }
    }
}

impl Filter {
    /// Whitens rows from `from` on; the state is one number a component, zero before the first row.
    pub fn apply(&self, from: usize, column: &mut [f64], state: &mut [f64]) {
        let components = state.len();
        for (row, values) in (from..).zip(column.chunks_exact_mut(components)) {
            let (gain, deviation) = (self.gains[row], self.deviations[row]);
            for (value, state) in values.iter_mut().zip(state.iter_mut()) {
                let surprise = *value - *state;
                *state = self.carried * (*state + gain * surprise);
                *value = surprise / deviation;
            }
        }
    }

    /// The logarithm of the determinant of the correlation.
    pub fn log_det(&self) -> f64 {
        2.0 * self.deviations.iter().map(|deviation| deviation.ln()).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::algebra::{cholesky, dot, half_log_det, solve_lower};
    use faer::Mat;

    #[test]
    fn the_recursion_whitens_as_the_dense_correlation_does() {
        let (rows, memory) = (9, Memory { carried: 0.9, part: 0.7 });
        let dense = Mat::from_fn(rows, rows, |i, j| {
            memory.part * memory.carried.powi(i.abs_diff(j) as i32)
                + if i == j { 1.0 - memory.part } else { 0.0 }
        });
        let factor = cholesky(&dense).unwrap();
        let values: Vec<f64> = (0..rows).map(|row| (row as f64 * 1.7).sin()).collect();
        let mut right = Mat::from_fn(rows, 1, |row, _| values[row]);
        solve_lower(factor.as_ref(), right.as_mut());
        let filter = memory.filter(rows);
        // In two parts, as the blocks of a Gram matrix come.
        let (mut white, mut state) = (values, [0.0]);
        let (first, second) = white.split_at_mut(4);
        filter.apply(0, first, &mut state);
        filter.apply(4, second, &mut state);
        let expected: f64 = (0..rows).map(|row| right[(row, 0)] * right[(row, 0)]).sum();
        assert!((dot(&white, &white) - expected).abs() < 1e-12);
        assert!((filter.log_det() - 2.0 * half_log_det(&factor)).abs() < 1e-12);
    }
}
