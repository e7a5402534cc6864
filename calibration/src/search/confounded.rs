//! Confounded sets: candidates that no data at these poses can tell apart.

use std::ops::Index;

use super::problem::Problem;
use super::sweep::Sweep;
use effects::candidate::EffectId;

/// Overlap of the projected spaces above which two candidates are confounded.
const SAME: f64 = 0.995;

/// Candidates whose projected spaces coincide: at least one, of which the first stands for all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfoundedSet {
    /// Its candidates; the first is the one that is tested.
    pub members: Vec<EffectId>,
    /// The common rank after projection.
    pub rank: usize,
}

/// Where a confounded set stands among those of one problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SetId(pub usize);

impl Index<SetId> for Vec<ConfoundedSet> {
    type Output = ConfoundedSet;

    fn index(&self, id: SetId) -> &ConfoundedSet {
        &self[id.0]
    }
}

/// The columns that each confounded set is tested by: those of its first member.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SetColumns(Vec<Vec<usize>>);

impl SetColumns {
    /// Of all sets of a problem.
    #[must_use]
    pub fn of(problem: &Problem, sets: &[ConfoundedSet]) -> Self {
        Self(sets.iter().map(|set| problem.columns(set.members[0])).collect())
    }

    /// Every set.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = SetId> + use<> {
        (0..self.0.len()).map(SetId)
    }
}

impl Index<SetId> for SetColumns {
    type Output = [usize];

    fn index(&self, id: SetId) -> &[usize] {
        &self.0[id.0]
    }
}

/// Merges candidates into confounded sets, in order of first member; those of rank zero are left out.
#[must_use]
pub fn confounded_sets(problem: &Problem) -> Vec<ConfoundedSet> {
    let (gram, _) = problem.gram(|_| true);
    let sweep = Sweep::new(gram);
    let mut sets: Vec<ConfoundedSet> = Vec::new();
    let mut bases: Vec<Vec<usize>> = Vec::new();
    for candidate in problem.candidates() {
        let columns = problem.columns(candidate);
        let rank = rank(&sweep, &columns);
        if rank == 0 {
            continue;
        }
        let same = (0..sets.len()).find(|&i| {
            sets[i].rank == rank
                && overlap(&sweep, &columns, &bases[i], rank) > SAME
                && overlap(&sweep, &bases[i], &columns, rank) > SAME
        });
        match same {
            Some(i) => sets[i].members.push(candidate),
            None => {
                sets.push(ConfoundedSet { members: vec![candidate], rank });
                bases.push(columns);
            }
        }
    }
    sets
}

/// Rank of a block of columns.
fn rank(sweep: &Sweep, columns: &[usize]) -> usize {
    match columns.first() {
        Some(&any) => sweep.gain(columns, any).1,
        None => 0,
    }
}

/// Mean squared length of the unit vectors of `of`'s space after projection on `on`'s, both seen in what the
/// swept columns leave: one if it lies within, zero if it is orthogonal.
#[must_use]
pub fn overlap(sweep: &Sweep, of: &[usize], on: &[usize], rank: usize) -> f64 {
    // trace(G_oo⁻ G_on G_nn⁻ G_no) / rank, by sweeping a small copy.
    let all: Vec<usize> = of.iter().chain(on).copied().collect();
    let small = faer::Mat::from_fn(all.len(), all.len(), |i, j| sweep.entry(all[i], all[j]));
    // A quick way out for single columns, the most common case.
    if of.len() == 1 && on.len() == 1 {
        let (a, b, c) = (small[(0, 0)], small[(1, 1)], small[(0, 1)]);
        return if a > 0.0 && b > 0.0 { c * c / (a * b) } else { 0.0 };
    }
    let mut unexplained = Sweep::new(small.clone());
    for j in of.len()..all.len() {
        unexplained.add(j);
    }
    let mut inverse = Sweep::new(small);
    for j in 0..of.len() {
        inverse.add(j);
    }
    let mut left = 0.0;
    for i in (0..of.len()).filter(|&i| inverse.contains(i)) {
        for j in (0..of.len()).filter(|&j| inverse.contains(j)) {
            left -= inverse.entry(i, j) * unexplained.entry(i, j);
        }
    }
    1.0 - left / rank.max(1) as f64
}
