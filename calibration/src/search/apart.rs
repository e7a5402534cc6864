//! Confounded sets as a contest leaves them: causes that it excludes stand apart from those that it allows.
//!
//! A set is made by how alike columns are, as a share of their length. An effect of a hundred standard deviations shows more than that.

use super::confounded::ConfoundedSet;
use super::context::Found;
use effects::candidate::EffectId;

/// The sets, each split by what a contest said of every effect that was found.
pub(super) fn apart(sets: Vec<ConfoundedSet>, found: &[Found]) -> Vec<ConfoundedSet> {
    let all = |sets: Vec<ConfoundedSet>, found: &Found| {
        sets.into_iter().flat_map(|set| split(set, found)).collect()
    };
    found.iter().fold(sets, all)
}

/// What may be the cause of an effect, the effect first, and what may not.
fn split(set: ConfoundedSet, found: &Found) -> impl Iterator<Item = ConfoundedSet> + use<> {
    let ConfoundedSet { members, rank } = set;
    let is_possible = |member: &EffectId| found.shares.iter().any(|(own, _)| own == member);
    let (mut possible, excluded): (Vec<_>, Vec<_>) = members.into_iter().partition(is_possible);
    // What is written into the chain is what is tested.
    possible.sort_by_key(|&member| member != found.effect);
    let parts = [possible, excluded].into_iter().filter(|members| !members.is_empty());
    parts.map(move |members| ConfoundedSet { members, rank })
}
