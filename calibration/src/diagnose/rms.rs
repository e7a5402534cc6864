//! Residuals before and after, as figures over rows.

use model_core::Chain;
use serde::Serialize;

use observe::{Observations, SiUnit};

/// Root mean square over observations of the length of the residual, SI: over every row, and over the rows kept.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Rms {
    /// On the data that were fitted, every row; absent if the residual has no finite value.
    pub rms: Option<f64>,
    /// The same over rows with weight in the last fit; absent if there are none.
    pub rms_kept: Option<f64>,
    /// On data that no stage saw, every row: a second file, or random folds; absent where nothing could be held out.
    pub held_out_rms: Option<f64>,
    /// The same over rows that are within reach of what the searches without them predict.
    pub held_out_rms_kept: Option<f64>,
    /// How many rows were held out.
    pub held_out_rows: usize,
    /// How many of them are within reach.
    pub held_out_rows_kept: usize,
    /// In regions of the joints that no stage saw, every row; absent where it was not measured.
    pub elsewhere_rms: Option<f64>,
    /// The same over rows that are within reach.
    pub elsewhere_rms_kept: Option<f64>,
}

/// Of the declaration as it was, and of the amended one, over the observations whose residuals have one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BeforeAfter {
    pub unit: SiUnit,
    /// RMS over these observations of the length that the noise gives a residual, SI.
    pub expected: f64,
    pub before: Rms,
    pub after: Rms,
}

impl BeforeAfter {
    /// What figures of several units are told in terms of, SI: the noise, where there is any.
    pub(crate) fn noise(&self) -> f64 {
        if self.expected > 0.0 { self.expected } else { 1.0 }
    }
}

/// Residuals in another unit than those of the first series.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Beside {
    /// What was observed.
    pub observed: Vec<String>,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// RMS over these observations of the length that the noise gives a residual, SI.
    pub expected_rms: f64,
    /// Residuals of the declaration as it was.
    pub before: Rms,
    /// Residuals of the amended one.
    pub after: Rms,
}

impl Beside {
    /// Held-out figures larger than `most` are left out.
    pub(super) fn of(observations: &Observations, chain: &Chain, own: &BeforeAfter, most: f64) -> Self {
        Self {
            observed: observables_of(observations, chain, own.unit),
            unit: own.unit,
            expected_rms: own.expected,
            before: own.before.within(most),
            after: own.after.within(most),
        }
    }
}

/// The names of the observables whose residuals have a unit, each once.
pub(super) fn observables_of(observations: &Observations, chain: &Chain, unit: SiUnit) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for series in observations.poses.series.iter().filter(|series| series.measure.unit() == unit) {
        let name = &chain.observable(series.observable).name;
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    names
}

/// A figure before and after, SI.
pub(crate) struct Worse {
    pub unit: SiUnit,
    pub before: f64,
    pub after: f64,
}

/// The figure that grows most, where figures of all units, each in terms of its noise, grow together.
pub(crate) fn worse(all: &[BeforeAfter], figure: impl Fn(&Rms) -> Option<f64>) -> Option<Worse> {
    let pairs = all.iter().filter_map(|own| Some((own, figure(&own.before)?, figure(&own.after)?)));
    let pairs: Vec<(&BeforeAfter, f64, f64)> = pairs.collect();
    let sum = |of: fn(&(&BeforeAfter, f64, f64)) -> f64| -> f64 {
        let each = pairs.iter().map(|pair| {
            // One unit is compared as it is.
            let noise = if pairs.len() > 1 { pair.0.noise() } else { 1.0 };
            pair.0.after.held_out_rows.max(1) as f64 * (of(pair) / noise).powi(2)
        });
        each.sum()
    };
    let grows = sum(|pair| pair.2) > sum(|pair| pair.1);
    let most = pairs.into_iter().max_by(|one, other| (one.2 / one.1).total_cmp(&(other.2 / other.1)));
    most.filter(|_| grows).map(|(own, before, after)| Worse { unit: own.unit, before, after })
}

/// What a figure of one model is as a share of another's, over the same observations: of all units together, each in terms of its
/// noise.
pub(crate) fn share(
    of: &[BeforeAfter],
    other: &[BeforeAfter],
    figure: impl Fn(&Rms) -> Option<f64>,
) -> Option<f64> {
    let pairs = of.iter().zip(other);
    let pairs = pairs.filter_map(|(own, other)| Some((other, figure(&own.after)?, figure(&other.after)?)));
    let pairs: Vec<(&BeforeAfter, f64, f64)> = pairs.collect();
    if let [(_, own, other)] = pairs[..] {
        return Some(own / other);
    }
    let weighed = |(unit, own, other): &(&BeforeAfter, f64, f64)| {
        let rows = unit.after.held_out_rows.max(1) as f64;
        [own, other].map(|figure| rows * (figure / unit.noise()).powi(2))
    };
    let sums = pairs.iter().map(weighed).reduce(|[a, b], [c, d]| [a + c, b + d])?;
    Some((sums[0] / sums[1]).sqrt())
}
