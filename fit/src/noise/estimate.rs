//! The noise model from residuals: first the floors, then what varies with the joints.

use model_core::Chain;
use rayon::prelude::*;

use super::brought::{self, Component};
use super::{Layout, Mute, Noise, NoiseOptions, Pools, variance};
use crate::robust;
use observe::Observations;

/// Rows at least that one processor looks through.
const AT_ONCE: usize = 4096;

/// Floors from medians alone: what a fit starts from, before it has weights.
#[must_use]
pub fn from_medians(
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
    residual: &[f64],
    brought: &[f64],
) -> Noise {
    let stated = stated(options, observations, layout);
    let resolution = resolution(observations);
    let floor = match options.known() {
        Some(sigma) => vec![sigma; layout.kinds],
        None => {
            let pools = Pools::of(observations, layout, 0.0);
            let mute = Mute::of(observations, layout, residual, resolution);
            let mut floors = medians(&pools, layout, residual, &stated, &mute);
            if !brought.is_empty() {
                let of_pools = of_pools(layout, &pools, residual, &stated, brought, |_, _, _| [1.0; 2]);
                let pairs = of_pools.iter().zip(floors);
                floors = pairs.map(|(own, alone)| brought::floor_of_median(own, alone)).collect();
            }
            mute.lent(pools.by_kind(layout, floors, &stated))
        }
    };
    finish(Noise { floor, of_readings: 1.0, ..Noise::default() }, resolution, layout, &stated, brought)
}

/// Of each pool its components, each with its weight and what it leaves of that.
fn of_pools(
    layout: &Layout,
    pools: &Pools,
    residual: &[f64],
    stated: &[f64],
    brought: &[f64],
    weights: impl Fn(usize, usize, usize) -> [f64; 2],
) -> Vec<Vec<Component>> {
    let mut of_pools = vec![Vec::new(); pools.count()];
    let of_each = layout.row_of_each().zip(layout.kind_of_each());
    let components = residual.iter().zip(brought).zip(each(stated)).enumerate();
    for ((row, kind), (at, ((&residual, &brought), stated))) in of_each.zip(components) {
        let [weight, left] = weights(at, row, kind);
        of_pools[pools.of_kind[kind]].push(Component { residual, stated, brought, weight, left });
    }
    of_pools
}

/// Per pool the standard deviation that the median of its residuals suggests.
fn medians(pools: &Pools, layout: &Layout, residual: &[f64], stated: &[f64], mute: &Mute) -> Vec<f64> {
    let median = |pool: usize| {
        let own = layout
            .kind_of_each()
            .zip(residual.iter().zip(each(stated)))
            .filter(|(kind, _)| pools.of_kind[*kind] == pool && !mute.is(*kind));
        let scaled = own.map(|(_, (residual, stated))| (residual / stated).abs()).collect();
        robust::median(scaled) / robust::median_norm(1)
    };
    parallel::each(pools.count(), median)
}

/// The logarithm of how large residuals are by their medians, the mean over all components.
#[must_use]
pub fn ln_scale(observations: &Observations, layout: &Layout, residual: &[f64]) -> f64 {
    let pools = Pools::of(observations, layout, 0.0);
    let least = resolution(observations);
    let mute = Mute::of(observations, layout, residual, least);
    let medians = medians(&pools, layout, residual, &[], &mute);
    let sum: f64 = layout.kind_of_each().map(|kind| medians[pools.of_kind[kind]].max(least).ln()).sum();
    sum / (layout.components() as f64).max(1.0)
}

/// The noise that has these floors and nothing else; of readings that are exact.
#[must_use]
pub fn of_floors(
    floor: Vec<f64>,
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
) -> Noise {
    let stated = stated(options, observations, layout);
    finish(
        Noise { floor, of_readings: 1.0, ..Noise::default() },
        resolution(observations),
        layout,
        &stated,
        &[],
    )
}

/// How much of residuals the estimates follow.
#[derive(Debug, Clone)]
pub enum Followed {
    /// So many independent numbers were estimated, and no component is known to have more part in them than others.
    Evenly {
        /// How many.
        used: f64,
    },
    /// Of each component the share of a residual of its own.
    Each(Vec<f64>),
}

