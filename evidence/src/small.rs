//! An active set by itself: its columns over all rows, for what weighs rows or changes the correlation.

use std::sync::Arc;

use faer::Mat;

use crate::algebra::{column, column_mut, products};
use crate::bench::{Bench, State};
use crate::gram::Gram;
use crate::greedy::tune;
use crate::likelihood::{Active, Scaled, View};
use crate::noise::{Memory, Noise};
use crate::policy::{MEMORY, PART};
use crate::record::Recorder;
use crate::setups::Cuts;

/// The columns of an active set, with its families renumbered.
pub(crate) struct Small<'a> {
    bench: &'a Bench<'a>,
    /// Residual, declared errors and active columns, without weights.
    pub columns: Mat<f64>,
    families: Vec<Scaled>,
    active: Active,
}

impl<'a> Small<'a> {
    pub fn of(bench: &'a Bench<'a>, active: &[(usize, f64)], point: usize) -> Self {
        let numbers = bench.active_columns(active);
        let columns = bench.table.some(&bench.points[point], &numbers, bench.problem.rows.count);
        let mut next = 1 + bench.points[0].declared.len();
        let mut families = Vec::with_capacity(active.len());
        for &(family, _) in active {
            let given = &bench.scaled[family];
            let size = given.columns.len();
            families.push(Scaled { columns: (next..next + size).collect(), ..given.clone() });
            next += size;
        }
        let active = (0..).zip(active.iter().map(|&(_, variance)| variance)).collect();
        Self { bench, columns, families, active }
    }

    /// An active set with the found set-ups of one family cut in another way.
    pub fn with_cuts(
        bench: &'a Bench<'a>,
        others: &[(usize, f64)],
        point: usize,
        family: usize,
        variance: f64,
        cuts: &Cuts,
    ) -> Self {
        let mut small = Self::of(bench, others, point);
        let given = &bench.dictionary.families[family];
        let mut members: Vec<usize> = Vec::new();
        for &column in &given.columns {
            let place = bench.dictionary.columns[column].terms[0].0;
            if !members.contains(&place) {
                members.push(place);
            }
        }
        let (rows, components) = (bench.problem.rows.count, bench.problem.components);
        let ends: Vec<usize> = std::iter::once(0).chain(cuts.iter().copied()).chain([rows]).collect();
        let from = small.columns.ncols();
        let count = members.len() * (ends.len() - 1);
        let moved = |at: usize| &bench.points[point].places[members[at / (ends.len() - 1)]];
        let added = Mat::from_fn(rows * components, count, |row, at| {
            let stretch = at % (ends.len() - 1);
            let inside = (ends[stretch]..ends[stretch + 1]).contains(&(row / components));
            if inside { moved(at)[row] } else { 0.0 }
        });
        small.columns = Mat::from_fn(rows * components, from + count, |row, at| {
            if at < from { small.columns[(row, at)] } else { added[(row, at - from)] }
        });
        let deviation = bench.scaled[family].deviations[0];
        let deviations = vec![deviation; count];
        small.families.push(Scaled {
            columns: (from..from + count).collect(),
            deviations,
            ..bench.scaled[family].clone()
        });
        small.active.push((small.families.len() - 1, variance));
        small
    }

