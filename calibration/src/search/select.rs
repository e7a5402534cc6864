//! Selection: forward by familywise p and a penalised likelihood, confirmed by cross-validation, with swaps
//! and drops.

use faer::{Mat, MatRef};

use super::confounded::{ConfoundedSet, SetColumns, SetId};
use super::flips::{Family, familywise};
use super::guards::Guards;
use super::modest::Modest;
use super::problem::Problem;
use super::signs::Signs;
use super::standardised::is_needed;
use super::state::State;
use super::sweep::Sweep;
use super::tail::Tails;

/// ln of a Bonferroni p below which the flips are not asked.
const BEYOND_FLIPS: f64 = -25.0;

/// Passing sets, the likeliest first, that are asked whether they hold on held-out folds and within the guards.
const ASKED: usize = 8;

/// How a search decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Chance that anything at all is accepted where there is nothing: 0.05.
    pub false_alarm: f64,
    /// Sign flips for the familywise p.
    pub flips: usize,
    /// Seed of the flips.
    pub seed: u64,
    /// Effects accepted at most; reaching it is told ([`Selection::ended`]).
    pub most: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { false_alarm: 0.05, flips: 999, seed: 1, most: 20 }
    }
}

/// An accepted confounded set.
#[derive(Debug, Clone, PartialEq)]
pub struct Accepted {
    /// Which.
    pub set: SetId,
    /// Its familywise p when it was accepted.
    pub p_value: f64,
}

/// What a selection ends with.
#[derive(Debug, Clone)]
pub struct Selection {
    /// The accepted sets in the order they came in.
    pub accepted: Vec<Accepted>,
    /// The smallest familywise p of all that was left out at the end.
    pub remaining_p: f64,
    /// Why the search took no more.
    pub ended: Ended,
    /// The training rows' Gram matrix with the declared columns and the accepted effects swept.
    pub state: State,
}

/// Why a search took no more effects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ended {
    /// Nothing that is left passes the test.
    NothingPasses,
    /// What passes gains nothing on held-out folds.
    NothingGains,
    /// What passes and gains would be large and cancel over the data, or far larger further out: the sets refused.
    Refused(Vec<SetId>),
    /// The largest number of effects is reached, and more would pass.
    MostReached,
}

/// Searches the folds chosen, starting from `start` (sets accepted before).
#[must_use]
pub fn select(
    problem: &Problem,
    sets: &[ConfoundedSet],
    start: &[Accepted],
    chosen: impl Fn(usize) -> bool + Copy,
    options: &Options,
) -> Selection {
    let blocks = SetColumns::of(problem, sets);
    let members = problem.rows_of_folds(chosen);
    let groups: Vec<u32> = members.iter().map(|&row| problem.group_of_row()[row]).collect();
    let stated = members.iter().filter(|&&row| row >= problem.first_stated()).count();
    let signs = Signs::new(&groups, stated, options.flips, options.seed);
    let folds: Vec<usize> = (0..problem.folds()).filter(|&fold| chosen(fold)).collect();

    let mut state = State::declared(problem, chosen);
    let guards = Guards {
        projected: state.sweep.clone(),
        blocks: &blocks,
        declared: problem.declared(),
        residual: problem.residual(),
        reach: problem.reach(),
    };
    let mut accepted: Vec<Accepted> = Vec::new();
    for known in start {
        state.add(&blocks[known.set]);
        accepted.push(known.clone());
    }
    let search = Search { problem, blocks: &blocks, rows: &members, folds: &folds, guards };
    let mut dropped = search.drop_idle(&mut state, &mut accepted, options, None);
    let (remaining_p, ended) = loop {
        let mut tests = search.test(&state, &accepted, &signs);
        // What was dropped once does not come back, here or by a swap: every turn of this loop accepts one more or
        // shortens the list of candidates, so it ends.
        tests.retain(|test| !dropped.contains(&test.set));
        let remaining_p = tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
        if remaining_p > options.false_alarm {
            break (remaining_p, Ended::NothingPasses);
        }
        if accepted.len() >= options.most {
            break (remaining_p, Ended::MostReached);
        }
        match search.best(&state, &accepted, tests, options) {
            Err(ended) => break (remaining_p, ended),
            Ok(best) => {
                state.add(&blocks[best.set]);
                accepted.push(best);
            }
        }
        search.swap(&mut state, &mut accepted, &dropped);
        let newest = accepted.last().map(|a| a.set);
        dropped.extend(search.drop_idle(&mut state, &mut accepted, options, newest));
    };
    let mut places: Vec<SetId> = accepted.iter().map(|a| a.set).collect();
    Modest { blocks: &blocks, guards: &search.guards, dropped: &dropped }.written(&mut state, &mut places);
    accepted.iter_mut().zip(places).for_each(|(accepted, set)| accepted.set = set);
    Selection { accepted, remaining_p, ended, state }
}

