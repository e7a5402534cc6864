//! One round: the declaration with the effects accepted so far is fitted, and the search starts from there.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::SearchError;
use super::apart::apart;
use super::confounded::{SetColumns, SetId};
use super::context::{Context, Found};
use super::fitted::Fitted;
use super::stage::Stage;
use super::state::State;
use crate::search::search_problem::SearchProblem;
use crate::search::{Accepted, ConfoundedSet, HeldOut, Problem, Selection, confounded_sets, nested, select};
use effects::candidate::EffectId;

/// Degrees of freedom of a residual, and groups of its rows, below which nothing can be told of its structure.
const FEWEST: usize = 20;

/// An effect that stands out by so many standard deviations is hardly chance.
const SURE: f64 = 3.0;

/// What explains rows by effects of the catalogue.
pub(crate) trait Explains: Send + Sync {
    /// The effects that explain those of the rows that stay, one of these a row.
    fn of_rows(&self, stay: &[bool]) -> Vec<EffectId>;

    /// Whether it does so whatever the rows: somebody gave the effects.
    fn is_given(&self) -> bool {
        false
    }
}

/// A fit, and the search that starts from it.
pub(crate) struct Round<'a> {
    pub fitted: Fitted,
    pub search: SearchProblem<'a>,
    /// Effects that these data cannot tell apart.
    pub sets: Vec<ConfoundedSet>,
    /// What decided which effects there are; without it the search did.
    explained_by: Option<Arc<dyn Explains>>,
}

impl<'a> Round<'a> {
    /// At a fit.
    pub fn at(whole: &Context<'a>, fitted: Fitted) -> Result<Self, SearchError> {
        let search = SearchProblem::at(whole, &fitted)?;
        let sets = apart(confounded_sets(&search.problem), &fitted.found);
        Ok(Self { fitted, search, sets, explained_by: None })
    }

    /// At another fit, where the effects come from whatever gave those of this one.
    pub fn next(&self, whole: &Context<'a>, fitted: Fitted) -> Result<Self, SearchError> {
        Ok(Self { explained_by: self.explained_by.clone(), ..Self::at(whole, fitted)? })
    }

    /// The same, with its effects by `explains`, which may have weighed them anew.
    pub fn explained_by(self, explains: Arc<dyn Explains>) -> Self {
        let sets = apart(confounded_sets(&self.search.problem), &self.fitted.found);
        Self { explained_by: Some(explains), sets, ..self }
    }

    /// Whether somebody gave its effects: then nothing competes with them.
    pub fn is_given(&self) -> bool {
        self.explained_by.as_ref().is_some_and(|explains| explains.is_given())
    }

    /// Whether there are rows enough to tell structure of what is left from noise.
    pub fn tells_structure(&self) -> bool {
        let problem = self.search.of_rows();
        let of_set = |set: SetId| problem.columns(self.sets[set].members[0]).len();
        let columns: usize = self.accepted_sets().into_iter().map(of_set).sum();
        problem.groups() >= FEWEST && problem.rows().nrows() >= problem.declared() + columns + FEWEST
    }

    /// Whether there are rows enough to weigh causes, be they in few groups.
    pub fn has_rows_to_weigh(&self) -> bool {
        let problem = self.search.of_rows();
        let rows = self.search.rows.observations.rows();
        rows >= FEWEST && problem.rows().nrows() >= problem.declared() + FEWEST
    }

    /// How many observations an effect hangs on: the rows' share of its projected columns, as an effective number.
    pub fn observations_behind(&self, effect: EffectId) -> f64 {
        // What is stated of stations is there once, be the rows a sample of all.
        let share = if self.is_shown_by_stations(effect) { 1.0 } else { self.search.share() };
        share * self.search.rows.rows_behind(self.shares(effect))
    }

    /// Whether what is stated of stations shows an effect more than the rows do.
    pub fn is_shown_by_stations(&self, effect: EffectId) -> bool {
        let problem = self.search.of_rows();
        if problem.stated() == 0 {
            return false;
        }
        let (stated, of_rows): (Vec<_>, Vec<_>) =
            self.shares(effect).partition(|(component, _)| *component >= problem.first_stated());
        let sum = |own: Vec<(usize, f64)>| own.into_iter().map(|(_, share)| share).sum::<f64>();
        sum(stated) > sum(of_rows)
    }

    /// The station whose stated place alone decides an effect, where one does: without it the effect does not stand out any more.
    pub fn station_behind(&self, effect: EffectId) -> Option<u32> {
        let problem = self.search.of_rows();
        if !self.is_shown_by_stations(effect) {
            return None;
        }
        let unknowns = self.search.rows.observations.unknowns.as_ref();
        let stated = self.fitted.stated_of_stations(unknowns);
        let mut state = State::declared(problem, |_| true);
        for (number, _) in self.shown() {
            state.add(&problem.columns(self.fitted.found[number].effect));
        }
        let own = problem.columns(effect);
        let mut rows = problem.first_stated()..;
        let mut of_stations = stated.chunk_by(|a, b| a.station == b.station);
        let decisive = of_stations.find(|of| {
            let rows: Vec<usize> = rows.by_ref().take(of.len()).collect();
            state.standing_without(problem, &own, &rows) < SURE
        });
        decisive.map(|of| of[0].station)
    }

