//! Set-ups that nobody labelled: where along the order the instrument was moved, each stretch with tilts of its own.

use std::ops::Range;

use faer::Mat;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use statrs::function::gamma::ln_gamma;

use crate::algebra::{cholesky, dot, half_log_det, solve_lower, solve_upper};
use crate::bench::Bench;
use crate::families::{FEWEST_ROWS, Law, Where, add_setups};
use crate::function::Function;
use crate::policy::Policy;

/// Variances of a stretch's tilts over the noise that the first cuts try, and those that judge a set of cuts.
const FIRST: [f64; 4] = [1.0, 4.0, 16.0, 64.0];
const JUDGED: [f64; 3] = [2.0, 16.0, 64.0];
/// Fewest rows of a stretch.
const SHORTEST: usize = 3;
/// Nodes along the order that the first cuts may take, and places at which one more cut is tried.
const NODES: usize = 250;
const TRIED: usize = 66;
/// Steps of the draws of cuts: before they count, counted, and from one that is kept to the next.
const SETTLING: usize = 200;
const DRAWN: usize = 1600;
const THINNED: usize = 8;

/// The rows at which stretches begin, without the first.
pub(crate) type Cuts = Vec<usize>;

/// Sums along the order from which every stretch's products follow.
struct Sums {
    rows: usize,
    /// Tilt columns with tilt columns: 3 sums (xx, xy, yy).
    tilts: Vec<[f64; 3]>,
    /// Tilt columns with the residual behind the declared errors.
    residual: Vec<[f64; 2]>,
    /// Tilt columns with orthonormal declared columns, two for each.
    declared: Vec<Vec<f64>>,
    /// Energy of the residual behind the declared errors.
    energy: f64,
    freedom: f64,
}

/// Log price of so many stretches of so many rows, nats.
pub(crate) fn price(rows: usize, stretches: usize, policy: &Policy) -> f64 {
    let (n, k) = (rows as f64, stretches as f64);
    let places = ln_gamma(n) - ln_gamma(k) - ln_gamma(n - k + 1.0);
    places - policy.cut_slack * (k - 1.0) + k.ln()
}

