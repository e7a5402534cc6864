//! Other starts, for a fit that ends where directions are nowhere near those that were measured.
//!
//! Errors of a radian may lie behind a ridge, seen from zero. A bottom beyond it is told by what is left there.

use model_core::{Quantity, SymbolId};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::solver::{Course, Solver};
use super::{FitError, robust};
use crate::data::Measure;

/// How far off half of the directions are where something else than noise is the matter, rad: 11 degrees.
const FAR_OFF_RAD: f64 = 0.2;

/// How far off half of them are where another bottom is worth looking for, rad.
const DOUBTFUL_RAD: f64 = 0.01;

/// Angles are drawn up to this size, rad.
const DRAWN_RAD: f64 = 1.0;

/// Starts that are drawn, at most.
const STARTS: u64 = 12;

impl Solver<'_> {
    /// Whether half of the directions are so far off that no noise explains it.
    pub(super) fn is_far_off(&self, course: &Course) -> bool {
        self.median_rad(course).is_some_and(|median| median > FAR_OFF_RAD)
    }

    /// The course that ends nearest to the directions, from here or from drawn starts; the one given where that is near.
    pub(super) fn nearest(&mut self, course: Course) -> Result<Course, FitError> {
        let is_angle = |&id: &SymbolId| self.chain.symbol(id).quantity == Quantity::Angle;
        let angles: Vec<SymbolId> = self.model.parameters().iter().copied().filter(is_angle).collect();
        let mut best = course;
        for seed in 0..STARTS {
            let Some(least) = self.median_rad(&best).filter(|&median| median > DOUBTFUL_RAD) else { break };
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let mut start = self.nominal();
            for id in &angles {
                start[id.index()] += rng.random_range(-DRAWN_RAD..DRAWN_RAD);
            }
            let other = self.course(&start, self.options.weighting())?;
            if other.stopped.is_none() && self.median_rad(&other).is_some_and(|median| median < least) {
                best = other;
            }
        }
        Ok(best)
    }

    /// How far off half of the directions are, rad; `None` where anything else is measured, of which nobody knows how large
    /// it is.
    fn median_rad(&self, course: &Course) -> Option<f64> {
        let series = &self.observations.poses.series;
        if series.iter().any(|series| series.measure != Measure::Direction) {
            return None;
        }
        let mut norms: Vec<f64> = self.layout.norms(&course.point.sweep.residual).collect();
        norms.retain(|norm| norm.is_finite());
        (!norms.is_empty()).then(|| robust::median(norms))
    }
}
