//! One fit in progress: what it is of, where it is, and what all rows say there.

use std::cell::OnceCell;
use std::sync::Arc;

use model_core::{Chain, SymbolId, SymbolKind};
use rayon::prelude::*;

use super::normal::Rest;
use super::objects::Eliminated;
use super::reference::Inputs;
use super::size::Size;
use super::sweep::{Sweep, Weighting, residuals, sweep};
use super::turns::home;
use super::{FitError, FitOptions, Model, Partial, Reason, Subspace};
use crate::noise::{self, Layout, Noise};
use observe::Observations;
use observe::unknowns::Unknowns;

/// Rows at least that one processor looks through.
const AT_ONCE: usize = 4096;

/// Components from which on a pass takes long.
pub(super) const LONG: f64 = 100_000.0;

/// One fit in progress.
pub(super) struct Solver<'a> {
    pub chain: &'a Chain,
    pub observations: &'a Observations,
    pub options: &'a FitOptions,
    pub model: Model,
    /// The same without derivatives, once it is needed.
    pub plain: OnceCell<Model>,
    pub layout: Layout,
    /// Rows that count for nothing, where they are few and chosen one by one; empty where all may count.
    pub aside: Vec<bool>,
    /// Per component what uncertain readings bring, rad or m, where the course began; empty where all are exact.
    pub brought: Vec<f64>,
    /// How large a parameter may be that the data do not show.
    pub prior_sizes: Vec<Size>,
    /// What is unknown of the reference beside the errors, where anything is stated of it.
    pub inputs: Option<Inputs>,
    pub iterations: usize,
}

/// Where the solver is: values, and what all rows say there.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub values: Vec<f64>,
    pub sweep: Sweep,
    /// What becomes of the combinations that the data do not determine.
    pub rest: Rest,
}

impl Point {
    /// What the steps make smaller.
    pub fn objective(&self) -> f64 {
        self.sweep.tally.objective + self.rest.objective()
    }
}

/// A way downhill: where it is, and what it is downhill of.
#[derive(Debug, Clone)]
pub(super) struct Course {
    pub point: Point,
    pub noise: Arc<Noise>,
    pub subspace: Subspace,
    pub weighting: Weighting,
    /// Why it ended before steps were negligible, if it did.
    pub stopped: Option<Reason>,
}

