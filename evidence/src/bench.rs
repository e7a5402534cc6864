//! The workbench of a contest: dictionary, points, kinds of noise, and the Gram matrices that belong to them.

use std::cell::RefCell;
use std::sync::Arc;

use crate::design::Table;
use crate::error::Error;
use crate::families::{Dictionary, Family};
use crate::gram::Gram;
use crate::likelihood::{Active, Scaled, View};
use crate::linearise::as_given;
use crate::noise::variance::Features;
use crate::noise::{Memory, Noise};
use crate::places::Places;
use crate::point::{Point, Scaling};
use crate::policy::Policy;
use crate::problem::Problem;

/// Gram matrices kept: a contest goes to and fro between a few kinds of noise.
const KEPT: usize = 8;

/// What a Gram matrix belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct State {
    /// Number of the noise's weights.
    pub noise: usize,
    /// Memory of the noise.
    pub memory: Option<Memory>,
    /// Number of the point of linearisation.
    pub point: usize,
}

/// An explanation: active families in a state.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Model {
    pub active: Active,
    pub state: State,
    /// Log evidence less prices.
    pub odds: f64,
}

impl Model {
    pub fn has(&self, family: usize) -> bool {
        self.active.iter().any(|&(own, _)| own == family)
    }
}

/// Everything that a contest works on.
pub(crate) struct Bench<'a> {
    pub problem: &'a Problem,
    pub policy: &'a Policy,
    pub places: Places,
    pub dictionary: Dictionary,
    pub table: Table,
    pub scaling: Scaling,
    pub features: Features,
    pub points: Vec<Point>,
    pub noises: Vec<Noise>,
    pub scaled: Vec<Scaled>,
    grams: RefCell<Vec<(State, Arc<Gram>)>>,
}

impl<'a> Bench<'a> {
    /// A workbench with the families that a caller lets compete.
    pub fn new(
        problem: &'a Problem,
        policy: &'a Policy,
        lets: &dyn Fn(&Family, &Places) -> bool,
    ) -> Result<Self, Error> {
        problem.check()?;
        let places = Places::of(problem, policy);
        let mut dictionary = Dictionary::of(problem, &places, policy);
        dictionary.keep(&|family| lets(family, &places));
        let scaling = Scaling::of(problem, policy)?;
        let estimates = problem.declared.iter().map(|error| error.estimate).collect();
        let points = vec![scaling.point(&places, &as_given(problem), estimates)];
        let mut bench = Self {
            problem,
            policy,
            features: Features::of(&problem.rows, &scaling.stated),
            places,
            dictionary,
            table: Table::default(),
            scaling,
            points,
            noises: vec![Noise::even(problem.values())],
            scaled: Vec::new(),
            grams: RefCell::default(),
        };
        bench.take_in();
        Ok(bench)
    }

    /// Takes in what the dictionary has gained: columns into the table, families with their scale.
    pub fn take_in(&mut self) {
        let (rows, given) = (&self.problem.rows, &self.problem.places);
        self.table.extend(&self.dictionary, rows, &self.places, given);
        let first = 1 + self.points[0].declared.len();
        for family in &self.dictionary.families[self.scaled.len()..] {
            let mut sizes: Vec<f64> = family.columns.iter().map(|&column| self.size(column)).collect();
            sizes.sort_by(f64::total_cmp);
            let middle = sizes.len() / 2;
            let median = if sizes.len().is_multiple_of(2) {
                f64::midpoint(sizes[middle - 1], sizes[middle])
            } else {
                sizes[middle]
            };
            // A family that moves nothing keeps its scale and is dropped by its energy.
            let median = if median > 0.0 { median } else { 1.0 };
            self.scaled.push(Scaled {
                columns: family.columns.iter().map(|column| first + column).collect(),
                deviations: family.relative.iter().map(|relative| relative / median).collect(),
                price: family.price,
                site: family.site(),
                is_noise: family.is_noise(),
            });
        }
    }

    /// RMS of a column at the first point.
    pub fn size(&self, column: usize) -> f64 {
        let mut values = vec![0.0; self.problem.values()];
        self.table.column(&self.points[0], column, 0..self.problem.rows.count, &mut values);
        (crate::algebra::dot(&values, &values) / values.len() as f64).sqrt()
    }

    pub fn is_noise(&self, family: usize) -> bool {
        self.dictionary.families[family].is_noise()
    }

    /// Numbers of the causes of an active set.
    pub fn causes(&self, active: &[(usize, f64)]) -> Vec<usize> {
        active.iter().map(|&(family, _)| family).filter(|&family| !self.is_noise(family)).collect()
    }

    /// The likelihood in a state.
    pub fn view(&self, state: State) -> View<'_> {
        View {
            gram: self.gram(state),
            families: &self.scaled,
            policy: self.policy,
            declared: self.points[0].declared.len(),
            freedom: self.scaling.freedom,
            inflation: self.noises[state.noise].inflation,
        }
    }

    /// An active set with its odds.
    pub fn model(&self, active: Active, state: State) -> Model {
        let view = self.view(state);
        let memory = if state.memory.is_some() { self.policy.price_memory } else { 0.0 };
        let odds =
            view.log_evidence(&active) - view.price(&active) - memory + self.noises[state.noise].adjust;
        Model { active, state, odds }
    }

    fn gram(&self, state: State) -> Arc<Gram> {
        let (point, noise, rows) =
            (&self.points[state.point], &self.noises[state.noise], self.problem.rows.count);
        let mut grams = self.grams.borrow_mut();
        let width = self.table.width(point);
        let known = grams.iter().position(|(of, _)| *of == state).map(|at| grams.remove(at).1);
        let gram = match known {
            Some(gram) if gram.products.ncols() == width => gram,
            Some(gram) => Arc::new(gram.grown(&self.table, point, rows, noise, state.memory)),
            None => Arc::new(Gram::of(&self.table, point, rows, noise, state.memory)),
        };
        if grams.len() >= KEPT {
            grams.remove(0);
        }
        grams.push((state, Arc::clone(&gram)));
        gram
    }

    /// Numbers in [y J Z] of residual, declared errors and the columns of an active set.
    pub fn active_columns(&self, active: &[(usize, f64)]) -> Vec<usize> {
        let first = 1 + self.points[0].declared.len();
        let own = active.iter().flat_map(|&(family, _)| self.scaled[family].columns.iter().copied());
        (0..first).chain(own).collect()
    }
}
