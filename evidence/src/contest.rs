//! The contest: from a problem to the explanation that is told, by one likelihood.

use crate::bench::{Model, State};
use crate::error::Error;
use crate::families::Family;
use crate::greedy::tune;
use crate::likelihood::Active;
use crate::linearise::Linearise;
use crate::margins::{Finding, findings};
use crate::outcome::Outcome;
use crate::places::Places;
use crate::policy::Policy;
use crate::problem::Problem;
use crate::record::Stage;
use crate::run::{Run, sorted};
use crate::small::Small;

/// Points at which one explanation is linearised, at most, before the search goes on from where it is.
const ROUNDS: usize = 2;
/// Shortfall from the best, nats, at which a start is not followed further.
const HOPELESS: f64 = 15.0;
/// Difference of odds that is rounding, nats.
const SAME: f64 = 0.01;

/// Runs a contest. With a chain, explanations whose effects are not small are judged at their own point.
///
/// # Errors
///
/// A problem that cannot be judged, or a chain that cannot be evaluated.
pub fn contest<'a>(
    problem: &'a Problem,
    policy: &'a Policy,
    chain: Option<&'a dyn Linearise>,
) -> Result<Outcome<'a>, Error> {
    contest_among(problem, policy, chain, &|_, _| true)
}

/// Runs a contest among the families that a caller lets compete. Prices stay those of the whole dictionary; shapes
/// compete only where smooth functions do.
///
/// # Errors
///
/// A problem that cannot be judged, or a chain that cannot be evaluated.
pub fn contest_among<'a>(
    problem: &'a Problem,
    policy: &'a Policy,
    chain: Option<&'a dyn Linearise>,
    lets: &dyn Fn(&Family, &Places) -> bool,
) -> Result<Outcome<'a>, Error> {
    let mut run = Run::new(problem, policy, chain, lets)?;
    run.causes_first()?;
    run.without_robust_weights();
    run.find_setups();
    run.noise_first();
    run.name_shapes();
    let (told, findings) = run.weigh_margins()?;
    Ok(Outcome::new(run, told, findings))
}

