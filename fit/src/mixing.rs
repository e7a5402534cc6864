//! Steps that come near slowly, taken together: where the next of them would lead, were they linear.
//!
//! Source: D. G. Anderson, Iterative procedures for nonlinear integral equations, Journal of the ACM 12 (1965) 547-560; as in
//! H. F. Walker, P. Ni, Anderson acceleration for fixed-point iterations, SIAM Journal on Numerical Analysis 49 (2011).

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Steps that are remembered.
const MEMORY: usize = 6;

/// What a difference of steps keeps of the squares of the sum of all, that the sums stay solvable.
const RIDGE: f64 = 1e-12;

/// The last points and where a plain step led from each.
#[derive(Debug, Clone, Default)]
pub(super) struct Mixing {
    /// The last point, where a plain step leads from it, and the step.
    last: Option<[Vec<f64>; 2]>,
    /// Differences of consecutive ends of plain steps, and of the steps.
    ends: Vec<Vec<f64>>,
    steps: Vec<Vec<f64>>,
}

impl Mixing {
    /// Where to go from a point from which a plain step leads to `plain`; none as long as nothing is known but this step.
    pub fn next(&mut self, point: &[f64], plain: &[f64]) -> Option<Vec<f64>> {
        let step = difference(plain, point);
        if let Some([end, before]) = self.last.take() {
            self.ends.push(difference(plain, &end));
            self.steps.push(difference(&step, &before));
            if self.ends.len() > MEMORY {
                self.ends.remove(0);
                self.steps.remove(0);
            }
        }
        let mixed = self.mixed(plain, &step);
        self.last = Some([plain.to_vec(), step]);
        mixed
    }

    fn mixed(&self, plain: &[f64], step: &[f64]) -> Option<Vec<f64>> {
        let count = self.steps.len();
        if count == 0 {
            return None;
        }
        let mut gram = Mat::from_fn(count, count, |i, j| product(&self.steps[i], &self.steps[j]));
        let trace: f64 = (0..count).map(|i| gram[(i, i)]).sum();
        (0..count).for_each(|i| gram[(i, i)] += RIDGE * trace);
        let right = Mat::from_fn(count, 1, |i, _| product(&self.steps[i], step));
        let shares = gram.llt(faer::Side::Lower).ok()?.solve(&right);
        let mut mixed = plain.to_vec();
        for (i, ends) in self.ends.iter().enumerate() {
            mixed.iter_mut().zip(ends).for_each(|(value, end)| *value -= shares[(i, 0)] * end);
        }
        mixed.iter().all(|value| value.is_finite()).then_some(mixed)
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Plain steps that shrink by a twentieth, a tenth and a third a time are there after a few.
    #[test]
    fn slow_steps_are_taken_together() {
        let (there, shares) = ([1.0, -2.0, 0.5], [0.95, 0.9, 0.67]);
        let mut point = vec![0.0; 3];
        let mut mixing = Mixing::default();
        for _ in 0..6 {
            let plain: Vec<f64> = (0..3).map(|i| there[i] + shares[i] * (point[i] - there[i])).collect();
            point = mixing.next(&point, &plain).unwrap_or(plain);
        }
        let off = point.iter().zip(there).map(|(value, there)| (value - there).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{point:?}");
    }
}
