//! A contest under way: what was reached, what is best, and how a search is started.

use crate::bench::{Bench, Model, State};
use crate::error::Error;
use crate::families::Family;
use crate::greedy::Greedy;
use crate::likelihood::Active;
use crate::linearise::Linearise;
use crate::places::Places;
use crate::policy::Policy;
use crate::problem::Problem;
use crate::record::Recorder;
use crate::setups::Cuts;

/// Families after which a search without memory ends where the residual remembers. It only bounds work: with memory
/// the search goes on from what was found.
const TRACED: usize = 3;

/// A contest under way.
pub(crate) struct Run<'a> {
    pub bench: Bench<'a>,
    pub chain: Option<&'a dyn Linearise>,
    /// Every explanation that was reached.
    pub reached: Vec<Model>,
    pub record: Recorder,
    /// The noise that the bare residual leaves.
    pub bare: usize,
    /// Whether the residual remembers: then a search without memory ends early, for all that it adds traces noise.
    pub remembers: bool,
    /// Found cuts of the order.
    pub cuts: Option<Cuts>,
}

impl<'a> Run<'a> {
    pub fn new(
        problem: &'a Problem,
        policy: &'a Policy,
        chain: Option<&'a dyn Linearise>,
        lets: &dyn Fn(&Family, &Places) -> bool,
    ) -> Result<Self, Error> {
        let bench = Bench::new(problem, policy, lets)?;
        Ok(Self {
            bench,
            chain,
            reached: Vec::new(),
            record: Recorder::new(),
            bare: 0,
            remembers: false,
            cuts: None,
        })
    }

    /// The best explanation; of several within a nat the one with the fewest causes.
    pub fn told(&self) -> Model {
        let lead = self.best().odds - self.bench.policy.fewer_causes;
        let near = self.reached.iter().filter(|model| model.odds > lead);
        let key = |model: &Model| self.bench.causes(&model.active).len();
        let told = near.min_by(|a, b| key(a).cmp(&key(b)).then(b.odds.total_cmp(&a.odds)));
        told.unwrap_or_else(|| self.best()).clone()
    }

    /// The explanation with the highest odds.
    pub fn best(&self) -> &Model {
        let mut best = &self.reached[0];
        for model in &self.reached[1..] {
            if model.odds > best.odds {
                best = model;
            }
        }
        best
    }

    /// The state in which the noise is what an explanation leaves.
    pub fn weighed(&mut self, active: &Active, state: State) -> State {
        State { noise: self.bench.add_noise_of(active, state.point), ..state }
    }

    /// Notes an explanation, with its odds under the noise and the memory that it leaves itself: judged under the
    /// noise of another explanation it would look worse than it is.
    pub fn reach(&mut self, model: Model) -> Model {
        let own = self.weighed(&model.active, model.state);
        let mut noises = vec![own.noise];
        if model.state.memory.is_some() {
            // Weights are estimated as if rows forgot each other: with memory, even ones may be better.
            noises.extend([model.state.noise, 0]);
        }
        let mut best = Model { odds: f64::NEG_INFINITY, ..model };
        for noise in noises {
            let state = State { noise, ..best.state };
            let odds = self.bench.own_odds(&best.active, state);
            if odds > best.odds {
                best = Model { active: best.active, state, odds };
            }
        }
        self.reached.push(best.clone());
        best
    }

    /// A search over all families that are allowed.
    pub fn search(&mut self, start: &Active, state: State, allowed: &dyn Fn(usize) -> bool) -> Model {
        self.search_up_to(start, state, allowed, self.most(state))
    }

    /// A search over families of the noise.
    pub fn search_noise(&mut self, start: &Active, state: State) -> Model {
        self.search_noise_up_to(start, state, self.most(state))
    }

    /// Families at most in a state.
    fn most(&self, state: State) -> usize {
        let all = self.bench.policy.most_active as usize;
        if self.remembers && state.memory.is_none() { all.min(TRACED) } else { all }
    }

    pub fn search_noise_up_to(&mut self, start: &Active, state: State, most: usize) -> Model {
        let noise: Vec<bool> = self.bench.dictionary.families.iter().map(Family::is_noise).collect();
        self.search_up_to(start, state, &|family| noise[family], most)
    }

    pub fn search_up_to(
        &mut self,
        start: &Active,
        state: State,
        allowed: &dyn Fn(usize) -> bool,
        most: usize,
    ) -> Model {
        let view = self.bench.view(state);
        let active = Greedy { view: &view, allowed, most }.from(start, &mut self.record);
        self.bench.model(active, state)
    }
}

/// The families of an active set, by number.
pub(crate) fn sorted(active: &[(usize, f64)]) -> Vec<usize> {
    let mut families: Vec<usize> = active.iter().map(|&(family, _)| family).collect();
    families.sort_unstable();
    families
}
