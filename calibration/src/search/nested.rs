//! Nested cross-validation: the whole search repeated without each fold, and judged on that fold.

use rayon::prelude::*;

use super::classes::Class;
use super::problem::Problem;
use super::select::{Options, class_columns, held_out_rss, select};

/// What the searches without each fold found, and what they left in it.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// Classes accepted without each fold.
    pub chosen: Vec<Vec<usize>>,
    /// Whitened sum of squares in the held-out folds, declared columns alone.
    pub before: f64,
    /// The same with the effects that each search found.
    pub after: f64,
}

impl HeldOut {
    /// In what share of the folds a class was chosen.
    #[must_use]
    pub fn share(&self, class: usize) -> f64 {
        let times = self.chosen.iter().filter(|chosen| chosen.contains(&class)).count();
        times as f64 / self.chosen.len().max(1) as f64
    }
}

/// Repeats the search without each fold.
#[must_use]
pub fn nested(problem: &Problem, classes: &[Class], options: &Options) -> HeldOut {
    let blocks = class_columns(problem, classes);
    let residual = problem.residual();
    let folds: Vec<(Vec<usize>, f64, f64)> = (0..problem.folds())
        .into_par_iter()
        .map(|fold| {
            let selection = select(problem, classes, &[], |f| f != fold, options);
            let chosen: Vec<usize> = selection.accepted.iter().map(|a| a.class).collect();
            let left = |effects: &[usize]| {
                let mut columns: Vec<usize> = (0..problem.declared()).collect();
                columns.extend(effects.iter().flat_map(|&class| &blocks[class]));
                columns.push(residual);
                let pick = |gram: faer::MatRef<'_, f64>| {
                    faer::Mat::from_fn(columns.len(), columns.len(), |i, j| gram[(columns[i], columns[j])])
                };
                let (total, _) = problem.gram(|_| true);
                held_out_rss(&pick(total.as_ref()), &pick(problem.fold_gram(fold)))
            };
            let (before, after) = (left(&[]), left(&chosen));
            (chosen, before, after)
        })
        .collect();
    HeldOut {
        before: folds.iter().map(|fold| fold.1).sum(),
        after: folds.iter().map(|fold| fold.2).sum(),
        chosen: folds.into_iter().map(|fold| fold.0).collect(),
    }
}