impl Solver<'_> {
    /// All rows at some values. Serial correlation has no part in it: estimates that do not lean on it stay right when
    /// what looks like memory is an effect that the chain lacks. It enters the uncertainties.
    pub(super) fn sweep(
        &self,
        values: &[f64],
        noise: &Noise,
        weighting: Weighting,
    ) -> Result<Sweep, FitError> {
        self.sweep_without(&self.aside, values, noise, weighting)
    }

    /// The same without some rows, one flag a row.
    pub(super) fn sweep_without(
        &self,
        aside: &[bool],
        values: &[f64],
        noise: &Noise,
        weighting: Weighting,
    ) -> Result<Sweep, FitError> {
        let sigma = noise.sigma_without_memory();
        sweep(&self.model, self.observations, &self.layout, values, &sigma, weighting, aside)
    }

    pub(super) fn point(
        &self,
        values: Vec<f64>,
        noise: &Noise,
        weighting: Weighting,
        rest: Rest,
    ) -> Result<Point, FitError> {
        let sweep = self.sweep(&values, noise, weighting)?;
        Ok(Point { values, sweep, rest })
    }

    /// Values with the numbers of objects and stations behind them: zero, as they count from where they are taken to be.
    pub(super) fn with_state(&self, mut values: Vec<f64>) -> Vec<f64> {
        let unknown = self.observations.unknowns.as_ref().map_or(0, Unknowns::numbers);
        values.resize(self.chain.symbols.len() + unknown, 0.0);
        values
    }

    pub(super) fn nominal(&self) -> Vec<f64> {
        self.with_state(self.chain.nominal_values())
    }

    /// The values after a step that was made `stride` times as long; objects and stations follow the errors.
    pub(super) fn moved(&self, from: &Point, change: &[f64], stride: f64) -> Vec<f64> {
        let mut values = from.values.clone();
        let mut by_column = vec![0.0; self.model.columns()];
        for ((parameter, change), column) in
            self.model.parameters().iter().zip(change).zip(self.model.column_of())
        {
            values[parameter.index()] += change;
            if let Some(column) = *column {
                by_column[column] += change;
            }
        }
        if let Some(eliminated) = &from.sweep.eliminated {
            let state = eliminated.moved(self.model.state(&from.values), &by_column, stride);
            values.truncate(self.chain.symbols.len());
            values.extend(state);
        }
        values
    }

    pub fn partial(&self, sweep: &Sweep) -> Partial {
        sweep.tally.partial.spread(self.model.column_of())
    }

    /// What the data determine: every error at zero, an angle at whole quarter turns, constants where they are. Of an anchored fit, what they tell more of
    /// than the sizes do, where the errors are: only there are residuals no larger than the noise.
    pub(super) fn determined(&self, values: &[f64], noise: &Noise) -> Result<Subspace, FitError> {
        let model = self.model.for_determination();
        let sigma = noise.sigma_without_memory();
        let swept = |values: &[f64]| {
            let (observations, layout) = (self.observations, &self.layout);
            sweep(&model, observations, layout, values, &sigma, Weighting::Full, &self.aside)
        };
        if self.options.anchored {
            let partial = self.partial(&swept(values)?);
            return Ok(Subspace::beyond(&partial, self.first_sizes()));
        }
        let homes = self.homes_at(values);
        let mut values = values.to_vec();
        for (&parameter, home) in self.model.parameters().iter().zip(&homes) {
            if self.chain.symbol(parameter).kind == SymbolKind::Error {
                values[parameter.index()] = *home;
            }
        }
        let partial = self.partial(&swept(&values)?);
        Ok(Subspace::determined(&partial, self.first_sizes()).at(homes))
    }

    /// The whole quarter turns of each parameter at some values, rad.
    pub(super) fn homes_at(&self, values: &[f64]) -> Vec<f64> {
        // Directions tell how far off they are, and have other starts.
        let are_directions = self.tell_far_off();
        let of = |&id: &SymbolId| if are_directions { 0.0 } else { home(self.chain, id, values[id.index()]) };
        self.model.parameters().iter().map(of).collect()
    }

    /// Whether what the data determine hangs on where a course ended: not on errors, which are zero where it is asked.
    pub(super) fn determined_by_values(&self) -> bool {
        let is_error = |&id: &SymbolId| self.chain.symbol(id).kind == SymbolKind::Error;
        self.options.anchored || !self.model.parameters().iter().all(is_error)
    }

    /// Whether an angle has another home than where the data were asked. An anchored fit asks where the errors are.
    pub(super) fn has_turned(&self, course: &Course) -> bool {
        !self.options.anchored && self.homes_at(&course.point.values) != course.subspace.homes()
    }

    /// How far each parameter is from where it is expected, SI: an error from zero, an angle from its whole quarter turns, a constant from its
    /// nominal value.
    pub(super) fn deviation(&self, values: &[f64], subspace: &Subspace) -> Vec<f64> {
        let parameters = self.model.parameters().iter().zip(self.expected(subspace));
        parameters.map(|(id, expected)| values[id.index()] - expected).collect()
    }

    /// Where each parameter is expected.
    fn expected(&self, subspace: &Subspace) -> Vec<f64> {
        let nominal = self.chain.nominal_values();
        let parameters = self.model.parameters().iter().zip(subspace.homes());
        parameters.map(|(id, home)| nominal[id.index()] + home).collect()
    }

    /// Values that the data cannot tell from these to first order, as near as can be to where they are expected.
    pub(super) fn with_smallest(&self, values: &[f64], subspace: &Subspace) -> Vec<f64> {
        let smallest = subspace.smallest(&self.deviation(values, subspace));
        let mut values = values.to_vec();
        let expected = self.expected(subspace).into_iter().zip(smallest);
        for (parameter, (expected, deviation)) in self.model.parameters().iter().zip(expected) {
            values[parameter.index()] = expected + deviation;
        }
        values
    }

    pub(super) fn first_noise(&self, values: &[f64]) -> Result<Noise, FitError> {
        // A noise that is known has no use for residuals.
        let residual = match self.options.noise.known() {
            Some(_) => Vec::new(),
            None => residuals(self.plain(), self.observations, values)?,
        };
        Ok(self.noise_of(&residual))
    }

    /// Floors from the medians of residuals.
    pub(super) fn noise_of(&self, residual: &[f64]) -> Noise {
        noise::from_medians(&self.options.noise, self.observations, &self.layout, residual, &self.brought)
    }

    /// The logarithm of how large residuals are by their medians, the mean over all components.
    pub(super) fn ln_scale(&self, residual: &[f64]) -> f64 {
        noise::ln_scale(self.observations, &self.layout, residual)
    }

    /// The same of a course.
    pub(super) fn scale(&self, course: &Course) -> f64 {
        self.ln_scale(&course.point.sweep.residual)
    }

    /// Per row the norm of its whitened components and its weight; rows without a value have none.
    pub(super) fn norms_and_weights(&self, course: &Course) -> (Vec<f64>, Vec<f64>) {
        let sigma = course.noise.sigma_without_memory();
        let (layout, aside, sweep, weighting) =
            (&self.layout, &self.aside, &course.point.sweep, course.weighting);
        let of_row = |row: usize| {
            let own = layout.of_rows(row..row + 1);
            let white = sweep.residual[own.clone()].iter().zip(&sigma[own.clone()]);
            let norm = white.map(|(residual, sigma)| (residual / sigma).powi(2)).sum::<f64>().sqrt();
            let counts = sweep.defined[row] && aside.get(row) != Some(&true);
            (norm, if counts { weighting.weight(norm, own.len()) } else { 0.0 })
        };
        (0..layout.rows()).into_par_iter().with_min_len(AT_ONCE).map(of_row).unzip()
    }

    /// The residual at the end of a course, whitened but for memory, each row times its weight.
    pub(super) fn whitened(&self, course: &Course, weight: &[f64]) -> Vec<f64> {
        let (sigma, layout) = (course.noise.sigma_without_memory(), &self.layout);
        let residual = course.point.sweep.residual.par_iter().zip(&*sigma).enumerate();
        residual.map(|(at, (residual, sigma))| residual * weight[layout.row(at)] / sigma).collect()
    }

    /// The number of components of rows with weight.
    pub(super) fn kept_components(&self, weight: &[f64]) -> usize {
        self.layout.row_of_each().filter(|&row| weight[row] > 0.0).count()
    }

    /// What rows observe, and what was eliminated of it in a sweep; none where they observe no objects.
    pub(super) fn objects<'s>(&'s self, sweep: &'s Sweep) -> Option<(&'s Unknowns, &'s Eliminated)> {
        self.observations.unknowns.as_ref().zip(sweep.eliminated.as_ref())
    }

    /// How many independent numbers of the data the estimates use up.
    pub(super) fn used(&self, course: &Course) -> f64 {
        let sweep = &course.point.sweep;
        let of_objects = sweep.eliminated.as_ref().map_or(0.0, |eliminated| eliminated.taken);
        let of_reference = self.inputs.as_ref().map_or(0.0, |inputs| inputs.used);
        of_objects + of_reference + course.subspace.used(&self.partial(sweep), &course.point.rest)
    }
}

/// Whether two noise models weigh components alike, up to some share.
pub(super) fn same(a: &Noise, b: &Noise, share: f64) -> bool {
    let close = |x: f64, y: f64| (x - y).abs() <= share * y.abs();
    a.sigma.len() == b.sigma.len() && a.sigma.iter().zip(&b.sigma).all(|(&x, &y)| close(x, y))
}
