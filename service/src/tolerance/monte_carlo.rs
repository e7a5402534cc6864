//! Monte Carlo: all errors drawn at once, many times, and what each draw does over the poses.
//!
//! The columns of all poses lie in a space of few dimensions, often far fewer than errors. Each draw is brought into it first, so
//! that a pose costs as many products as there are dimensions. Draws go in blocks, each with a stream of random numbers of its
//! own, so that the threads cannot change what is drawn.

use model_core::budget::Sensitivity;
use nalgebra::{DMatrix, SymmetricEigen};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::{Distribution, Tolerance};

/// What the draws came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// The root mean square over the poses of each draw.
    pub rms: Sample,
    /// The largest over the poses of each draw.
    pub largest: Sample,
    /// At one pose, of all poses and draws.
    pub single: Sample,
}

/// Values that were drawn, rad or m.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Rising values with how many draws are at most as large; the last count is all of them.
    steps: Vec<(f64, u64)>,
}

impl Sample {
    /// The value that a part of the draws, 0 to 1, does not exceed.
    #[must_use]
    pub fn percentile(&self, part: f64) -> f64 {
        let Some(&(last, all)) = self.steps.last() else { return f64::NAN };
        let wanted = part.clamp(0.0, 1.0) * all as f64;
        let at = self.steps.partition_point(|&(_, count)| (count as f64) < wanted);
        let Some(&(value, count)) = self.steps.get(at) else { return last };
        let (below, under) = at.checked_sub(1).map_or((value, 0), |before| self.steps[before]);
        let within = (wanted - under as f64) / ((count - under).max(1) as f64);
        below + (value - below) * within.clamp(0.0, 1.0)
    }

    /// The part of the draws that stay within a limit, 0 to 1.
    #[must_use]
    pub fn within(&self, limit: f64) -> f64 {
        let Some(&(_, all)) = self.steps.last() else { return f64::NAN };
        let at = self.steps.partition_point(|&(value, _)| value <= limit);
        let under = at.checked_sub(1).map_or(0, |before| self.steps[before].1);
        under as f64 / all as f64
    }

    fn of_values(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        Self { steps: values.into_iter().zip(1..).collect() }
    }

    fn of_bins(bins: &[u64]) -> Self {
        let mut sum = 0;
        let mut steps = Vec::new();
        for (bin, count) in bins.iter().enumerate().filter(|(_, count)| **count > 0) {
            if steps.is_empty() {
                steps.push((square_at(bin).sqrt(), 0));
            }
            sum += count;
            steps.push((square_at(bin + 1).sqrt(), sum));
        }
        Self { steps }
    }
}

/// Draws that go through the poses together.
const LANES: usize = 8;
/// Draws of one stream of random numbers; a multiple of the lanes.
const BLOCK: usize = 4096;
/// Squares are counted in bins by their exponent and as many leading digits of theirs: values to a thousandth, before what is
/// between two bins is taken from the straight line.
const SHIFT: u32 = 52 - 9;
/// The smallest square that has a bin of its own.
const LEAST: f64 = 1e-60;
/// Bins up to 1e12 or so.
const BINS: usize = 240 << 9;

fn bin_of(square: f64) -> usize {
    let above = (square.to_bits() >> SHIFT).saturating_sub(LEAST.to_bits() >> SHIFT);
    usize::try_from(above).unwrap_or(BINS).min(BINS - 1)
}

fn square_at(bin: usize) -> f64 {
    f64::from_bits(((LEAST.to_bits() >> SHIFT) + bin as u64) << SHIFT)
}

