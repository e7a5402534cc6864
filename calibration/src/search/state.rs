//! The regression that a search stands at: which columns are in, and what they leave.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::confounded::{SetColumns, SetId};
use super::likelihood::Likelihood;
use super::problem::Problem;
use super::sweep::Sweep;

/// A regression on the declared columns and some sets, over some folds.
#[derive(Debug, Clone)]
pub struct State {
    /// The Gram matrix, swept.
    pub sweep: Sweep,
    /// The columns swept, declared ones first.
    pub base: Vec<usize>,
    /// Rows it stands on.
    pub rows: usize,
    residual: usize,
}

impl State {
    /// The declared columns alone, over the folds chosen.
    #[must_use]
    pub fn declared(problem: &Problem, chosen: impl Fn(usize) -> bool) -> Self {
        let (gram, rows) = problem.gram(chosen);
        let mut state =
            Self { sweep: Sweep::new(gram), base: Vec::new(), rows, residual: problem.residual() };
        for column in 0..problem.declared() {
            state.add_column(column);
        }
        state
    }

    fn add_column(&mut self, column: usize) {
        if self.sweep.add(column) {
            self.base.push(column);
        }
    }

    /// Adds a block of columns.
    pub fn add(&mut self, block: &[usize]) {
        block.iter().for_each(|&column| self.add_column(column));
    }

    /// Takes a block out.
    pub fn remove(&mut self, block: &[usize]) {
        block.iter().for_each(|&column| self.sweep.remove(column));
        self.base.retain(|column| !block.contains(column));
    }

    /// Takes out one of the sets that are in; columns that the others share with it stay with them.
    pub fn remove_among(&mut self, set: SetId, all: impl IntoIterator<Item = SetId>, blocks: &SetColumns) {
        self.remove(&blocks[set]);
        all.into_iter().filter(|&other| other != set).for_each(|other| self.add(&blocks[other]));
    }

    /// The residual's sum of squares.
    #[must_use]
    pub fn rss(&self) -> f64 {
        self.sweep.entry(self.residual, self.residual).max(f64::MIN_POSITIVE)
    }

    /// What a block would take off the sum of squares, and its rank here.
    #[must_use]
    pub fn gain(&self, block: &[usize]) -> (f64, usize) {
        self.sweep.gain(block, self.residual)
    }

    /// What a swept block takes off the sum of squares, and its rank, if no other block shares its columns.
    #[must_use]
    pub fn loss(&self, block: &[usize]) -> (f64, usize) {
        let inside: Vec<usize> = block.iter().copied().filter(|&c| self.sweep.contains(c)).collect();
        let k = inside.len();
        let inverse = Mat::from_fn(k, k, |i, j| -self.sweep.entry(inside[i], inside[j]));
        let b = Mat::from_fn(k, 1, |i, _| self.sweep.entry(inside[i], self.residual));
        let Ok(factor) = inverse.llt(faer::Side::Lower) else { return (0.0, 0) };
        let scaled = factor.solve(&b);
        ((0..k).map(|i| b[(i, 0)] * scaled[(i, 0)]).sum(), k)
    }

    /// How many standard deviations some of a problem's columns stand out beside the others that are in, where these of its rows, which state
    /// something, are not believed.
    #[must_use]
    pub fn standing_without(&self, problem: &Problem, own: &[usize], rows: &[usize]) -> f64 {
        let some = problem.rows_at(rows);
        let mut sweep = Sweep::new(problem.gram(|_| true).0 - some.transpose() * &some);
        for column in self.base.iter().filter(|column| !own.contains(column)) {
            sweep.add(*column);
        }
        let (gain, rank) = sweep.gain(own, self.residual);
        if rank == 0 { 0.0 } else { (gain * self.df() / self.rss() / rank as f64).sqrt() }
    }

    /// The swept columns with their coefficients.
    #[must_use]
    pub fn coefficients(&self) -> Vec<(usize, f64)> {
        self.base.iter().map(|&column| (column, self.sweep.entry(column, self.residual))).collect()
    }

    /// Degrees of freedom of the residual.
    #[must_use]
    pub fn df(&self) -> f64 {
        self.rows as f64 - self.base.len() as f64
    }

    /// How likely the data are after adding a block.
    #[must_use]
    pub fn likelihood(&self, gain: f64, rank: usize) -> Likelihood {
        let left = (self.rss() - gain).max(1e-12 * self.rss());
        Likelihood::of(left, self.rows, self.base.len() + rank)
    }

    /// Penalised log-likelihood (half a Schwarz criterion, up to a constant) after adding a block.
    #[must_use]
    pub fn criterion(&self, gain: f64, rank: usize) -> f64 {
        self.likelihood(gain, rank).penalised()
    }
}
