//! How far the declared errors hang on which of several causes is the true one.
//!
//! Causes of one confounded set make the same correction only together with the declared errors: those differ by the cause
//! that is taken for the true one, often by much more than their uncertainties.

use faer::Mat;
use model_core::SymbolId;

use super::effects::Others;
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use crate::search::sweep::Sweep;
use effects::candidate::EffectId;

/// What the other causes of the accepted effects would make of the declared errors.
#[derive(Default)]
pub(super) struct ByCause {
    /// Of each accepted effect, for each of its other causes: how far each declared error would move, SI.
    moves: Vec<Vec<Vec<f64>>>,
    /// The declared errors, in the order of those.
    declared: Vec<SymbolId>,
}

impl ByCause {
    /// Of the accepted effects, each with what it could be instead.
    pub fn of(whole: &Context<'_>, last: &Round<'_>, others: &[Others]) -> Self {
        let (gram, _) = last.search.problem.gram(|_| true);
        let accepted = last.fitted.found.iter().zip(&last.fitted.errors).zip(others);
        let moves = accepted.map(|((found, errors), others)| {
            let values: Vec<f64> = errors.iter().map(|id| last.fitted.fit.values[id.index()]).collect();
            let instead = others.alike.iter().chain(others.competing.iter().flatten());
            instead.map(|&other| moved(last, &gram, (found.effect, &values), other)).collect()
        });
        Self { moves: moves.collect(), declared: declared(whole).to_vec() }
    }

    /// How far a combination of errors would move at most, down and up; `None` where that is within its standard uncertainty.
    pub fn range(&self, combination: &[(SymbolId, f64)], uncertainty: f64) -> Option<[f64; 2]> {
        let factor = |id: &SymbolId| combination.iter().filter(|(own, _)| own == id).map(|(_, by)| by).sum();
        let factors: Vec<f64> = self.declared.iter().map(factor).collect();
        let mut range = [0.0, 0.0];
        for causes in &self.moves {
            let of_cause = |moves: &Vec<f64>| moves.iter().zip(&factors).map(|(own, by)| own * by).sum();
            let all: Vec<f64> = causes.iter().map(of_cause).collect();
            range[0] += all.iter().copied().fold(0.0, f64::min);
            range[1] += all.iter().copied().fold(0.0, f64::max);
        }
        (range[1].max(-range[0]) > uncertainty).then_some(range)
    }
}

/// How far each declared error would move if `other` were true in place of an accepted effect with its coefficients.
///
/// What that effect leaves beside the declared errors, `Z̃ v`, is taken up by the other one and those accepted beside it, `Z̃ₒ m`;
/// what they absorb, J⁺Z v and J⁺Zₒ m, differs, and that is the move.
fn moved(
    last: &Round<'_>,
    gram: &Mat<f64>,
    (effect, values): (EffectId, &[f64]),
    other: EffectId,
) -> Vec<f64> {
    let problem = &last.search.problem;
    let own: Vec<(usize, f64)> = problem.block(effect).zip(values.iter().copied()).collect();
    let beside = last.fitted.found.iter().map(|found| found.effect).filter(|&beside| beside != effect);
    let theirs: Vec<usize> =
        std::iter::once(other).chain(beside).flat_map(|effect| problem.columns(effect)).collect();
    let columns: Vec<usize> = theirs.iter().copied().chain(own.iter().map(|&(column, _)| column)).collect();
    let gram = Mat::from_fn(columns.len(), columns.len(), |i, j| gram[(columns[i], columns[j])]);
    let mut sweep = Sweep::new(gram);
    (0..theirs.len()).for_each(|at| {
        sweep.add(at);
    });
    let taken_up = theirs.iter().enumerate().filter(|(at, _)| sweep.contains(*at)).map(|(at, &column)| {
        let of_own = own.iter().enumerate();
        let scaled: f64 = of_own
            .map(|(i, (own, value))| sweep.entry(at, theirs.len() + i) * value * problem.length(*own))
            .sum();
        (column, -scaled / problem.length(column))
    });
    let all: Vec<(usize, f64)> = taken_up.chain(own.iter().copied()).collect();
    let combinations = &last.fitted.combinations;
    let mut moves = vec![0.0; combinations.nrows()];
    for (column, size) in all {
        for (j, share) in problem.share(column).iter().enumerate() {
            moves.iter_mut().enumerate().for_each(|(i, own)| *own += size * combinations[(i, j)] * share);
        }
    }
    moves
}