/// The noise model from raw residuals, the weights of the rows, what the estimates followed of them, and per component what uncertain
/// readings bring, rad or m (empty where all are exact).
#[allow(clippy::too_many_arguments)]
#[must_use]
pub fn estimate(
    chain: &Chain,
    options: &NoiseOptions,
    observations: &Observations,
    layout: &Layout,
    residual: &[f64],
    weight: &[f64],
    followed: &Followed,
    brought: &[f64],
) -> Noise {
    let stated = stated(options, observations, layout);
    // Weights between none and all are those of a robust fit.
    let robust_weights = weight.iter().any(|&weight| weight > 0.0 && weight < 1.0);
    let counted = layout.row_of_each().filter(|&row| robust_weights || weight[row] > 0.0).count() as f64;
    let (used, left) = match followed {
        Followed::Evenly { used } => (*used, vec![(counted - used).max(1.0) / counted]),
        Followed::Each(followed) => {
            (followed.iter().sum(), followed.iter().map(|followed| (1.0 - followed).max(0.0)).collect())
        }
    };
    let pools = Pools::of(observations, layout, used);
    let resolution = resolution(observations);
    let mute = Mute::of(observations, layout, residual, resolution);
    let strides = layout.runs.iter().flat_map(|run| std::iter::repeat_n(run.stride, run.stride));
    let consistency: Vec<f64> =
        strides.map(|stride| if robust_weights { robust::consistency(stride) } else { 1.0 }).collect();
    let floors = |spread: &[f64], brought: &[f64]| -> (Vec<f64>, f64) {
        let mut sums = vec![[0.0; 2]; pools.count()];
        let of_each = layout.row_of_each().zip(layout.kind_of_each());
        let residuals = residual.iter().zip(each(spread)).zip(left.iter().cycle());
        for ((row, kind), ((residual, spread), left)) in of_each.zip(residuals) {
            if mute.is(kind) {
                continue;
            }
            let [weights, squares] = &mut sums[pools.of_kind[kind]];
            *weights += weight[row] * left;
            *squares += weight[row] * consistency[kind] * (residual / spread).powi(2);
        }
        let floor = |[weights, squares]: [f64; 2]| {
            if weights > 0.0 { (squares / weights).sqrt() } else { 0.0 }
        };
        let alone: Vec<f64> = sums.into_iter().map(floor).collect();
        if brought.is_empty() {
            return (mute.lent(pools.by_kind(layout, alone, spread)), 1.0);
        }
        let weights = |at: usize, row: usize, kind: usize| {
            [weight[row] * consistency[kind], weight[row] * left[at % left.len()]]
        };
        let of_pools = of_pools(layout, &pools, residual, spread, brought, weights);
        let (floors, factor) = brought::floors(&of_pools, &alone);
        (mute.lent(pools.by_kind(layout, floors, spread)), factor)
    };
    let (floor, of_readings) =
        options.known().map_or_else(|| floors(&stated, brought), |sigma| (vec![sigma; layout.kinds], 1.0));
    let mut noise =
        finish(Noise { floor, of_readings, ..Noise::default() }, resolution, layout, &stated, brought);
    if options.variance && options.sigma.is_none() {
        let scaled: Vec<f64> = residual.iter().zip(&noise.sigma).map(|(r, sigma)| r / sigma).collect();
        let found = variance::fit(chain, observations, layout, &scaled, weight, &left);
        if !found.is_empty() {
            let of_kinds = observations.noise_of_kinds();
            let mut spread: Vec<f64> = each(&stated).take(layout.components()).collect();
            let mut brought = brought.to_vec();
            for (model, factor) in &found {
                for values in [&mut spread, &mut brought] {
                    let of_each = layout.row_of_each().zip(layout.kind_of_each());
                    let own = values.iter_mut().zip(of_each);
                    let own = own.filter(|(_, (_, kind))| of_kinds[*kind] == model.of);
                    own.for_each(|(value, (row, _))| *value *= factor[row]);
                }
            }
            let variance = found.into_iter().map(|(model, _)| model).collect();
            let (floor, of_readings) = floors(&spread, &brought);
            noise = Noise { floor, variance, of_readings, ..Noise::default() };
            noise = finish(noise, resolution, layout, &spread, &brought);
        }
    }
    noise
}

/// What is stated per component, up to a factor; empty where nothing is.
#[must_use]
pub fn stated(options: &NoiseOptions, observations: &Observations, layout: &Layout) -> Vec<f64> {
    if observations.sigma.is_empty() || options.sigma.is_some() {
        return Vec::new();
    }
    let mut stated = Vec::with_capacity(layout.components());
    for (measure, sigma) in observations.poses.measures().zip(&observations.sigma) {
        stated.extend(sigma.unwrap_or([1.0; 3]).iter().take(measure.components()));
    }
    stated
}

/// One number a component: those of a list, or 1 where it is empty. A list of ones would be as large as the residuals.
pub(crate) fn each(spread: &[f64]) -> impl Iterator<Item = f64> {
    let ones = if spread.is_empty() { usize::MAX } else { 0 };
    spread.iter().copied().chain(std::iter::repeat_n(1.0, ones))
}

/// Spreads the floors over the components, with what readings bring. No standard deviation is smaller than what the numbers resolve.
fn finish(mut noise: Noise, resolution: f64, layout: &Layout, spread: &[f64], brought: &[f64]) -> Noise {
    let of_each = layout.kind_of_each().zip(each(spread)).enumerate();
    let sigma = of_each.map(|(at, (kind, spread))| {
        let own = noise.floor[kind] * spread;
        let whole = brought.get(at).map_or(own, |brought| own.hypot(noise.of_readings * brought));
        whole.max(resolution)
    });
    noise.sigma = sigma.collect();
    noise.runs.clone_from(&layout.runs);
    noise
}

/// The smallest difference that means something: rounding of the largest measured number, through a few operations.
#[must_use]
pub fn resolution(observations: &Observations) -> f64 {
    let objects = observations.unknowns.iter().flat_map(|unknowns| &unknowns.objects);
    let places = objects.flat_map(|object| object.place.iter().copied());
    let measured =
        observations.measured.par_iter().with_min_len(AT_ONCE).map(|measured| measured.largest().abs());
    let largest = places.fold(measured.reduce(|| 0.0, f64::max), |largest, value| largest.max(value.abs()));
    8.0 * f64::EPSILON * largest.max(f64::MIN_POSITIVE / f64::EPSILON)
}
