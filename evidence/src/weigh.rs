//! The noise around an explanation: weights of its residual, and the memory that it leaves.

use crate::bench::{Bench, State};
use crate::likelihood::Active;
use crate::noise::tails::Tails;
use crate::noise::{Memory, Noise};
use crate::small::Small;

/// Rounds of variance and tails; each changes the other less.
const ROUNDS: usize = 6;
/// Largest change of a weight's logarithm at which the rounds end.
const SETTLED: f64 = 0.02;

impl Bench<'_> {
    /// The number of the noise that an active set leaves at a point: a known one where it is the same.
    pub fn add_noise_of(&mut self, active: &Active, point: usize) -> usize {
        let noise = self.noise_of(active, point);
        let same = |known: &Noise| {
            let close = |(a, b): (&f64, &f64)| (a / b).ln().abs() < SETTLED;
            known.tails == noise.tails && known.weights.iter().zip(&noise.weights).all(close)
        };
        self.noises.iter().position(same).unwrap_or_else(|| {
            self.noises.push(noise);
            self.noises.len() - 1
        })
    }

    /// Log evidence less prices of an active set under a noise that it left itself.
    ///
    /// The weights of t are those at which weighted squares and the t-density touch, so that the likelihood is whole.
    pub fn own_odds(&self, active: &Active, state: State) -> f64 {
        let noise = &self.noises[state.noise];
        let small = Small::of(self, active, state.point);
        let view = small.view(noise, state.memory);
        let memory = if state.memory.is_some() { self.policy.price_memory } else { 0.0 };
        view.log_evidence(small.active()) - view.price(small.active()) - memory + noise.adjust
    }

    /// The noise that an active set leaves at a point.
    pub fn noise_of(&self, active: &Active, point: usize) -> Noise {
        let (rows, components) = (self.problem.rows.count, self.problem.components);
        let mut noise = Noise::even(self.problem.values());
        if (rows as f64) < self.policy.rows_for_weights {
            return noise;
        }
        let small = Small::of(self, active, point);
        let mut row_weights = vec![1.0; rows];
        for _ in 0..ROUNDS {
            let residual = small.residual(&noise);
            let deviations = self.features.deviations(&residual, &row_weights, self.policy);
            let scaled: Vec<f64> = residual.iter().zip(&deviations.values).map(|(r, h)| r / h).collect();
            let squares: Vec<f64> =
                scaled.chunks_exact(components).map(|row| row.iter().map(|r| r * r).sum()).collect();
            let tails = Tails::of(&squares, components, self.policy);
            let weights: Vec<f64> = deviations
                .values
                .iter()
                .enumerate()
                .map(|(at, h)| tails.weights[at / components].sqrt() / h)
                .collect();
            let moved = weights
                .iter()
                .zip(&noise.weights)
                .fold(0.0, |most: f64, (a, b)| most.max((a / b).ln().abs()));
            row_weights = tails.weights;
            noise = Noise {
                weights,
                tails: tails.degrees,
                adjust: tails.adjust - deviations.price,
                inflation: tails.inflation,
            };
            if moved < SETTLED {
                break;
            }
        }
        noise
    }

    /// The memory that an active set leaves, where it gains enough.
    pub fn memory_of(&self, active: &Active, noise: usize, point: usize) -> Option<Memory> {
        if !self.problem.rows.in_order || (self.problem.rows.count as f64) < self.policy.rows_for_order {
            return None;
        }
        let (without, with, memory) = Small::of(self, active, point).best_memory(&self.noises[noise]);
        (with > without + self.policy.price_memory).then_some(memory)
    }
}