impl Run<'_> {
    /// Every family at once, under the noise of the bare residual and then under the noise that is left.
    fn causes_first(&mut self) -> Result<(), Error> {
        let start = State { noise: 0, memory: None, point: 0 };
        let mut state = self.weighed(&Active::new(), start);
        self.bare = state.noise;
        self.remembers = self.bench.memory_of(&Active::new(), state.noise, 0).is_some();
        let mut model = self.search(&Active::new(), state, &|_| true);
        self.record.stage = Stage::Relinearised;
        for _ in 0..ROUNDS {
            let Some(settled) = self.bench.settled(&model, self.chain, &mut self.record)? else { break };
            let before = sorted(&model.active);
            model = self.search(&settled.active, settled.state, &|_| true);
            if sorted(&model.active) == before {
                break;
            }
        }
        state.point = model.state.point;
        if !model.active.is_empty() {
            state = self.weighed(&model.active, state);
            let tuned = tune(&self.bench.view(state), &model.active, 3, &mut self.record);
            model = self.search(&tuned, state, &|_| true);
        }
        if self.remembers && self.bench.memory_of(&model.active, state.noise, state.point).is_none() {
            // The causes explain what looked like memory.
            self.remembers = false;
            model = self.search(&model.active, state, &|_| true);
        }
        self.reach(model);
        Ok(())
    }

    /// The same without robust weights at first: a bump may be eaten as outliers.
    fn without_robust_weights(&mut self) {
        if self.bench.noises[self.bare].is_even() {
            return;
        }
        self.record.stage = Stage::Plain;
        let state = State { noise: 0, memory: None, point: self.best().state.point };
        let first = self.search(&Active::new(), state, &|_| true);
        if first.active.is_empty() {
            return;
        }
        let state = self.weighed(&first.active, state);
        let tuned = tune(&self.bench.view(state), &first.active, 3, &mut self.record);
        let second = self.search(&tuned, state, &|_| true);
        self.reach(second);
    }

    /// Set-ups along the order, as families that compete from now on.
    fn find_setups(&mut self) {
        let State { noise, point, .. } = self.best().state;
        self.cuts = self.bench.cuts(noise, point);
        if let Some(cuts) = &self.cuts {
            self.bench.add_cuts(cuts);
        }
    }

    /// Noise before causes: families of the noise, then memory, then causes beside them.
    fn noise_first(&mut self) {
        let best = self.best().clone();
        let mut noises = vec![best.state.noise];
        if self.bare != best.state.noise {
            noises.push(self.bare);
        }
        for noise in noises {
            self.record.stage = Stage::NoiseFirst;
            let state = State { noise, memory: None, point: best.state.point };
            let of_best = noise == best.state.noise;
            let only = self.search_noise(&Active::new(), state);
            self.reach(only.clone());
            if of_best && !only.active.is_empty() {
                let both = self.search(&only.active, state, &|_| true);
                self.reach(both);
            }
            self.record.stage = Stage::Memory;
            let mut starts = vec![Active::new(), only.active];
            if of_best {
                starts.push(best.active.clone());
            }
            self.with_memory(&starts, state, of_best);
        }
    }

    fn with_memory(&mut self, starts: &[Active], state: State, causes: bool) {
        let mut done: Vec<(State, Vec<usize>)> = Vec::new();
        for start in starts {
            let memory = self.bench.memory_of(start, state.noise, state.point);
            let mut state = State { memory, ..state };
            let key = (state, sorted(start));
            if memory.is_none() || done.contains(&key) {
                continue;
            }
            done.push(key);
            let tuned = Small::tuned(&self.bench, start, state, &mut self.record);
            let first = self.reach(Model { active: tuned, state, odds: f64::NAN });
            if first.odds < self.best().odds - HOPELESS {
                continue;
            }
            let noise = self.search_noise(&first.active, state);
            self.reach(noise.clone());
            if !causes {
                continue;
            }
            let mut all = self.search(&noise.active, state, &|_| true);
            let refitted = self.bench.memory_of(&all.active, state.noise, state.point);
            if refitted != memory {
                self.reach(all.clone());
                state.memory = refitted;
                let tuned = tune(&self.bench.view(state), &all.active, 3, &mut self.record);
                all = self.search(&tuned, state, &|_| true);
            }
            self.reach(all);
        }
    }

    /// Open functions against named laws and against shapes.
    fn name_shapes(&mut self) {
        let best = self.best().clone();
        if self.bench.causes(&best.active).is_empty() {
            return;
        }
        // Its odds under its own noise, as the rivals' below: all are judged in one state.
        let best = self.bench.model(best.active, best.state);
        self.record.stage = Stage::Unpack;
        let unpacked = self.bench.unpacked(&best, &mut self.record);
        let best = if unpacked.odds > best.odds {
            self.reach(unpacked.clone());
            unpacked
        } else {
            best
        };
        if !self.bench.dictionary.families.iter().any(Family::is_open) {
            return;
        }
        self.record.stage = Stage::Shapes;
        let shaped = self.bench.shaped(&best, &mut self.record);
        if shaped.active != best.active {
            self.reach(shaped.clone());
            let most = shaped.active.len() + 2;
            let grown = self.search_up_to(&shaped.active, shaped.state, &|_| true, most);
            self.reach(grown);
        }
    }

    /// The explanation that is told and how far each of its causes is ahead of the rivals without it. A rival that
    /// turns out better takes its place, and the margins are weighed anew.
    fn weigh_margins(&mut self) -> Result<(Model, Vec<Finding>), Error> {
        self.record.stage = Stage::Margins;
        let mut told = self.told_at_its_point()?;
        let mut found = Vec::new();
        for _ in 0..=ROUNDS {
            let before = self.best().odds;
            found = findings(self, &told)?;
            if self.best().odds <= before + SAME {
                break;
            }
            told = self.told_at_its_point()?;
        }
        Ok((told, found))
    }

    /// The explanation that is told once each that was ahead has been judged at its own point.
    fn told_at_its_point(&mut self) -> Result<Model, Error> {
        for _ in 0..=ROUNDS {
            let told = self.told();
            let Some(settled) = self.bench.settled(&told, self.chain, &mut self.record)? else {
                return Ok(told);
            };
            self.reached.retain(|model| *model != told);
            self.reach(settled);
        }
        Ok(self.told())
    }
}
