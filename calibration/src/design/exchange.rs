//! Choosing among poses one by one, and exchanging them: what every design does with the rows of its candidates.

use nalgebra::{DMatrix, Matrix3};

/// Against the worst of all, how much less a better determined combination counts: the power of its variance.
const WORST_FIRST: i32 = 3;

/// What is made small.
pub(super) enum Aim {
    /// The volume of the region of uncertainty.
    Volume,
    /// The sum of the variances.
    Sum,
    /// The largest variance of some combinations, one a column, each in units of what is wanted of it.
    Largest(DMatrix<f64>),
}

/// Among which rows is chosen, and for what.
pub(super) struct Rule<'a> {
    /// The rows of each candidate, in units of the noise.
    pub rows: &'a [DMatrix<f64>],
    /// What is made small.
    pub aim: &'a Aim,
    /// One candidate is chosen so often at most.
    pub often: usize,
}

/// Candidates that were chosen, and what is known with them.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    /// Their numbers, in the order in which they were chosen.
    pub chosen: Vec<usize>,
    /// The covariance with them.
    pub covariance: DMatrix<f64>,
}

impl Choice {
    /// None yet.
    pub fn new(before: DMatrix<f64>) -> Self {
        Self { chosen: Vec::new(), covariance: before }
    }

    /// Chooses one by one until there are so many; fewer where no more can be chosen.
    pub fn grow(&mut self, rule: &Rule<'_>, count: usize) {
        while self.chosen.len() < count {
            let Some(best) = best(rule, &self.covariance, &self.chosen) else { break };
            self.covariance = with(&self.covariance, &rule.rows[best], 1.0);
            self.chosen.push(best);
        }
    }

    /// Exchanges each for the best in its place; whether anything changed.
    pub fn exchange(&mut self, rule: &Rule<'_>) -> bool {
        let mut exchanged = false;
        for slot in 0..self.chosen.len() {
            let without = with(&self.covariance, &rule.rows[self.chosen[slot]], -1.0);
            let chosen = self.chosen.iter().enumerate();
            let others: Vec<usize> =
                chosen.filter(|(other, _)| *other != slot).map(|(_, row)| *row).collect();
            let Some(best) = best(rule, &without, &others) else { continue };
            exchanged |= best != self.chosen[slot];
            self.chosen[slot] = best;
            self.covariance = with(&without, &rule.rows[best], 1.0);
        }
        exchanged
    }
}

/// The candidate that gains most, of those that were not chosen too often.
fn best(rule: &Rule<'_>, covariance: &DMatrix<f64>, chosen: &[usize]) -> Option<usize> {
    let combinations = match rule.aim {
        Aim::Largest(combinations) => Some(weighted(covariance, combinations)),
        Aim::Volume | Aim::Sum => None,
    };
    let gain = |row: &DMatrix<f64>| {
        let spread = row * covariance;
        let own = small(&(&spread * row.transpose()));
        let seen = match (&combinations, rule.aim) {
            (_, Aim::Volume) => return own.determinant(),
            (Some(combinations), _) => row * combinations,
            (None, _) => spread,
        };
        let m = row.nrows();
        let gain =
            |inverse: Matrix3<f64>| (inverse.view((0, 0), (m, m)) * (&seen * seen.transpose())).trace();
        // A pose at which nothing can be computed is no candidate.
        own.try_inverse().map_or(f64::NAN, gain)
    };
    let may_come = |at: usize| chosen.iter().filter(|&&row| row == at).count() < rule.often;
    let gains = rule.rows.iter().enumerate().filter(|(at, _)| may_come(*at)).map(|(at, row)| (at, gain(row)));
    gains.filter(|(_, gain)| gain.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
}

/// The covariance with each combination, one a column, the worst determined ones counting most.
fn weighted(covariance: &DMatrix<f64>, combinations: &DMatrix<f64>) -> DMatrix<f64> {
    let mut through = covariance * combinations;
    let variances: Vec<f64> = (0..combinations.ncols())
        .map(|at| combinations.column(at).dot(&through.column(at)).max(0.0))
        .collect();
    let most = variances.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    for (at, variance) in variances.iter().enumerate() {
        // The gain is of the square.
        through.column_mut(at).scale_mut((variance / most).powi(WORST_FIRST).sqrt());
    }
    through
}

/// 1 + M as a 3 × 3 matrix, whatever the number of components.
fn small(matrix: &DMatrix<f64>) -> Matrix3<f64> {
    let mut small = Matrix3::identity();
    for row in 0..matrix.nrows().min(3) {
        for column in 0..matrix.ncols().min(3) {
            small[(row, column)] += matrix[(row, column)];
        }
    }
    small
}

/// The covariance with a pose's rows added (sign 1) or taken out (sign −1).
fn with(covariance: &DMatrix<f64>, row: &DMatrix<f64>, sign: f64) -> DMatrix<f64> {
    let spread = row * covariance;
    let own = small(&(&spread * row.transpose() * sign));
    let m = row.nrows();
    match own.try_inverse() {
        Some(inverse) => covariance - spread.transpose() * inverse.view((0, 0), (m, m)) * spread * sign,
        None => covariance.clone(),
    }
}
