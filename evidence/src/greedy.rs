//! The search for an active set: add the best, tune all, drop what no longer gains, swap, try one for two.

use crate::likelihood::{Active, Gain, View};
use crate::record::{Reason, Recorder};

/// A search over one Gram matrix.
pub(crate) struct Greedy<'a, 'b> {
    pub view: &'a View<'b>,
    /// Whether a family may enter.
    pub allowed: &'a dyn Fn(usize) -> bool,
    /// Families at most.
    pub most: usize,
}

impl Greedy<'_, '_> {
    /// The best active set that single steps reach from a start.
    pub fn from(&self, start: &[(usize, f64)], record: &mut Recorder) -> Active {
        let mut active = start.to_vec();
        let mut judged = Vec::new();
        let mut reached = f64::NEG_INFINITY;
        while active.len() < self.most {
            let Some((family, gain, score)) = self.best(&active) else { break };
            if score <= self.view.policy.enter {
                break;
            }
            let before = active.clone();
            active.push((family, gain.variance));
            record.note(family, true, Reason::Best, score);
            active = tune(self.view, &active, 2, record);
            for _ in 0..2 {
                if !self.drop_or_swap(&mut active, &mut judged, record) {
                    break;
                }
            }
            // Of families that are nearly one to the data each may push the other out, without end.
            let odds = self.odds(&active);
            if odds <= reached {
                active = before;
                break;
            }
            reached = odds;
        }
        self.one_for_two(&mut active, record);
        tune(self.view, &active, 3, record)
    }

    /// The family with the best gain less price; the first of equals.
    fn best(&self, active: &[(usize, f64)]) -> Option<(usize, Gain, f64)> {
        best_of(self.view, &self.view.scan(active, self.allowed))
    }

    fn odds(&self, active: &[(usize, f64)]) -> f64 {
        self.view.log_evidence(active) - self.view.price(active)
    }

    /// Drops the first family that no longer gains, or swaps the first that another beats. Whether anything moved.
    /// A family whose own gain has not changed since it was judged keeps its place: the others' have not either.
    fn drop_or_swap(
        &self,
        active: &mut Active,
        judged: &mut Vec<(usize, f64)>,
        record: &mut Recorder,
    ) -> bool {
        if active.len() < 2 {
            return false;
        }
        for &(family, _) in active.clone().iter() {
            let others: Active = active.iter().copied().filter(|&(other, _)| other != family).collect();
            let own = self.view.one(&others, family).nats - self.view.families[family].price;
            let same = |&(known, score): &(usize, f64)| {
                known == family && (score - own).abs() < self.view.policy.swap_scan
            };
            if own > self.view.policy.enter && judged.iter().any(same) {
                continue;
            }
            judged.retain(|&(known, _)| known != family);
            judged.push((family, own));
            let gains = self.view.scan(&others, &|other| other == family || (self.allowed)(other));
            let Some((rival, gain, score)) = best_of(self.view, &gains) else { continue };
            if own <= self.view.policy.enter && score <= self.view.policy.enter {
                record.note(family, false, Reason::NoGain, own);
                *active = others;
                return true;
            }
            if rival != family && score > own + self.view.policy.swap_scan {
                let mut with_rival = others;
                with_rival.push((rival, gain.variance));
                let with_rival = tune(self.view, &with_rival, 2, &mut Recorder::new());
                if self.odds(&with_rival) > self.odds(active) + self.view.policy.swap_model {
                    record.note(family, false, Reason::Swapped(rival), own);
                    record.note(rival, true, Reason::Swapped(family), score);
                    *active = with_rival;
                    return true;
                }
            }
        }
        false
    }

    /// Replaces two causes at one place or with one driver by one that explains both better.
    fn one_for_two(&self, active: &mut Active, record: &mut Recorder) {
        for first in 0..active.len() {
            for second in first + 1..active.len() {
                let pair = [active[first].0, active[second].0];
                let [a, b] = pair.map(|family| &self.view.families[family]);
                let akin = a.site.0 == b.site.0 || a.site.1 == b.site.1;
                if a.is_noise || b.is_noise || !akin {
                    continue;
                }
                let others: Active =
                    active.iter().copied().filter(|(other, _)| !pair.contains(other)).collect();
                let Some((rival, gain, score)) = self.best(&others) else { continue };
                if pair.contains(&rival) || others.iter().any(|&(other, _)| other == rival) {
                    continue;
                }
                let mut with_rival = others;
                with_rival.push((rival, gain.variance));
                let with_rival = tune(self.view, &with_rival, 2, &mut Recorder::new());
                if self.odds(&with_rival) > self.odds(active) + self.view.policy.swap_model {
                    for family in pair {
                        record.note(family, false, Reason::OneForTwo(rival), f64::NAN);
                    }
                    record.note(rival, true, Reason::Best, score);
                    *active = with_rival;
                    return;
                }
            }
        }
    }
}

/// The family whose gain less price is largest.
pub(crate) fn best_of(view: &View, gains: &[Gain]) -> Option<(usize, Gain, f64)> {
    let mut best: Option<(usize, Gain, f64)> = None;
    for (family, gain) in gains.iter().enumerate() {
        let score = gain.nats - view.families[family].price;
        if score.is_finite() && best.is_none_or(|(.., most)| score > most) {
            best = Some((family, *gain, score));
        }
    }
    best
}

/// Optimises the variance of each family in turn; one that gains nothing leaves.
pub(crate) fn tune(view: &View, active: &[(usize, f64)], sweeps: usize, record: &mut Recorder) -> Active {
    let mut active = active.to_vec();
    for _ in 0..sweeps {
        let mut moved: f64 = 0.0;
        for (family, before) in active.clone() {
            let others: Active = active.iter().copied().filter(|&(other, _)| other != family).collect();
            let gain = view.one(&others, family);
            if gain.nats <= 0.0 {
                record.note(family, false, Reason::NoGain, gain.nats - view.families[family].price);
                active = others;
                moved = f64::INFINITY;
                continue;
            }
            moved = moved.max((gain.variance / before).ln().abs());
            for (other, variance) in &mut active {
                if *other == family {
                    *variance = gain.variance;
                }
            }
        }
        // One step of the grid of variances is .23.
        if moved < 0.3 {
            break;
        }
    }
    active
}
