//! How large a held-out figure may be that says anything: one larger than the region that was measured is no size of an error.

use super::caution::Caution;
use super::rms::Rms;
use crate::limits::{ANYWHERE_RAD, OF_DISTANCE};
use fit::robust;
use observe::{Observations, SiUnit};

/// The largest held-out RMS that is told, SI: the extent of what was measured.
pub(crate) fn largest_plausible(observations: &Observations, unit: SiUnit) -> f64 {
    if unit == SiUnit::RAD {
        return ANYWHERE_RAD;
    }
    let own = observations.poses.series.iter().filter(|series| series.measure.unit() == unit);
    own.map(|series| {
        let measured = &observations.measured[series.rows.clone()];
        let distances: Option<Vec<f64>> = measured.iter().map(series.measure.kind().distance_m).collect();
        let Some(distances) = distances.filter(|own| !own.is_empty()) else { return f64::INFINITY };
        let extent = |values: &mut dyn Iterator<Item = f64>| {
            let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            });
            if high > low { high - low } else { 0.0 }
        };
        let vectors: Option<Vec<_>> = measured.iter().map(|own| own.vector()).collect();
        let across = match vectors {
            Some(vectors) => {
                let along = |axis: usize| extent(&mut vectors.iter().map(|own| own[axis])).powi(2);
                (along(0) + along(1) + along(2)).sqrt()
            }
            None => extent(&mut distances.iter().copied()),
        };
        across.max(OF_DISTANCE * robust::median(distances))
    })
    .fold(0.0, f64::max)
}

impl Rms {
    /// Without held-out figures that are larger than what was measured.
    pub(super) fn within(self, most: f64) -> Self {
        let told = |figure: Option<f64>| figure.filter(|rms| *rms <= most);
        Self {
            held_out_rms: told(self.held_out_rms),
            held_out_rms_kept: told(self.held_out_rms_kept),
            elsewhere_rms: told(self.elsewhere_rms),
            elsewhere_rms_kept: told(self.elsewhere_rms_kept),
            ..self
        }
    }
}

impl Caution {
    /// With no number in it that is larger than what was measured: infinity stands for such a one.
    pub(super) fn within(mut self, most: impl Fn(SiUnit) -> f64) -> Self {
        if let Self::WorseHeldOut { before, after, unit }
        | Self::WorseElsewhere { before, after, unit }
        | Self::NotConfirmed { before, after, unit, .. }
        | Self::ForetoldBadly { fitted: before, held_out: after, unit } = &mut self
        {
            let most = most(*unit);
            for figure in [before, after] {
                if *figure > most {
                    *figure = f64::INFINITY;
                }
            }
        }
        self
    }
}
