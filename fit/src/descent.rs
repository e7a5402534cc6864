//! Downhill: Levenberg-Marquardt steps, of which none is taken that makes the loss greater, while the noise is learned.
//!
//! Source: K. Madsen, H. B. Nielsen, O. Tingleff, Methods for Non-Linear Least Squares Problems (2004), with weights taken
//! anew at every step.

use std::sync::Arc;

use super::mixing::Mixing;
use super::normal::Rest;
use super::solver::{Course, LONG, Solver, same};
use super::subspace::Subspace;
use super::sweep::Weighting;
use super::{FitError, Reason};
use crate::noise::{self, Followed, Noise};

/// A step is negligible when it moves the prediction by this many standard deviations in all.
const NEGLIGIBLE: f64 = 1e-7;

/// The same where rows observe unknown objects: what nothing holds of their frame moves with the last bits of the rows.
const NEGLIGIBLE_IN_A_FREE_FRAME: f64 = 1e-5;

/// The same while the noise is still being learned, with few rows.
const ROUGHLY: f64 = 1e-2;

/// Steps so short change the objective by no more than this share, of which rounding is no small part.
const ROUNDING: f64 = 1e-12;

/// The noise is known when no standard deviation changes by more than this share.
const NOISE_KNOWN: f64 = 1e-3;

/// What changes by less than this share is the same noise: all rows are asked again for any other.
const SAME_NOISE: f64 = 1e-12;

/// Standard deviations that differ by no more than this share let the data determine the same.
const SIMILAR_NOISE: f64 = 0.1;

/// Beside unknown objects, a step along what the data do not determine that promises less than this share of the objective, and
/// does not keep it, is beyond what the sums resolve.
const UNRESOLVED: f64 = 1e-8;

/// The damping that stays of such steps, once one without any was refused.
const DAMPED: f64 = 1e-8;

/// Where a step changes the objective by no more than this share, the bottom is level.
const LEVEL: f64 = 1e-6;

/// So many times as many steps may be taken beside unknown objects: off a ridge of robust weights a step is hardly longer than the
/// one before.
const SLOWER: usize = 3;

/// A step that was refused is followed by one of this length, where rows observe unknown objects.
const SHORTER: f64 = 0.25;

/// How often a course begins anew where angles came to another home.
const HOMES: usize = 3;

/// How often the noise is learned anew.
const NOISE_ROUNDS: usize = 8;

/// How often the scale of a robust start is taken anew.
const SCALE_ROUNDS: usize = 10;

/// A scale that shrinks by less than this share has settled.
pub(super) const SCALE_SETTLED: f64 = 0.02;

/// From Huber's loss to Tukey's: how much larger than its own the noise is taken first.
const GRADUAL: [f64; 2] = [3.0, 1.5];

