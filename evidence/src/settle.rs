//! Linearising anew with what was found in the exact chain, where products of small quantities are not small.

use crate::bench::{Bench, Model};
use crate::error::Error;
use crate::linearise::{Linearise, checked};
use crate::record::Recorder;
use crate::small::Small;

impl Bench<'_> {
    /// The same explanation at its own point, where that differs by more than rounding from the one it was found at.
    pub fn settled(
        &mut self,
        model: &Model,
        chain: Option<&dyn Linearise>,
        record: &mut Recorder,
    ) -> Result<Option<Model>, Error> {
        let Some(chain) = chain else { return Ok(None) };
        let view = self.view(model.state);
        let Some(posterior) = view.posterior(&model.active) else { return Ok(None) };
        let deviation = (posterior.variance / view.inflation).sqrt();
        let first = 1 + view.declared;
        drop(view);
        let here = &self.points[model.state.point];
        let unit = self.scaling.unit;
        let mut estimates = here.estimates.clone();
        for (error, estimate) in estimates.iter_mut().enumerate() {
            for combination in 0..first - 1 {
                *estimate +=
                    unit * self.scaling.combinations[(error, combination)] * posterior.mean[combination];
            }
        }
        let mut inside: Vec<(usize, f64)> = Vec::new();
        let found = posterior.columns.iter().zip(&posterior.mean).skip(first - 1);
        for (&number, &mean) in found.filter(|&(&number, _)| !self.is_of_range(number - first)) {
            match inside.iter_mut().find(|(column, _)| *column == number - first) {
                Some((_, sum)) => *sum += mean,
                None => inside.push((number - first, mean)),
            }
        }
        let effects = self.amounts_of(&self.table, &inside);
        let given = checked(self.problem, chain.at(&estimates, &effects))?;
        let mut there = self.scaling.point(&self.places, &given, estimates);
        // What is left at the new point, against what the old point's straight line says.
        let rows = self.problem.rows.count;
        let small = self.table.some(here, &posterior.columns, rows);
        let mut second_order: f64 = 0.0;
        for (at, new) in there.residual.iter().enumerate() {
            let linear: f64 = (0..posterior.mean.len())
                .filter(|&k| posterior.columns[k] < first || !self.is_of_range(posterior.columns[k] - first))
                .map(|k| posterior.mean[k] * small[(at, k)])
                .sum();
            second_order += (here.residual[at] - linear - new).powi(2);
        }
        let second_order = (second_order / there.residual.len() as f64).sqrt();
        if second_order <= self.policy.relinearise * deviation {
            return Ok(None);
        }
        let mut buffer = vec![0.0; there.residual.len()];
        for &(column, mean) in &inside {
            self.table.column(&there, column, 0..rows, &mut buffer);
            for (value, column) in there.residual.iter_mut().zip(&buffer) {
                *value += mean * column;
            }
        }
        there.inside = inside;
        self.points.push(there);
        let state = crate::bench::State { point: self.points.len() - 1, ..model.state };
        let active = Small::tuned(self, &model.active, state, record);
        Ok(Some(Model { active, state, odds: f64::NAN }))
    }

    /// Whether a column changes the measured range, which is exactly linear and no part of the chain.
    fn is_of_range(&self, column: usize) -> bool {
        self.dictionary.columns[column].terms.iter().any(|(place, _)| self.places.distinct[*place].is_range)
    }
}
