//! Kinds of component that tell nothing of a noise.

use std::ops::Range;

use super::Layout;
use observe::Observations;

/// Kinds of component that leave nothing but rounding, while others of their series leave more: a plane instrument shows no height.
/// They tell nothing of a noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Mute {
    /// Of each mute kind those whose noise it takes.
    speakers: Vec<Option<Range<usize>>>,
}

impl Mute {
    /// By what each component leaves, and the smallest difference that means something.
    #[must_use]
    pub fn of(observations: &Observations, layout: &Layout, residual: &[f64], resolution: f64) -> Self {
        let mut largest = vec![0.0_f64; layout.kinds];
        for (kind, residual) in layout.kind_of_each().zip(residual) {
            largest[kind] = largest[kind].max(residual.abs());
        }
        let mut speakers = vec![None; layout.kinds];
        let mut start = 0;
        for series in &observations.poses.series {
            let own = start..start + series.measure.components();
            start = own.end;
            if own.clone().any(|kind| largest[kind] > resolution) {
                let silent = own.clone().filter(|&kind| largest[kind] <= resolution);
                silent.for_each(|kind| speakers[kind] = Some(own.clone()));
            }
        }
        Self { speakers }
    }

    /// Whether a kind tells nothing of its noise.
    #[must_use]
    pub fn is(&self, kind: usize) -> bool {
        self.speakers[kind].is_some()
    }

    /// Standard deviations of kinds, mute ones with the largest of their series.
    #[must_use]
    pub fn lent(&self, of_kinds: Vec<f64>) -> Vec<f64> {
        let own = |(kind, &alone): (usize, &f64)| match &self.speakers[kind] {
            Some(range) => {
                let speaking = range.clone().filter(|&other| !self.is(other));
                speaking.map(|other| of_kinds[other]).fold(0.0, f64::max)
            }
            None => alone,
        };
        of_kinds.iter().enumerate().map(own).collect()
    }
}
