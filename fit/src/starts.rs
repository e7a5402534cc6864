//! A fit that ends where nothing is near what was measured, and other starts for one of directions.
//!
//! Errors of a radian may lie behind a ridge, seen from zero. A bottom beyond it is told by what is left there.

use std::f64::consts::FRAC_PI_2;

use model_core::{Quantity, SymbolId, SymbolKind};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::solver::{Course, Solver};
use super::turns::is_index;
use super::{FitError, robust};
use observe::SiUnit;

/// How far off half of the directions are where something else than noise is the matter, rad: 11 degrees. As large a share of how far
/// away objects are that nobody knows the places of.
const FAR_OFF: f64 = 0.2;

/// How far off half of them are where another bottom is worth looking for, rad.
const DOUBTFUL_RAD: f64 = 0.01;

/// Angles are drawn up to this size, rad.
const DRAWN_RAD: f64 = 1.0;

/// Starts that are drawn, at most.
const STARTS: u64 = 12;

/// The share of all lengths of a declaration from which on an error may stand for a turn. It decides what is tried, not what is told.
const LONG_ERROR: f64 = 0.05;

/// Quarter turns by which a joint's zero may be elsewhere.
const QUARTERS: [f64; 3] = [1.0, -1.0, 2.0];

impl Solver<'_> {
    /// Whether half of the directions, or of what is seen of unknown objects, are so far off that no noise explains it.
    pub(super) fn is_far_off(&self, course: &Course) -> bool {
        self.median_rad(course).or_else(|| self.median_share(course)).is_some_and(|median| median > FAR_OFF)
    }

    /// Whether a course is at a bottom, and that nowhere far off: there is no noise to judge rows by elsewhere.
    pub(super) fn has_arrived(&self, course: &Course) -> bool {
        course.stopped.is_none() && !self.is_far_off(course)
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

    /// Whether an error is so large a part of the lengths of the declaration that it may stand for a turn.
    pub(super) fn has_long_errors(&self, course: &Course) -> bool {
        let nominal = self.chain.nominal_values();
        let constants = self.chain.symbols_of(SymbolKind::Constant);
        let lengths = constants.filter(|id| self.chain.symbol(*id).quantity == Quantity::Length);
        let reach_m: f64 = lengths.map(|id| nominal[id.index()].abs()).sum();
        let deviation = self.deviation(&course.point.values, &course.subspace);
        let mut errors = self.model.parameters().iter().zip(deviation);
        errors.any(|(id, deviation)| {
            let symbol = self.chain.symbol(*id);
            let is_length = symbol.kind == SymbolKind::Error && symbol.quantity == Quantity::Length;
            is_length && reach_m > 0.0 && deviation.abs() > LONG_ERROR * reach_m
        })
    }

    /// Starts at which one joint counts from a quarter or half turn away, where its index is estimated; none beside unknown objects, and none of
    /// directions, which have other starts.
    pub(super) fn other_homes(&self) -> Vec<Vec<f64>> {
        if self.observations.unknowns.is_some() || self.tell_far_off() {
            return Vec::new();
        }
        let given = self.with_state(self.options.start.clone());
        let turned = |id: &SymbolId, quarters: f64| {
            let mut start = given.clone();
            start[id.index()] += quarters * FRAC_PI_2;
            start
        };
        let indices = self.model.parameters().iter().filter(|id| is_index(self.chain, **id));
        indices.flat_map(|id| QUARTERS.map(|quarters| turned(id, quarters))).collect()
    }

    /// Whether all that is measured are directions: of these it is known how far off is far.
    pub(super) fn tell_far_off(&self) -> bool {
        self.observations.poses.series.iter().all(|series| series.measure.kind().tells_far_off)
    }

    /// How far off half of the directions are, rad; `None` where anything else is measured, of which nobody knows how large
    /// it is.
    fn median_rad(&self, course: &Course) -> Option<f64> {
        if !self.tell_far_off() {
            return None;
        }
        let mut norms: Vec<f64> = self.layout.norms(&course.point.sweep.residual).collect();
        norms.retain(|norm| norm.is_finite());
        (!norms.is_empty()).then(|| robust::median(norms))
    }

    /// By which share of how far away it is half of what is seen of objects is off; `None` where rows observe anything else.
    fn median_share(&self, course: &Course) -> Option<f64> {
        let unknowns = self.observations.unknowns.as_ref()?;
        let away_m = unknowns.away_m();
        let norms = self.layout.norms(&course.point.sweep.residual);
        let mut shares = Vec::with_capacity(self.observations.rows());
        for ((norm, measure), &station) in
            norms.zip(self.observations.poses.measures()).zip(&unknowns.station)
        {
            measure.shape()?;
            let away_m = if measure.unit() == SiUnit::METRE { away_m[station as usize] } else { 1.0 };
            shares.extend(Some(norm / away_m).filter(|share| share.is_finite()));
        }
        (!shares.is_empty()).then(|| robust::median(shares))
    }
}