impl Bench<'_> {
    /// Cuts of the order into stretches, and how much they gain; none where one stretch explains the rows as well.
    pub(crate) fn cuts(&self, noise: usize, point: usize) -> Option<Cuts> {
        let rows = self.problem.rows.count;
        if !self.problem.rows.in_order || rows < FEWEST_ROWS || self.problem.rows.labels.is_some() {
            return None;
        }
        let pair = self.places.frames.iter().find_map(|frame| frame.tilts)?;
        let sums = self.sums(noise, point, pair)?;
        let mut first = sums.first(&sums.residual, sums.energy / sums.freedom, self.policy)?;
        if !first.1.is_empty() {
            // Once more with the declared errors fitted beside the stretches, which takes from them what is not theirs.
            let (residual, variance) = sums.refitted(&first.1, first.0)?;
            first = sums.first(&residual, variance, self.policy)?;
        }
        let cuts = sums.improved(first.1, self.policy);
        (!cuts.is_empty()).then_some(cuts)
    }

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

    /// Adds the families of found set-ups: one a place, and one for both tilts of a frame.
    pub(crate) fn add_cuts(&mut self, cuts: &Cuts) -> Vec<usize> {
        let few = self.problem.rows.joints.len() as f64 <= self.policy.few_joints;
        let rows = self.problem.rows.count;
        let places = self.places.distinct.iter().enumerate().filter(|(_, place)| {
            !place.is_range && if few { place.turns } else { place.at_base }
        });
        let mut all: Vec<(Where, Vec<usize>)> =
            places.map(|(number, _)| (Where::Place(number), vec![number])).collect();
        let frames = self.places.frames.iter().filter(|frame| few || frame.frame == 0);
        all.extend(frames.filter_map(|frame| Some((Where::Tilts(frame.frame), frame.tilts?.to_vec()))));
        let functions = stretches(cuts, rows);
        let price = (all.len() as f64).ln() + price(rows, functions.len(), self.policy);
        let law = Law::Setups(functions.len());
        let added = all
            .iter()
            .map(|(place, members)| add_setups(&mut self.dictionary, *place, members, &functions, law, price))
            .collect();
        self.take_in();
        added
    }

    fn sums(&self, noise: usize, point: usize, pair: [usize; 2]) -> Option<Sums> {
        let (point, noise) = (&self.points[point], &self.noises[noise]);
        let (rows, m) = (self.problem.rows.count, self.problem.components);
        let weighed = |column: &[f64]| -> Vec<f64> {
            column.iter().zip(&noise.weights).map(|(value, weight)| value * weight).collect()
        };
        let declared: Vec<Vec<f64>> = point.declared.iter().map(|column| weighed(column)).collect();
        let k = declared.len();
        let products = Mat::from_fn(k, k, |a, b| dot(&declared[a], &declared[b]));
        let factor = cholesky(&products)?;
        // Orthonormal columns: L⁻¹ J′, row by row.
        let mut orthonormal = Mat::from_fn(k, rows * m, |a, at| declared[a][at]);
        solve_lower(factor.as_ref(), orthonormal.as_mut());
        let mut residual = weighed(&point.residual);
        let along: Vec<f64> =
            (0..k).map(|a| (0..rows * m).map(|at| orthonormal[(a, at)] * residual[at]).sum()).collect();
        for (at, value) in residual.iter_mut().enumerate() {
            *value -= (0..k).map(|a| along[a] * orthonormal[(a, at)]).sum::<f64>();
        }
        let mut tilts = pair.map(|place| weighed(&point.places[place]));
        let size = (tilts.iter().map(|tilt| dot(tilt, tilt)).sum::<f64>() / (2 * rows * m) as f64).sqrt();
        tilts.iter_mut().flatten().for_each(|value| *value /= size);
        let mut sums = Sums {
            rows,
            tilts: vec![[0.0; 3]],
            residual: vec![[0.0; 2]],
            declared: vec![vec![0.0; 2 * k]],
            energy: dot(&residual, &residual),
            freedom: self.scaling.freedom,
        };
        for row in 0..rows {
            let (mut own, mut with, mut beside) =
                (sums.tilts[row], sums.residual[row], sums.declared[row].clone());
            for at in row * m..(row + 1) * m {
                let (x, y) = (tilts[0][at], tilts[1][at]);
                own = [own[0] + x * x, own[1] + x * y, own[2] + y * y];
                with = [with[0] + x * residual[at], with[1] + y * residual[at]];
                for a in 0..k {
                    beside[2 * a] += x * orthonormal[(a, at)];
                    beside[2 * a + 1] += y * orthonormal[(a, at)];
                }
            }
            sums.tilts.push(own);
            sums.residual.push(with);
            sums.declared.push(beside);
        }
        Some(sums)
    }
}

/// The indicator of each stretch.
pub(crate) fn stretches(cuts: &Cuts, rows: usize) -> Vec<Function> {
    let from = std::iter::once(0).chain(cuts.iter().copied());
    let to = cuts.iter().copied().chain(std::iter::once(rows));
    from.zip(to).map(|(from, to)| Function::Stretch(from, to)).collect()
}

