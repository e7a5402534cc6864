//! Rivals: classes that explain the data about as well as an accepted one.

use super::classes::Class;
use super::problem::Problem;
use super::select::{State, class_columns};

/// Units of log-likelihood within which two explanations are as good as each other.
pub const AS_GOOD: f64 = 2.0;

/// A class that could stand in an accepted one's place.
#[derive(Debug, Clone, PartialEq)]
pub struct Rival {
    /// Number of the class.
    pub class: usize,
    /// Penalised log-likelihood of the accepted class minus this one's.
    pub behind: f64,
}

/// For each accepted class, the others within some units ([`AS_GOOD`]) of penalised log-likelihood of it, best first, all
/// other accepted classes kept.
#[must_use]
pub fn rivals(
    problem: &Problem,
    classes: &[Class],
    accepted: &[usize],
    state: &State,
    within: f64,
) -> Vec<Vec<Rival>> {
    let blocks = class_columns(problem, classes);
    accepted
        .iter()
        .map(|&own| {
            let mut without = state.clone();
            without.remove_among(own, accepted.iter().copied(), &blocks);
            let (gain, rank) = without.gain(&blocks[own]);
            let best = without.criterion(gain, rank);
            let mut rivals: Vec<Rival> = (0..classes.len())
                .filter(|class| !accepted.contains(class))
                .filter_map(|class| {
                    let (gain, rank) = without.gain(&blocks[class]);
                    let behind = best - without.criterion(gain, rank);
                    (rank > 0 && behind <= within).then_some(Rival { class, behind })
                })
                .collect();
            rivals.sort_by(|a, b| a.behind.total_cmp(&b.behind).then(a.class.cmp(&b.class)));
            rivals
        })
        .collect()
}