/// The test of one set against the present state.
struct Test {
    set: SetId,
    p_value: f64,
    criterion: f64,
}

/// What a regression leaves.
struct Left {
    rss: f64,
    df: f64,
}

/// What every step of one search reads.
struct Search<'a> {
    problem: &'a Problem,
    blocks: &'a SetColumns,
    /// The rows that are searched.
    rows: &'a [usize],
    folds: &'a [usize],
    guards: Guards<'a>,
}

impl Search<'_> {
    /// The likeliest set that passes, gains on held-out folds and is within the guards.
    fn best(
        &self,
        state: &State,
        accepted: &[Accepted],
        tests: Vec<Test>,
        options: &Options,
    ) -> Result<Accepted, Ended> {
        let mut passing: Vec<Test> =
            tests.into_iter().filter(|test| test.p_value <= options.false_alarm).collect();
        passing.sort_by(|a, b| b.criterion.total_cmp(&a.criterion).then(a.set.cmp(&b.set)));
        let before = self.held_out(&state.base);
        let mut refused = Vec::new();
        for test in passing.into_iter().take(ASKED) {
            let with: Vec<usize> = state.base.iter().chain(&self.blocks[test.set]).copied().collect();
            if self.held_out(&with) >= before {
                continue;
            }
            let sets: Vec<SetId> = accepted.iter().map(|a| a.set).chain([test.set]).collect();
            if self.guards.hold(&sets) {
                return Ok(Accepted { set: test.set, p_value: test.p_value });
            }
            refused.push(test.set);
        }
        Err(if refused.is_empty() { Ended::NothingGains } else { Ended::Refused(refused) })
    }

    /// Tests every set that is not in yet.
    fn test(&self, state: &State, accepted: &[Accepted], signs: &Signs) -> Vec<Test> {
        let open: Vec<SetId> =
            self.blocks.ids().filter(|&set| accepted.iter().all(|a| a.set != set)).collect();
        let gains: Vec<(f64, usize)> = open.iter().map(|&set| state.gain(&self.blocks[set])).collect();
        let tails = Tails::new(gains.iter().map(|&(_, rank)| rank), state.df());
        let tested: Vec<Vec<usize>> = open.iter().map(|&set| self.blocks[set].to_vec()).collect();
        let best = gains.iter().map(|&(gain, rank)| tails.ln_p(rank, gain, state.rss())).fold(0.0, f64::min);
        // Far beyond what the flips could resolve, their number alone bounds the p; not where groups are few, since the
        // table knows nothing of them; nor where stations may be further off than is stated.
        let resolved = !is_needed(signs.with_sign(), state.base.len()) && signs.stated() == 0;
        let sure = resolved && best + (open.len() as f64).ln() < BEYOND_FLIPS;
        let family = Family {
            columns: self.problem.rows(),
            rows: self.rows,
            sweep: &state.sweep,
            base: &state.base,
            blocks: &tested,
            tails: &tails,
        };
        let smallest = if sure { vec![best.midpoint(0.0); signs.flips()] } else { family.smallest(signs) };
        open.iter()
            .zip(gains)
            .filter(|&(_, (_, rank))| rank > 0)
            .map(|(&set, (gain, rank))| Test {
                set,
                p_value: familywise(tails.ln_p(rank, gain, state.rss()), &smallest),
                criterion: state.criterion(gain, rank),
            })
            .collect()
    }

    /// Cross-validated sum of squares of a regression on some columns.
    fn held_out(&self, columns: &[usize]) -> f64 {
        if self.folds.len() < 2 {
            // Nothing to hold out: the in-sample criterion has already spoken.
            return -(columns.len() as f64);
        }
        let residual = self.problem.residual();
        let mut picked = columns.to_vec();
        picked.push(residual);
        let small = |gram: MatRef<'_, f64>| {
            Mat::from_fn(picked.len(), picked.len(), |i, j| gram[(picked[i], picked[j])])
        };
        let parts: Vec<Mat<f64>> =
            self.folds.iter().map(|&fold| small(self.problem.fold_gram(fold))).collect();
        let mut total = self.problem.prior().map_or_else(|| Mat::zeros(picked.len(), picked.len()), small);
        parts.iter().for_each(|part| total += part);
        parts.iter().map(|part| held_out_rss(&total, part)).sum()
    }

    /// Tries each accepted set against the others of no larger rank, those dropped before aside, until no exchange
    /// gains.
    fn swap(&self, state: &mut State, accepted: &mut [Accepted], dropped: &[SetId]) {
        for _ in 0..2 {
            let mut changed = false;
            for at in 0..accepted.len() {
                let own = accepted[at].set;
                state.remove_among(own, accepted.iter().map(|a| a.set), self.blocks);
                let (gain, rank) = state.gain(&self.blocks[own]);
                let present = state.criterion(gain, rank);
                let mut better: Vec<(f64, SetId)> = self
                    .blocks
                    .ids()
                    .filter(|set| accepted.iter().all(|a| a.set != *set) && !dropped.contains(set))
                    .filter_map(|set| {
                        let (gain, other) = state.gain(&self.blocks[set]);
                        let criterion = state.criterion(gain, other);
                        let gains = other > 0 && other <= rank.max(1) && criterion > present + 1e-9;
                        gains.then_some((criterion, set))
                    })
                    .collect();
                better.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
                let with = |set: SetId| -> Vec<SetId> {
                    accepted.iter().map(|a| if a.set == own { set } else { a.set }).collect()
                };
                let best = better.into_iter().map(|(_, set)| set).take(ASKED);
                let best = best.into_iter().find(|&set| self.guards.hold(&with(set))).unwrap_or(own);
                state.add(&self.blocks[best]);
                changed |= best != own;
                accepted[at].set = best;
            }
            if !changed {
                break;
            }
        }
    }

    /// What an accepted set takes off the sum of squares beside the others, its rank there, and what is left without it.
    fn taken_off(&self, state: &mut State, accepted: &[Accepted], own: SetId) -> (f64, usize, Left) {
        let all = || accepted.iter().map(|a| a.set);
        if all().flat_map(|set| &self.blocks[set]).all(|&column| state.sweep.contains(column)) {
            let (gain, rank) = state.loss(&self.blocks[own]);
            return (gain, rank, Left { rss: state.rss() + gain, df: state.df() + rank as f64 });
        }
        // Some share columns: what lies within the others gains nothing beside them.
        state.remove_among(own, all(), self.blocks);
        let (gain, rank) = state.gain(&self.blocks[own]);
        let left = Left { rss: state.rss(), df: state.df() };
        state.add(&self.blocks[own]);
        (gain, rank, left)
    }

    /// Drops accepted sets, `newest` aside, that later ones have made idle: their Bonferroni p is above the
    /// false-alarm rate. Returns them.
    fn drop_idle(
        &self,
        state: &mut State,
        accepted: &mut Vec<Accepted>,
        options: &Options,
        newest: Option<SetId>,
    ) -> Vec<SetId> {
        let mut dropped = Vec::new();
        loop {
            let mut worst: Option<(f64, usize)> = None;
            for (at, own) in accepted.iter().enumerate().filter(|(_, a)| Some(a.set) != newest) {
                let (gain, rank, left) = self.taken_off(state, accepted, own.set);
                let tails = Tails::new([rank], left.df);
                let ln_p = tails.ln_p(rank, gain, left.rss) + (self.blocks.ids().len() as f64).ln();
                let idle = rank == 0 || ln_p > options.false_alarm.ln();
                if idle && worst.is_none_or(|(most, _)| ln_p > most) {
                    worst = Some((ln_p, at));
                }
            }
            let Some((_, at)) = worst else { return dropped };
            let gone = accepted.remove(at);
            let left = accepted.iter().map(|a| a.set);
            state.remove_among(gone.set, left, self.blocks);
            dropped.push(gone.set);
        }
    }
}

/// Sum of squares that a regression fitted to `total − part` leaves in `part`; the last column is the residual.
pub(super) fn held_out_rss(total: &Mat<f64>, part: &Mat<f64>) -> f64 {
    let last = total.ncols() - 1;
    let mut sweep = Sweep::new(total - part);
    let used: Vec<usize> = (0..last).filter(|&j| sweep.add(j)).collect();
    let mut rss = part[(last, last)];
    for &i in &used {
        let b = sweep.entry(i, last);
        rss -= 2.0 * b * part[(i, last)];
        rss += used.iter().map(|&j| b * sweep.entry(j, last) * part[(i, j)]).sum::<f64>();
    }
    rss
}
