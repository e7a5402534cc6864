//! A contest of what was found against what no search looks for: something that is no error of the instrument.

use faer::Mat;

use crate::search::contest::{Price, contender, criterion, predicts};
use crate::search::context::Context;
use crate::search::round::Round;
use crate::search::scan::Left;
use crate::search::signs::Signs;

/// Penalised log-likelihood by which a rival must beat what was found.
const BETTER: f64 = 3.0;

/// The rival that explains the data best, where it does so better than what was found.
pub(super) struct Winner {
    /// Which it is.
    pub rival: usize,
    /// Coefficients of its columns.
    pub coefficients: Vec<f64>,
    /// The names of the effects that were accepted and would not be.
    pub instead_of: Vec<String>,
}

/// Of rivals, each some whitened columns, the one that wins; `None` where none does.
pub(super) fn contest(whole: &Context<'_>, last: &Round<'_>, rivals: &[Mat<f64>]) -> Option<Winner> {
    let problem = last.search.of_functions();
    let (shown, accepted): (Vec<usize>, Vec<Vec<usize>>) = last.shown_to_functions().into_iter().unzip();
    let signs = Signs::scattered(problem.group_of_row(), whole.options.flips, whole.options.seed);
    let left = Left::new(problem, &accepted, &signs);
    let price = |functions| Price { sets: last.sets.len(), functions, parameters: 0 };
    let fitted = rivals.iter().map(|columns| contender(&left, columns.as_ref(), price(rivals.len())));
    let (rival, best) = fitted.enumerate().max_by(|a, b| a.1.criterion.total_cmp(&b.1.criterion))?;
    let wins = best.criterion > criterion(&left, price(1)) + BETTER
        && predicts(&left, rivals[rival].as_ref(), &best.kept, &problem.rows_of_each_fold());
    let replaced = (0..accepted.len()).filter(|at| !best.kept.contains(at));
    let name = |at: usize| whole.catalogue[last.fitted.found[shown[at]].effect].name.clone();
    wins.then(|| Winner { rival, instead_of: replaced.map(name).collect(), coefficients: best.coefficients })
}