    /// The likelihood of the active set under a noise.
    pub fn view(&self, noise: &Noise, memory: Option<Memory>) -> View<'_> {
        let problem = self.bench.problem;
        let white = whitened(&self.columns, problem.components, &noise.weights, memory);
        let log_det = noise.log_det(memory, problem.rows.count, problem.components);
        View {
            gram: Arc::new(Gram { products: products(&white), log_det }),
            families: &self.families,
            policy: self.bench.policy,
            declared: self.bench.points[0].declared.len(),
            freedom: self.bench.scaling.freedom,
            inflation: noise.inflation,
        }
    }

    /// The active set in this numbering.
    pub fn active(&self) -> &[(usize, f64)] {
        &self.active
    }

    /// An active set with its variances optimised in a state, without the Gram matrix of the whole dictionary.
    pub fn tuned(bench: &Bench, active: &[(usize, f64)], state: State, record: &mut Recorder) -> Active {
        let small = Small::of(bench, active, state.point);
        let view = small.view(&bench.noises[state.noise], state.memory);
        let mut steps = Recorder::new();
        let kept = tune(&view, small.active(), 3, &mut steps);
        for step in steps.steps {
            record.note(active[step.family].0, step.came, step.reason, step.score);
        }
        kept.into_iter().map(|(local, variance)| (active[local].0, variance)).collect()
    }

    /// Residual of each value at the posterior mean, without weights; the given one where there is no posterior.
    pub fn residual(&self, noise: &Noise) -> Vec<f64> {
        let view = self.view(noise, None);
        let mut residual = column(&self.columns, 0).to_vec();
        if let Some((columns, means)) = view.mean(&self.active) {
            for (&number, mean) in columns.iter().zip(&means) {
                for (value, own) in residual.iter_mut().zip(column(&self.columns, number)) {
                    *value -= mean * own;
                }
            }
        }
        residual
    }

    fn evidence(&self, noise: &Noise, memory: Option<Memory>) -> f64 {
        self.view(noise, memory).log_evidence(&self.active)
    }

    /// Log evidence with each memory of the grid.
    pub fn memories(&self, noise: &Noise) -> Vec<(f64, Memory)> {
        let all = MEMORY.iter().flat_map(|&carried| PART.map(|part| Memory { carried, part }));
        all.map(|memory| (self.evidence(noise, Some(memory)), memory)).collect()
    }

    /// Log evidence without memory, and with the likeliest of the grid: of every second value, then of those beside the best.
    pub fn best_memory(&self, noise: &Noise) -> (f64, f64, Memory) {
        let at = |[carried, part]: [usize; 2]| {
            let memory = Memory { carried: MEMORY[carried], part: PART[part] };
            (self.evidence(noise, Some(memory)), memory)
        };
        let coarse: Vec<[usize; 2]> = (1..MEMORY.len())
            .step_by(2)
            .flat_map(|carried| (1..PART.len()).step_by(2).map(move |part| [carried, part]))
            .collect();
        let mut best = (f64::NEG_INFINITY, [1, 1], Memory { carried: MEMORY[1], part: PART[1] });
        let take = |place: [usize; 2], best: &mut (f64, [usize; 2], Memory)| {
            let (evidence, memory) = at(place);
            if evidence > best.0 {
                *best = (evidence, place, memory);
            }
        };
        coarse.iter().for_each(|&place| take(place, &mut best));
        let [carried, part] = best.1;
        for carried in carried.saturating_sub(1)..(carried + 2).min(MEMORY.len()) {
            for part in part.saturating_sub(1)..(part + 2).min(PART.len()) {
                if !coarse.contains(&[carried, part]) {
                    take([carried, part], &mut best);
                }
            }
        }
        (self.evidence(noise, None), best.0, best.2)
    }
}

impl Bench<'_> {
    /// RMS of the last family's effect at the posterior mean, without weights.
    pub fn shown(&self, active: &[(usize, f64)], state: State) -> Option<f64> {
        let (numbers, mean) = self.view(state).mean(active)?;
        let own = self.scaled[active.last()?.0].columns.len();
        let first = numbers.len() - own;
        let columns = self.table.some(&self.points[state.point], &numbers[first..], self.problem.rows.count);
        let value = |row: usize| (0..own).map(|at| columns[(row, at)] * mean[first + at]).sum::<f64>();
        let squares: f64 = (0..columns.nrows()).map(|row| value(row).powi(2)).sum();
        Some((squares / columns.nrows() as f64).sqrt())
    }
}

/// Columns after whitening.
pub(crate) fn whitened(
    columns: &Mat<f64>,
    components: usize,
    weights: &[f64],
    memory: Option<Memory>,
) -> Mat<f64> {
    let mut white = Mat::zeros(columns.nrows(), columns.ncols());
    let filter = memory.map(|memory| memory.filter(weights.len() / components));
    for at in 0..columns.ncols() {
        let values = column_mut(&mut white, at);
        for ((value, own), weight) in values.iter_mut().zip(column(columns, at)).zip(weights) {
            *value = own * weight;
        }
        if let Some(filter) = &filter {
            filter.apply(0, values, &mut vec![0.0; components]);
        }
    }
    white
}