    /// The share that each component has in an effect's projected columns.
    fn shares(&self, effect: EffectId) -> impl Iterator<Item = (usize, f64)> + '_ {
        let problem = self.search.of_rows();
        let rows = problem.rows();
        problem.columns(effect).into_iter().flat_map(move |column| {
            (0..rows.nrows()).map(move |component| (component, rows[(component, column)].powi(2)))
        })
    }

    /// The confounded set that an effect belongs to.
    pub fn set_of(&self, effect: EffectId) -> Option<SetId> {
        self.sets.iter().position(|set| set.members.contains(&effect)).map(SetId)
    }

    /// The sets of the accepted effects.
    pub fn accepted_sets(&self) -> Vec<SetId> {
        self.shown().into_iter().map(|(_, set)| set).collect()
    }

    /// The accepted effects that these data still show: number among those found, and confounded set.
    pub fn shown(&self) -> Vec<(usize, SetId)> {
        let found = self.fitted.found.iter().enumerate();
        found.filter_map(|(number, found)| Some((number, self.set_of(found.effect)?))).collect()
    }

    /// Those of them of which the problem of functions has columns, by their number among those found, with those columns. Effects that what is
    /// stated of stations cannot tell from each other may differ without it: each has its own there.
    pub fn shown_to_functions(&self) -> Vec<(usize, Vec<usize>)> {
        let problem = self.search.of_functions();
        let columns = |(number, set): (usize, SetId)| {
            let tested = self.sets[set].members[0];
            let stated = self.search.of_rows().stated() > 0;
            let effect = if stated { self.fitted.found[number].effect } else { tested };
            Some((number, problem.columns(effect))).filter(|(_, own)| !own.is_empty())
        };
        self.shown().into_iter().filter_map(columns).collect()
    }

    /// The linear search from the accepted effects.
    pub fn selection(&self, whole: &Context<'_>) -> Selection {
        let start: Vec<Accepted> = self
            .fitted
            .found
            .iter()
            .filter_map(|found| Some(Accepted { set: self.set_of(found.effect)?, p_value: found.p_value }))
            .collect();
        select(&self.search.problem, &self.sets, &start, |_| true, &whole.options)
    }

    /// What is found anew without each fold.
    pub fn held_out(&self, whole: &Context<'_>) -> HeldOut {
        let problem = &self.search.problem;
        let (done, of) = (AtomicUsize::new(0), problem.folds());
        (whole.tell)(Stage::HeldOut { done: 0, of });
        nested(problem, |fold| {
            let found = self.repeated(whole, problem, |other| other != fold);
            (whole.tell)(Stage::HeldOut { done: 1 + done.fetch_add(1, Ordering::Relaxed), of });
            found
        })
    }

    /// What is found in some folds of a problem, and the regression with it.
    pub fn repeated(
        &self,
        whole: &Context<'_>,
        problem: &Problem,
        seen: impl Fn(usize) -> bool + Copy,
    ) -> (Vec<SetId>, State) {
        let Some(explains) = &self.explained_by else {
            let selection = select(problem, &self.sets, &[], seen, &whole.options);
            return (selection.accepted.iter().map(|accepted| accepted.set).collect(), selection.state);
        };
        let rows = &self.search.rows;
        let mut stay = vec![false; rows.observations.rows()];
        for component in problem.rows_of_folds(seen) {
            stay[rows.columns.row[component] as usize] = true;
        }
        let blocks = SetColumns::of(problem, &self.sets);
        let mut state = State::declared(problem, seen);
        let mut sets = Vec::new();
        for set in explains.of_rows(&stay).into_iter().filter_map(|effect| self.set_of(effect)) {
            if !sets.contains(&set) {
                state.add(&blocks[set]);
                sets.push(set);
            }
        }
        (sets, state)
    }

    /// What the search ends with: accepted effects keep their name and p, a new set lends its first member's.
    pub fn search(&self, whole: &Context<'_>) -> Vec<Found> {
        let kept = self.accepted_sets();
        self.selection(whole)
            .accepted
            .into_iter()
            .map(|accepted| match kept.iter().position(|&set| set == accepted.set) {
                Some(at) => self.fitted.found[at].clone(),
                None => {
                    let alike = self.sets[accepted.set].members.clone();
                    Found { effect: alike[0], p_value: accepted.p_value, alike, shares: Vec::new() }
                }
            })
            .collect()
    }
}