impl Sums {
    /// The best cuts with the declared errors held where they are, by dynamic programming over the order, and the
    /// variance of a stretch's tilts that suits them. None where there are too many.
    ///
    /// Source: Bellman (1961), On the approximation of curves by line segments using dynamic programming.
    fn first(&self, residual: &[[f64; 2]], variance: f64, policy: &Policy) -> Option<(f64, Cuts)> {
        let step = self.rows.div_ceil(NODES);
        let mut nodes: Vec<usize> = (0..self.rows).step_by(step).collect();
        nodes.push(self.rows);
        let change = (self.rows as f64).ln();
        let mut best: Option<(f64, f64, Cuts)> = None;
        for ratio in FIRST {
            let mut reached = vec![(f64::NEG_INFINITY, 0); nodes.len()];
            reached[0].0 = change;
            for end in 1..nodes.len() {
                for start in 0..end {
                    if nodes[end] - nodes[start] < SHORTEST || !reached[start].0.is_finite() {
                        continue;
                    }
                    let score = reached[start].0 - change + self.stretch(residual, nodes[start]..nodes[end], ratio, variance);
                    if score > reached[end].0 {
                        reached[end] = (score, start);
                    }
                }
            }
            let score = reached[nodes.len() - 1].0;
            if score.is_finite() && best.as_ref().is_none_or(|(most, ..)| score > *most) {
                let (mut cuts, mut at) = (Vec::new(), nodes.len() - 1);
                while at > 0 {
                    at = reached[at].1;
                    if at > 0 {
                        cuts.push(nodes[at]);
                    }
                }
                cuts.reverse();
                best = Some((score, ratio, cuts));
            }
        }
        let (_, ratio, cuts) = best?;
        ((cuts.len() as f64) < policy.most_setups).then_some((ratio, cuts))
    }

    /// Log evidence of one stretch's tilts.
    fn stretch(&self, residual: &[[f64; 2]], rows: Range<usize>, ratio: f64, variance: f64) -> f64 {
        let product = |at: usize| self.tilts[rows.end][at] - self.tilts[rows.start][at];
        let along = |at: usize| residual[rows.end][at] - residual[rows.start][at];
        let (xx, xy, yy) = (product(0) + 1.0 / ratio, product(1), product(2) + 1.0 / ratio);
        let (x, y) = (along(0), along(1));
        let determinant = xx * yy - xy * xy;
        let explained = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant / variance;
        0.5 * (explained - determinant.ln() - 2.0 * ratio.ln())
    }

    /// Cuts with one more, one less or one moved, until nothing helps; the declared errors are marginal throughout.
    fn improved(&self, mut cuts: Cuts, policy: &Policy) -> Cuts {
        let mut score = self.score(&cuts, policy);
        // Each round gains; the bound is only for the time it takes.
        for _ in 0..2 * policy.most_setups as usize {
            let mut best = (score + policy.move_cut, None);
            for moved in self.moves(&cuts) {
                let tried = self.score(&moved, policy);
                if tried > best.0 && (moved.len() as f64) < policy.most_setups {
                    best = (tried, Some(moved));
                }
            }
            let (Some(moved), reached) = (best.1, best.0) else { break };
            (cuts, score) = (moved, reached);
        }
        cuts
    }

    /// Cuts with one more, one less, or one moved by a few rows.
    fn moves(&self, cuts: &Cuts) -> Vec<Cuts> {
        let mut moves = Vec::new();
        let step = (self.rows / TRIED).max(1);
        let ends: Vec<usize> = std::iter::once(0).chain(cuts.iter().copied()).chain([self.rows]).collect();
        for pair in ends.windows(2) {
            for cut in (pair[0] + SHORTEST..(pair[1] + 1).saturating_sub(SHORTEST)).step_by(step) {
                let mut more = cuts.clone();
                more.push(cut);
                more.sort_unstable();
                moves.push(more);
            }
        }
        for (index, &cut) in cuts.iter().enumerate() {
            let mut fewer = cuts.clone();
            fewer.remove(index);
            moves.push(fewer);
            for shift in [-2, -1, 1, 2] {
                let Some(to) = cut.checked_add_signed(shift).filter(|&to| to > ends[index] && to < ends[index + 2])
                else {
                    continue;
                };
                let mut moved = cuts.clone();
                moved[index] = to;
                moves.push(moved);
            }
        }
        moves
    }

