//! Readings in which noise would look like what was found to hang on them.
//!
//! A reading that is read too high is followed by a residual that says so: over noisy readings the residual has a slope, as if the
//! reading's own scale were wrong. Noise of a size that would make the slope is told where the residual is large enough for it.
//!
//! Source: W. A. Fuller, Measurement Error Models (1987), section 1.1.

use model_core::{Chain, SymbolId};

use fit::noise::Layout;
use fit::{FitError, FitResult, Model, pulled, residuals};
use observe::{Observations, SiUnit};

/// By how much a reading is moved to see what it does: rad or m.
const MOVED: f64 = 1e-6;

/// Standard deviations by which the slope is off zero at least.
const SURE: f64 = 4.0;

/// The share of a reading's variance that is noise at most: more, and it were no reading.
const MOST: f64 = 0.9;

/// The variance of residuals that noise of readings would bring, in units of what there is, at most.
const BROUGHT: f64 = 1.2;

/// A reading whose noise would explain the slope.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Noisy {
    pub reading: String,
    /// The standard deviation of that noise, SI.
    pub sigma: f64,
    pub unit: SiUnit,
}

/// The noise in the readings of a joint or input that would explain how residuals follow them, those of a chain at some values, with
/// the noise and the weights of a fit; none where they do not, or not so, and where the readings state how uncertain they are.
pub(super) fn noisy(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    values: &[f64],
    reading: SymbolId,
) -> Result<Option<Noisy>, FitError> {
    let stated = observations.reading_sigma.iter().any(|(id, _)| *id == reading);
    let Some(at) = observations.poses.columns.iter().position(|(id, _)| *id == reading) else {
        return Ok(None);
    };
    if stated {
        return Ok(None);
    }
    let model = Model::without_columns(chain, &observations.poses);
    let pulled = pulled(&model, observations, values, at, |_| MOVED)?;
    let residual = residuals(&model, observations, values)?;
    let (layout, sigma) = (Layout::of(observations), fit.noise.sigma_without_memory());
    let readings = &observations.poses.columns[at].1;
    // Of each component in units of its noise what a unit of the reading does, the reading, and the residual.
    let components: Vec<[f64; 3]> = layout
        .row_of_each()
        .enumerate()
        .filter(|&(_, row)| fit.residuals.weight[row] > 0.0)
        .map(|(at, row)| {
            let scale = fit.residuals.weight[row].sqrt() / sigma[at];
            [scale * pulled[at] / MOVED, readings[row], scale * residual[at]]
        })
        .collect();
    let over = |of: &dyn Fn(&[f64; 3]) -> f64| components.iter().map(of).sum::<f64>();
    let squares = over(&|[slope, ..]| slope * slope);
    if squares <= 0.0 {
        return Ok(None);
    }
    let mean = over(&|[slope, read, _]| slope * slope * read) / squares;
    let spread = over(&|[slope, read, _]| (slope * (read - mean)).powi(2));
    let product = over(&|[slope, read, left]| slope * (read - mean) * left);
    let share = product / spread;
    let variance = share * spread / squares;
    let brought = variance * squares / components.len() as f64;
    if !(share < MOST && product > SURE * spread.sqrt() && brought <= BROUGHT) {
        return Ok(None);
    }
    let symbol = chain.symbol(reading);
    Ok(Some(Noisy { reading: symbol.name.clone(), sigma: variance.sqrt(), unit: symbol.quantity.into() }))
}