/// Draws the errors `draws` times: independent ones as their tolerances say, or with `root` normal numbers times it (see
/// [`super::After::root`]). The same seed gives the same draws, whatever the number of threads.
#[must_use]
pub fn simulate(
    sensitivity: &Sensitivity,
    tolerances: &[Tolerance],
    root: Option<&DMatrix<f64>>,
    draws: usize,
    seed: u64,
) -> Simulation {
    let n = tolerances.len();
    // Independent numbers in units of their own, and what makes errors of them.
    let normal = Distribution::Normal { deviations: 1.0 };
    let sources: Vec<&Distribution> = match root {
        Some(root) => vec![&normal; root.ncols()],
        None => tolerances.iter().map(|tolerance| &tolerance.distribution).collect(),
    };
    let makes = root.cloned().unwrap_or_else(|| {
        DMatrix::from_fn(n, n, |row, column| if row == column { tolerances[row].size } else { 0.0 })
    });
    let columns = DMatrix::from_fn(3 * sensitivity.poses(), n, |row, error| {
        sensitivity.at_pose(row / 3)[error][row % 3]
    });
    let reduced = Reduced::new(&(columns * makes));
    let blocks = draws.div_ceil(BLOCK);
    let parts = parallel::each(blocks, |block| {
        let (mut found, mut bins) = (Vec::new(), vec![0_u64; BINS]);
        let count = BLOCK.min(draws - block * BLOCK);
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        chance.set_stream(block as u64);
        for start in (0..count).step_by(LANES) {
            let lanes = LANES.min(count - start);
            let mut drawn = vec![[0.0; LANES]; sources.len()];
            for lane in 0..lanes {
                drawn
                    .iter_mut()
                    .zip(&sources)
                    .for_each(|(drawn, source)| drawn[lane] = source.draw(&mut chance));
            }
            found.extend_from_slice(&reduced.over_poses(&drawn, lanes, &mut bins)[..lanes]);
        }
        (found, bins)
    });
    let mut bins = vec![0_u64; BINS];
    let (mut rms, mut largest) = (Vec::with_capacity(draws), Vec::with_capacity(draws));
    for (found, of_part) in parts {
        bins.iter_mut().zip(&of_part).for_each(|(sum, count)| *sum += count);
        for (mean, most) in found {
            rms.push(mean);
            largest.push(most);
        }
    }
    Simulation {
        rms: Sample::of_values(rms),
        largest: Sample::of_values(largest),
        single: Sample::of_bins(&bins),
    }
}

/// The columns of all poses as a product of few: pose by pose what makes x, y and z of the reduced numbers.
struct Reduced {
    /// Reduced numbers from drawn ones, dimension by dimension.
    into: Vec<Vec<f64>>,
    /// Pose by pose, dimension by dimension.
    out: Vec<[f64; 3]>,
    poses: usize,
}

impl Reduced {
    /// By the eigenvectors of the columns' products; what of them is rounding does nothing.
    fn new(columns: &DMatrix<f64>) -> Self {
        /// Of the largest eigenvalue: lengths to a ten-millionth of it, which is under what any draw could show.
        const ROUNDING: f64 = 1e-14;
        let eigen = SymmetricEigen::new(columns.transpose() * columns);
        let most = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> =
            (0..columns.ncols()).filter(|&at| eigen.eigenvalues[at] > ROUNDING * most).collect();
        let into: Vec<Vec<f64>> =
            kept.iter().map(|&at| eigen.eigenvectors.column(at).iter().copied().collect()).collect();
        let poses = columns.nrows() / 3;
        let products = columns * &eigen.eigenvectors;
        let out = (0..poses)
            .flat_map(|pose| kept.iter().map(move |&at| (pose, at)))
            .map(|(pose, at)| [0, 1, 2].map(|axis| products[(3 * pose + axis, at)]))
            .collect();
        Self { into, out, poses }
    }

    /// The root mean square and the largest over the poses of each lane; counts the squares of the lanes that are used.
    fn over_poses(&self, drawn: &[[f64; LANES]], lanes: usize, bins: &mut [u64]) -> [(f64, f64); LANES] {
        let k = self.into.len();
        let mut reduced = vec![[0.0; LANES]; k];
        for (reduced, into) in reduced.iter_mut().zip(&self.into) {
            for (factor, drawn) in into.iter().zip(drawn) {
                reduced.iter_mut().zip(drawn).for_each(|(sum, value)| *sum += factor * value);
            }
        }
        let (mut sum, mut most) = ([0.0; LANES], [0.0_f64; LANES]);
        for pose in 0..self.poses {
            let (mut x, mut y, mut z) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for (out, reduced) in self.out[pose * k..(pose + 1) * k].iter().zip(&reduced) {
                for lane in 0..LANES {
                    x[lane] += out[0] * reduced[lane];
                    y[lane] += out[1] * reduced[lane];
                    z[lane] += out[2] * reduced[lane];
                }
            }
            let mut square = [0.0; LANES];
            for lane in 0..LANES {
                square[lane] = x[lane] * x[lane] + y[lane] * y[lane] + z[lane] * z[lane];
                sum[lane] += square[lane];
                most[lane] = most[lane].max(square[lane]);
            }
            for square in &square[..lanes] {
                bins[bin_of(*square)] += 1;
            }
        }
        let count = self.poses.max(1) as f64;
        let mut found = [(0.0, 0.0); LANES];
        for lane in 0..LANES {
            found[lane] = ((sum[lane] / count).sqrt(), most[lane].sqrt());
        }
        found
    }
}