    /// The residual's sums and the variance once the declared errors are fitted beside the stretches' tilts.
    fn refitted(&self, cuts: &Cuts, ratio: f64) -> Option<(Vec<[f64; 2]>, f64)> {
        let set = self.set(cuts);
        let (factor, mut tilts) = set.solved(ratio)?;
        solve_upper(&factor, &mut tilts);
        let size = tilts.len();
        let shift: Vec<f64> = (0..set.beside.nrows())
            .map(|a| (0..size).map(|at| set.beside[(a, at)] * tilts[at]).sum())
            .collect();
        let moved = |row: usize, side: usize| {
            let own: f64 = shift.iter().enumerate().map(|(a, shift)| shift * self.declared[row][2 * a + side]).sum();
            self.residual[row][side] + own
        };
        let residual = (0..=self.rows).map(|row| [moved(row, 0), moved(row, 1)]).collect();
        let mut left = self.energy - 2.0 * dot(&set.along, &tilts);
        for i in 0..size {
            left += (0..size).map(|j| tilts[i] * set.reduced[(i, j)] * tilts[j]).sum::<f64>();
        }
        let variance = left / (self.freedom - size as f64).max(1.0);
        Some((residual, variance.min(self.energy / self.freedom).max(f64::MIN_POSITIVE)))
    }

    /// Products of the stretches' tilts behind the declared errors.
    fn set(&self, cuts: &Cuts) -> Set {
        let ends: Vec<usize> = std::iter::once(0).chain(cuts.iter().copied()).chain([self.rows]).collect();
        let size = 2 * (ends.len() - 1);
        let beside = Mat::from_fn(self.declared[0].len() / 2, size, |a, at| {
            let (which, side) = (at / 2, at % 2);
            self.declared[ends[which + 1]][2 * a + side] - self.declared[ends[which]][2 * a + side]
        });
        let absorbed = beside.transpose() * &beside;
        let reduced = Mat::from_fn(size, size, |i, j| {
            let own = if i / 2 == j / 2 {
                self.tilts[ends[i / 2 + 1]][i % 2 + j % 2] - self.tilts[ends[i / 2]][i % 2 + j % 2]
            } else {
                0.0
            };
            own - absorbed[(i, j)]
        });
        let along = (0..size)
            .map(|at| self.residual[ends[at / 2 + 1]][at % 2] - self.residual[ends[at / 2]][at % 2])
            .collect();
        Set { beside, reduced, along }
    }

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

    /// Log evidence of a set of cuts less its price, at the best of a few variances.
    fn score(&self, cuts: &Cuts, policy: &Policy) -> f64 {
        let set = self.set(cuts);
        let evidence = |ratio: f64| {
            let Some((factor, forward)) = set.solved(ratio) else { return f64::NEG_INFINITY };
            let rest = (self.energy - dot(&forward, &forward)).max(1e-9 * self.energy);
            -self.freedom / 2.0 * rest.ln()
                - half_log_det(&factor)
                - forward.len() as f64 / 2.0 * ratio.ln()
        };
        let best = JUDGED.map(evidence).into_iter().fold(f64::NEG_INFINITY, f64::max);
        best - price(self.rows, cuts.len() + 1, policy)
    }
}

/// Products of the tilts of all stretches of a set of cuts.
struct Set {
    /// With the orthonormal declared columns.
    beside: Mat<f64>,
    /// With each other, less what the declared errors absorb.
    reduced: Mat<f64>,
    /// With the residual.
    along: Vec<f64>,
}

impl Set {
    /// Cholesky factor at a variance of the tilts over the noise, and L⁻¹ times the products with the residual.
    fn solved(&self, ratio: f64) -> Option<(Mat<f64>, Vec<f64>)> {
        let size = self.along.len();
        let matrix =
            Mat::from_fn(size, size, |i, j| self.reduced[(i, j)] + if i == j { 1.0 / ratio } else { 0.0 });
        let factor = cholesky(&matrix)?;
        let mut forward = Mat::from_fn(size, 1, |row, _| self.along[row]);
        solve_lower(factor.as_ref(), forward.as_mut());
        Some((factor, (0..size).map(|row| forward[(row, 0)]).collect()))
    }
}
