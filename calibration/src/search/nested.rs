//! Nested cross-validation: the whole search repeated without each fold, and judged on that fold.

use super::confounded::SetId;
use super::problem::Problem;
use super::state::State;

/// What the searches without each fold found, and the regressions that predict it.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// Confounded sets accepted without each fold.
    pub chosen: Vec<Vec<SetId>>,
    /// Per fold the coefficients, fitted without it, of the declared columns alone: column and value.
    pub before: Vec<Vec<(usize, f64)>>,
    /// The same with the effects that its search found.
    pub after: Vec<Vec<(usize, f64)>>,
}

impl HeldOut {
    /// What no search was made for: the declared columns alone, before and after.
    #[must_use]
    pub fn of_declared(problem: &Problem) -> Self {
        let before = without_each(problem, &[]);
        Self { chosen: vec![Vec::new(); before.len()], after: before.clone(), before }
    }

    /// What no search was repeated for: the declared columns alone, and with these of the candidates, which were chosen before.
    #[must_use]
    pub fn of_columns(problem: &Problem, columns: &[usize]) -> Self {
        Self { after: without_each(problem, columns), ..Self::of_declared(problem) }
    }

    /// In what share of the folds a set was chosen.
    #[must_use]
    pub fn share(&self, set: SetId) -> f64 {
        let times = self.chosen.iter().filter(|chosen| chosen.contains(&set)).count();
        times as f64 / self.chosen.len().max(1) as f64
    }

    /// Whitened sum of squares in the held-out folds, by the declared columns alone and with effects.
    #[must_use]
    pub fn sums_of_squares(&self, problem: &Problem) -> (f64, f64) {
        let sum = |coefficients: &[Vec<(usize, f64)>]| {
            coefficients.iter().enumerate().map(|(fold, b)| left(problem, fold, b)).sum()
        };
        (sum(&self.before), sum(&self.after))
    }
}

/// Per fold the coefficients, fitted without it, of the declared columns and of these candidates.
fn without_each(problem: &Problem, columns: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let of_fold = |fold: usize| {
        let mut state = State::declared(problem, |f| f != fold);
        state.add(columns);
        state.coefficients()
    };
    parallel::each(problem.folds(), of_fold)
}

/// The sum of squares that coefficients leave in a fold.
fn left(problem: &Problem, fold: usize, coefficients: &[(usize, f64)]) -> f64 {
    let (gram, last) = (problem.fold_gram(fold), problem.residual());
    let mut rss = gram[(last, last)];
    for &(i, b) in coefficients {
        rss -= 2.0 * b * gram[(i, last)];
        rss += coefficients.iter().map(|&(j, c)| b * c * gram[(i, j)]).sum::<f64>();
    }
    rss
}

/// Repeats the search without each fold: `without` gives what is accepted without one, and the regression with it.
#[must_use]
pub fn nested(problem: &Problem, without: impl Fn(usize) -> (Vec<SetId>, State) + Sync) -> HeldOut {
    let folds: Vec<(Vec<SetId>, State, State)> = parallel::each(problem.folds(), |fold| {
        let (chosen, state) = without(fold);
        (chosen, State::declared(problem, |f| f != fold), state)
    });
    HeldOut {
        before: folds.iter().map(|fold| fold.1.coefficients()).collect(),
        after: folds.iter().map(|fold| fold.2.coefficients()).collect(),
        chosen: folds.into_iter().map(|fold| fold.0).collect(),
    }
}
