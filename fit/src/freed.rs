//! Errors that are many times larger than their size, which an anchored fit takes for noise.
//!
//! Beside unknown objects an error counts as shown where the noise leaves it surer than its size. What such an error leaves while it
//! is held near zero is noise as well: held, a range zero of a metre leaves half a metre, against which nothing is sure. So the data
//! are asked once without sizes, where that promises to explain much of what is left, and with the noise that it really leaves.

use super::FitError;
use super::normal::Rest;
use super::solver::{Course, Solver};
use super::subspace::Subspace;

/// The share of the objective that what is held has to explain.
const SHARE: f64 = 0.2;

/// The ratio of mean squares, of what each combination that is held explains to what all leave, from which on this is no noise.
const RATIO: f64 = 25.0;

impl Solver<'_> {
    /// The course, or a better one in which errors count as shown that this one takes for noise.
    pub(super) fn freed(&mut self, course: Course) -> Result<Course, FitError> {
        let is_all = course.subspace.rank() == course.subspace.parameters();
        if !self.options.anchored || is_all || self.options.noise.known().is_some() {
            return Ok(course);
        }
        let partial = self.partial(&course.point.sweep);
        let free = Subspace::determined(&partial, course.subspace.size().to_vec());
        let Some(more) = free.rank().checked_sub(course.subspace.rank()).filter(|more| *more > 0) else {
            return Ok(course);
        };
        let all = course.point.sweep.tally.objective;
        let explained = free.step(&partial, 0.0, &Rest::Still).length.powi(2).min(all);
        let (_, weight) = self.norms_and_weights(&course);
        let spare = self.kept_components(&weight) as f64 - self.used(&course) - more as f64;
        let is_noise = explained / more as f64 * spare <= RATIO * (all - explained);
        if explained < SHARE * all || spare <= 0.0 || is_noise {
            return Ok(course);
        }
        let mut other = course.clone();
        other.subspace = free;
        self.settle(&mut other)?;
        let subspace = self.determined(&other.point.values, &other.noise)?;
        if other.stopped.is_some()
            || subspace.rank() <= course.subspace.rank()
            || self.scale(&other) >= self.scale(&course)
        {
            return Ok(course);
        }
        // What is not shown even so goes back to where it is expected.
        let values = self.with_smallest(&other.point.values, &subspace);
        other.point = self.point(values, &other.noise, other.weighting, Rest::Still)?;
        other.subspace = subspace;
        let noise = other.noise.clone();
        self.settled(other, noise)
    }
}
