//! Structure remains: whether a smooth function of a joint, at some place in the chain, stands out of a residual that
//! the catalogue has done with, and what it looks like.
//!
//! The candidates are whole Fourier series (location × degree of freedom × driver); they go through the same test,
//! the same sign flips and the same confirmation on held-out folds as the effects did.

use std::ops::Range;

use super::classes::classes;
use super::problem::Problem;
use super::select::{Options, State, select};

/// Penalised log-likelihood by which a smooth function must beat the catalogue's model.
const BETTER: f64 = 3.0;

/// A smooth function that stands out.
#[derive(Debug, Clone, PartialEq)]
pub struct Smooth {
    /// Number of the candidate.
    pub candidate: usize,
    /// Coefficient of each of its columns, in the units of the columns before scaling; 0 for those that are not seen.
    pub coefficients: Vec<f64>,
    /// Covariance of the coefficients, row by row.
    pub covariance: Vec<f64>,
}

/// What a scan of smooth functions found.
#[derive(Debug, Clone, PartialEq)]
pub struct Remains {
    /// Familywise p of the most conspicuous one.
    pub p_value: f64,
    /// The one that is confirmed, if any.
    pub smooth: Option<Smooth>,
}

/// Scans the candidates of a problem whose declared columns hold the accepted effects as well. `blocks` are the
/// candidates' columns as the problem was made with them.
#[must_use]
pub fn remains(problem: &Problem, blocks: &[Range<usize>], options: &Options) -> Remains {
    let classes = classes(problem);
    let options = Options { most: 1, ..options.clone() };
    let selection = select(problem, &classes, &[], |_| true, &options);
    let Some(accepted) = selection.accepted.first() else {
        return Remains { p_value: selection.remaining_p, smooth: None };
    };
    let candidate = classes[accepted.class].members[0];
    let declared = State::declared(problem, |_| true);
    let (gain, rank) = declared.gain(&problem.columns(candidate));
    let better = declared.criterion(gain, rank) - declared.criterion(0.0, 0);
    let smooth =
        (better > BETTER).then(|| shape(problem, &selection.state, candidate, blocks[candidate].len()));
    Remains { p_value: accepted.p_value, smooth }
}

fn shape(problem: &Problem, state: &State, candidate: usize, width: usize) -> Smooth {
    let variance = state.rss() / state.df().max(1.0);
    let seen: Vec<(usize, usize)> =
        problem.block(candidate).enumerate().filter(|&(_, column)| state.sweep.contains(column)).collect();
    let mut coefficients = vec![0.0; width];
    let mut covariance = vec![0.0; width * width];
    for &(i, a) in &seen {
        coefficients[i] = state.sweep.entry(a, problem.residual()) / problem.length(a);
        for &(j, b) in &seen {
            let inverse = -state.sweep.entry(a, b);
            covariance[i * width + j] = variance * inverse / (problem.length(a) * problem.length(b));
        }
    }
    Smooth { candidate, coefficients, covariance }
}