impl Solver<'_> {
    /// From some values to the bottom, undetermined combinations still. Where an angle came to another home, what is determined there is
    /// another matter, and the course begins anew from there.
    pub(super) fn course(&mut self, start: &[f64], weighting: Weighting) -> Result<Course, FitError> {
        let mut best = self.course_at_home(start, weighting)?;
        for _ in 0..HOMES {
            if !self.has_turned(&best) {
                break;
            }
            let other = self.course_at_home(&best.point.values, weighting)?;
            // The same bottom is another matter at its home.
            if self.scale(&other) > self.scale(&best) + SCALE_SETTLED {
                break;
            }
            best = other;
        }
        Ok(best)
    }

    /// From some values to the bottom, robustly by degrees, from Huber's loss at the scale of the medians to Tukey's at that of the noise.
    fn course_at_home(&mut self, start: &[f64], weighting: Weighting) -> Result<Course, FitError> {
        self.brought = self.brought_at(start)?;
        let noise = Arc::new(self.first_noise(start)?);
        let subspace = self.determined(start, &noise)?;
        let values = self.with_smallest(start, &subspace);
        let first = if weighting == Weighting::Full { Weighting::Full } else { Weighting::Huber };
        let point = self.point(values, &noise, first, Rest::Still)?;
        let mut course = Course { point, noise: noise.clone(), subspace, weighting: first, stopped: None };
        if weighting == Weighting::Biweight {
            self.approach(&mut course)?;
            course.weighting = weighting;
            for factor in GRADUAL {
                let wide = course.noise.times(factor);
                course.point = self.point(course.point.values, &wide, weighting, Rest::Still)?;
                self.descend(&mut course, &wide, self.roughly())?;
            }
            course.point = self.point(course.point.values, &course.noise, weighting, Rest::Still)?;
        }
        self.settled(course, noise)
    }

    /// The same from values that are near the bottom already.
    pub(super) fn course_from(&mut self, near: &[f64], weighting: Weighting) -> Result<Course, FitError> {
        self.brought = self.brought_at(near)?;
        let noise = Arc::new(self.first_noise(near)?);
        let subspace = self.determined(near, &noise)?;
        let values = self.with_smallest(near, &subspace);
        let point = self.point(values, &noise, weighting, Rest::Still)?;
        let course = Course { point, noise: noise.clone(), subspace, weighting, stopped: None };
        self.settled(course, noise)
    }

    /// A course to the bottom, of what is determined there; so far it was asked with some noise.
    pub(super) fn settled(
        &mut self,
        mut course: Course,
        mut asked_with: Arc<Noise>,
    ) -> Result<Course, FitError> {
        self.settle(&mut course)?;
        // What is determined is asked where constants that are estimated came to stand, and with another noise.
        for _ in 0..3 {
            if !self.determined_by_values() && same(&asked_with, &course.noise, SIMILAR_NOISE) {
                break;
            }
            let subspace = self.determined(&course.point.values, &course.noise)?;
            if subspace.rank() == course.subspace.rank() {
                break;
            }
            asked_with = course.noise.clone();
            course.subspace = subspace;
            self.settle(&mut course)?;
        }
        Ok(course)
    }

    /// Brings values near enough for the biweight, whatever the outliers, at a scale that only shrinks.
    fn approach(&mut self, course: &mut Course) -> Result<(), FitError> {
        let mut scale = self.ln_scale(&course.point.sweep.residual);
        for _ in 0..SCALE_ROUNDS {
            let before = course.clone();
            let noise = course.noise.clone();
            self.descend(course, &noise, 0.1 * (course.subspace.rank() as f64).sqrt())?;
            let shrunk = self.ln_scale(&course.point.sweep.residual);
            if shrunk > scale {
                *course = before;
                break;
            }
            course.noise = Arc::new(self.noise_of(&course.point.sweep.residual));
            let values = std::mem::take(&mut course.point.values);
            course.point = self.point(values, &course.noise, course.weighting, Rest::Still)?;
            if shrunk > scale - SCALE_SETTLED {
                break;
            }
            scale = shrunk;
        }
        Ok(())
    }

    /// Descends and learns the noise in turn until neither changes, or a noise comes back.
    pub(super) fn settle(&mut self, course: &mut Course) -> Result<(), FitError> {
        let mut tried: Vec<(Arc<Noise>, f64)> = Vec::new();
        for _ in 0..NOISE_ROUNDS {
            let noise = course.noise.clone();
            self.descend(course, &noise, self.roughly())?;
            let (_, weight) = self.norms_and_weights(course);
            if self.kept_components(&weight) as f64 <= self.used(course) {
                break;
            }
            let learned = Arc::new(self.learn_noise(course, &weight)?);
            let known = same(&learned, &course.noise, NOISE_KNOWN);
            if known {
                self.take(course, learned)?;
                break;
            }
            let unlikely = self.unlikelihood(course, &weight);
            tried.push((noise, unlikely));
            // Each of two noises may follow from the residuals that the other one leaves: neither is learned any better.
            if let Some(back) = tried.iter().position(|(other, _)| same(&learned, other, NOISE_KNOWN)) {
                let likeliest = tried.drain(back..).min_by(|a, b| a.1.total_cmp(&b.1));
                let Some((noise, _)) = likeliest else { unreachable!("one of them has come back") };
                self.take(course, noise)?;
                break;
            }
            self.take(course, learned)?;
        }
        self.descend_to_the_bottom(course)
    }

    /// Takes residuals in metres as they are where a course ended; with them the noise, where that is another one.
    pub(super) fn take_as_they_are(&mut self, course: &mut Course) -> Result<(), FitError> {
        let larger = self.model.take_as_they_are(&course.point.values);
        if larger > 0.0 {
            let (values, rest) = (std::mem::take(&mut course.point.values), course.point.rest.clone());
            course.point = self.point(values, &course.noise, course.weighting, rest)?;
        }
        if larger > NOISE_KNOWN { self.settle(course) } else { Ok(()) }
    }

    /// Descends with the course's noise until a step means nothing.
    fn descend_to_the_bottom(&mut self, course: &mut Course) -> Result<(), FitError> {
        let noise = course.noise.clone();
        let is_free = self.observations.unknowns.is_some();
        self.descend(course, &noise, if is_free { NEGLIGIBLE_IN_A_FREE_FRAME } else { NEGLIGIBLE })
    }

    /// The length of a step that does not change what the residuals say of the noise: its square is shared by all components. Of few
    /// it stays far below that, as passes cost nothing.
    fn roughly(&self) -> f64 {
        let components = self.layout.components() as f64;
        let share = if components < LONG { NOISE_KNOWN } else { (NOISE_KNOWN / 4.0).sqrt() };
        (share * components.sqrt()).max(ROUGHLY)
    }

    /// Goes on with another noise.
    fn take(&self, course: &mut Course, noise: Arc<Noise>) -> Result<(), FitError> {
        if !same(&noise, &course.noise, SAME_NOISE) {
            let values = std::mem::take(&mut course.point.values);
            let rest = course.point.rest.clone();
            course.point = self.point(values, &noise, course.weighting, rest)?;
            course.noise = noise;
        }
        Ok(())
    }

    /// Twice the negative logarithm of how likely the residuals of rows with weight are with the course's noise, but for a constant.
    fn unlikelihood(&self, course: &Course, weight: &[f64]) -> f64 {
        let sigma = course.noise.sigma_without_memory();
        let counted = self.layout.row_of_each().zip(sigma.iter()).filter(|(row, _)| weight[*row] > 0.0);
        course.point.sweep.tally.objective + 2.0 * counted.map(|(_, sigma)| sigma.ln()).sum::<f64>()
    }

    /// Steps with this noise until one is no longer than `negligible`.
    fn descend(&mut self, course: &mut Course, noise: &Noise, negligible: f64) -> Result<(), FitError> {
        let negligible = negligible.max(self.unresolved(noise));
        let mut damping = 0.0;
        course.stopped = None;
        // Weights that follow many objects' residuals settle slowly, each object's in its own time.
        let has_objects = self.observations.unknowns.is_some();
        let mut mixing = has_objects.then(Mixing::default);
        let mut least = 0.0;
        // Damping holds the errors alone: objects and stations whose step is too long take a share of it.
        let mut share = 1.0_f64;
        let most =
            if has_objects { SLOWER * self.options.max_iterations } else { self.options.max_iterations };
        let mut steps = 0;
        while steps < most {
            steps += 1;
            let point = &course.point;
            let tally = &point.sweep.tally;
            let step = course.subspace.step(&self.partial(&point.sweep), damping, &point.rest);
            let step = step.times(tally.stride());
            if step.length <= negligible && damping < 1e-3 {
                return Ok(());
            }
            let (step, stride) = (step.times(share), tally.stride() * share);
            self.iterations += 1;
            let plain = self.moved(point, &step.change, stride);
            let mixed = mixing.as_mut().filter(|_| damping == 0.0);
            let mixed = mixed.and_then(|mixing| mixing.next(&point.values, &plain));
            let is_mixed = mixed.is_some();
            let values = mixed.unwrap_or(plain);
            let rest = self.rest_at(&values, &course.subspace, &point.rest);
            let next = self.point(values, noise, course.weighting, rest)?;
            if is_mixed && next.objective() > point.objective() * (1.0 + ROUNDING) {
                // The plain step is tried next, from the same point.
                mixing = Some(Mixing::default());
                steps -= 1;
            } else if next.objective() <= point.objective() * (1.0 + 1e-9) {
                let gained = point.objective() - next.objective();
                course.point = next;
                if least > 0.0 && gained <= UNRESOLVED * course.point.objective() {
                    // Steps as long as the rows promise were refused, and shorter ones only creep.
                    course.stopped = Some(Reason::NoDescent);
                    return Ok(());
                }
                damping = if damping < 1e-7 { least } else { damping / 10.0 };
                share = (share / SHORTER).min(1.0);
            } else {
                let is_level = next.objective() <= point.objective() * (1.0 + LEVEL);
                if has_objects && damping == 0.0 && step.length <= ROUGHLY && is_level {
                    // Derivatives leave out what is as small as the residual: no step of theirs leads further down.
                    return Ok(());
                }
                if has_objects && matches!(point.rest, Rest::Prior(_)) {
                    if step.length.powi(2) <= UNRESOLVED * point.objective() {
                        course.stopped = (damping > 0.0).then_some(Reason::NoDescent);
                        return Ok(());
                    }
                    least = DAMPED;
                }
                damping = (damping * 10.0).max(1e-6);
                share = if has_objects { share * SHORTER } else { share };
                if damping > 1e8 {
                    course.stopped = Some(Reason::NoDescent);
                    return Ok(());
                }
            }
        }
        course.stopped = Some(Reason::StepLimit);
        Ok(())
    }

    /// The strain of what the data do not determine at some values, where it counts.
    fn rest_at(&self, values: &[f64], subspace: &Subspace, rest: &Rest) -> Rest {
        match rest {
            Rest::Still => Rest::Still,
            Rest::Prior(_) => Rest::Prior(subspace.strain(&self.deviation(values, subspace))),
        }
    }

    /// Lets what the data do not determine move under its prior. Where that leaves another noise, the data are asked once more: beside
    /// one of rows that were still far off, nothing is determined.
    pub(super) fn release(&mut self, course: &mut Course) -> Result<(), FitError> {
        for _ in 0..NOISE_ROUNDS {
            let asked_with = course.noise.clone();
            self.let_go(course)?;
            if same(&asked_with, &course.noise, SIMILAR_NOISE) {
                break;
            }
            let subspace = self.determined(&course.point.values, &course.noise)?;
            if subspace.rank() <= course.subspace.rank() {
                break;
            }
            let (noise, values) = (course.noise.clone(), self.with_smallest(&course.point.values, &subspace));
            course.point = self.point(values, &noise, course.weighting, Rest::Still)?;
            course.subspace = subspace;
            *course = self.settled(course.clone(), noise)?;
        }
        Ok(())
    }

    /// Lets what the data do not determine move under its prior, where that moves the prediction at all.
    fn let_go(&mut self, course: &mut Course) -> Result<(), FitError> {
        if course.subspace.rank() == course.subspace.parameters() {
            return Ok(());
        }
        let size = self.resolved_sizes(course)?;
        course.subspace = course.subspace.clone().resized(size);
        let values = self.with_smallest(&course.point.values, &course.subspace);
        let rest = Rest::Prior(course.subspace.strain(&self.deviation(&values, &course.subspace)));
        course.point = self.point(values, &course.noise, course.weighting, rest)?;
        let still = course.clone();
        self.descend_to_the_bottom(course)?;
        if !self.leaves_as_much(course, &still) {
            self.settle(course)?;
        }
        if course.stopped.is_some() && still.stopped.is_none() {
            // Products of what is open bend too much for the residual: it stays where it is expected, as uncertain as it is.
            *course = still;
        }
        Ok(())
    }

    /// Whether the residuals of both would teach the same noise, as far as it is ever known.
    fn leaves_as_much(&self, one: &Course, other: &Course) -> bool {
        let left = |course: &Course| course.point.sweep.tally.objective;
        let components = self.layout.components() as f64;
        (left(one) - left(other)).abs() <= NOISE_KNOWN * left(other)
            && (self.used(one) - self.used(other)).abs() <= NOISE_KNOWN * components
    }

    /// The length of a step that only moves the last bits of the prediction.
    fn unresolved(&self, noise: &Noise) -> f64 {
        let resolution = noise::resolution(self.observations);
        let sigma = noise.sigma_without_memory();
        sigma.iter().map(|sigma| (resolution / sigma).powi(2)).sum::<f64>().sqrt()
    }

    /// How much of residuals the estimates of a course follow, each row with its weight.
    pub(super) fn what_is_followed(&self, course: &Course, weight: &[f64]) -> Result<Followed, FitError> {
        let sweep = &course.point.sweep;
        let Some(objects) = self.objects(sweep) else {
            return Ok(Followed::Evenly { used: self.used(course) });
        };
        let root = course.subspace.covariance_root(&self.partial(sweep), &course.point.rest);
        let shares = self.followed(course, weight, &root, objects)?.into_iter();
        Ok(Followed::Each(shares.map(|share| share.by_unknowns + share.by_errors).collect()))
    }

    /// What the residuals say of the noise, each row with its weight.
    fn learn_noise(&self, course: &Course, weight: &[f64]) -> Result<Noise, FitError> {
        let followed = self.what_is_followed(course, weight)?;
        let options = &self.options.noise;
        Ok(noise::estimate(
            self.chain,
            options,
            self.observations,
            &self.layout,
            &course.point.sweep.residual,
            weight,
            &followed,
            &self.brought,
        ))
    }
}
