//! Competing models: confounded sets that explain the data about as well as an accepted one.

use super::confounded::{ConfoundedSet, SetColumns, SetId};
use super::problem::Problem;
use super::state::State;

/// Units of log-likelihood within which two explanations are as good as each other.
pub const AS_GOOD: f64 = 2.0;

/// A confounded set that could stand in an accepted one's place.
#[derive(Debug, Clone, PartialEq)]
pub struct CompetingModel {
    /// Which.
    pub set: SetId,
    /// Penalised log-likelihood of the accepted set minus this one's: by Schwarz's price for what is believed, or by
    /// Akaike's for what is expected of new data, whichever is less. The dearer price alone would hide a cause with one number
    /// more than the accepted one that these data fit as well.
    pub behind: f64,
}

/// For each accepted set, the others within some units ([`AS_GOOD`]) of penalised log-likelihood of it, best first, all
/// other accepted sets kept.
#[must_use]
pub fn competing_models(
    problem: &Problem,
    sets: &[ConfoundedSet],
    accepted: &[SetId],
    state: &State,
    within: f64,
) -> Vec<Vec<CompetingModel>> {
    let blocks = SetColumns::of(problem, sets);
    accepted
        .iter()
        .map(|&own| {
            let mut without = state.clone();
            without.remove_among(own, accepted.iter().copied(), &blocks);
            let (gain, rank) = without.gain(&blocks[own]);
            let best = without.likelihood(gain, rank);
            let mut competing: Vec<CompetingModel> = blocks
                .ids()
                .filter(|set| !accepted.contains(set))
                .filter_map(|set| {
                    let (gain, rank) = without.gain(&blocks[set]);
                    let other = without.likelihood(gain, rank);
                    let believed = best.penalised() - other.penalised();
                    let behind = believed.min(best.expected() - other.expected());
                    (rank > 0 && behind <= within).then_some(CompetingModel { set, behind })
                })
                .collect();
            competing.sort_by(|a, b| a.behind.total_cmp(&b.behind).then(a.set.cmp(&b.set)));
            competing
        })
        .collect()
}
