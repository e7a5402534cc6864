//! Cuttings of the order drawn with their posterior probability.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::sums::{Cuts, Sums};
use crate::bench::Bench;
use crate::policy::Policy;

/// Steps of the draws of cuts: before they count, counted, and from one that is kept to the next.
const SETTLING: usize = 200;
const DRAWN: usize = 1600;
const THINNED: usize = 8;

impl Bench<'_> {
    /// Cuts drawn with their posterior probability from the found ones on, each with the number of times it was drawn.
    ///
    /// Source: Green (1995), Reversible jump Markov chain Monte Carlo computation.
    pub(crate) fn drawn_cuts(&self, cuts: &Cuts, noise: usize, point: usize) -> Vec<(usize, Cuts)> {
        let pair = self.places.frames.iter().find_map(|frame| frame.tilts);
        let Some(sums) = pair.and_then(|pair| self.sums(noise, point, pair)) else { return Vec::new() };
        // What a cut gives back for not being known to the row is what drawing does by itself.
        let policy = Policy { cut_slack: 0.0, ..self.policy.clone() };
        let mut random = ChaCha8Rng::seed_from_u64(cuts.iter().fold(0, |seed, &cut| seed * 31 + cut as u64));
        let (mut here, mut score) = (cuts.clone(), sums.score(cuts, &policy));
        let mut drawn: Vec<(usize, Cuts)> = vec![(0, here.clone())];
        for step in 0..SETTLING + DRAWN {
            if let Some((next, log_ratio)) = sums.proposed(&here, &mut random, &policy) {
                let tried = sums.score(&next, &policy);
                if random.random::<f64>().ln() < tried - score + log_ratio {
                    (here, score) = (next, tried);
                }
            }
            if step >= SETTLING && step % THINNED == 0 {
                match drawn.iter_mut().find(|(_, known)| *known == here) {
                    Some((count, _)) => *count += 1,
                    None => drawn.push((1, here.clone())),
                }
            }
        }
        drawn.retain(|(count, _)| *count > 0);
        drawn
    }
}

impl Sums {
    /// A proposal of other cuts, with the logarithm of the ratio of proposals back and forth.
    fn proposed(&self, cuts: &Cuts, random: &mut ChaCha8Rng, policy: &Policy) -> Option<(Cuts, f64)> {
        let mut next = cuts.clone();
        let places = (self.rows - 1) as f64;
        let log_ratio = match random.random_range(0..4) {
            0 => {
                if (next.len() + 1) as f64 >= policy.most_setups {
                    return None;
                }
                next.push(random.random_range(1..self.rows));
                next.sort_unstable();
                places.ln() - (next.len() as f64).ln()
            }
            1 => {
                if next.is_empty() {
                    return None;
                }
                next.remove(random.random_range(0..cuts.len()));
                (cuts.len() as f64).ln() - places.ln()
            }
            _ => {
                if next.is_empty() {
                    return None;
                }
                let which = random.random_range(0..cuts.len());
                // Steps of all sizes: most cuts are known to a few rows, some to many.
                let size = 1 << random.random_range(0..5);
                let step = random.random_range(0..=2 * size);
                next[which] = (next[which] + step).checked_sub(size)?;
                0.0
            }
        };
        let ends: Vec<usize> = std::iter::once(0).chain(next.iter().copied()).chain([self.rows]).collect();
        ends.windows(2).all(|pair| pair[0] < pair[1]).then_some((next, log_ratio))
    }
}
