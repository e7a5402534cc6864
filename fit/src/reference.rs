//! Uncertainty of the reference: what is common to many rows, and what it adds to the uncertainty of the estimates.
//!
//! Residuals say nothing of it, since the estimates follow: a base tilts as the frame does that it was measured in. So each input is moved
//! by a little, the estimates follow by the regression at the fit, and what they do is added to their covariance.
//!
//! Source: JCGM 100:2008 (GUM), 5.2, the law of propagation with correlated inputs.

use std::collections::BTreeMap;

use faer::Mat;
use nalgebra::{UnitQuaternion, Vector3};

use super::solver::{Course, Solver};
use super::sweep::residuals;
use super::{FitError, Partial};
use observe::Measured;

/// By how much an input is moved to either side: a share, rad or m.
const STEP: f64 = 1e-6;

/// Standard uncertainties of what rows are compared with; zero where nothing is stated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reference {
    /// Of the scale of all lengths, as a share.
    pub scale: f64,
    /// Of each coordinate of a point, common to the rows that have the same coordinates, m.
    pub targets_m: f64,
    /// Of the frame's rotation about each axis, rad.
    pub rotation_rad: f64,
    /// Of the frame's origin along each axis, m.
    pub shift_m: f64,
}

/// An input of the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// The scale of all lengths.
    Scale,
    /// The coordinates of targets.
    Targets,
    /// The rotation of the frame.
    Rotation,
    /// Its origin.
    Shift,
}

/// What an input adds to the covariance of the estimates.
#[derive(Debug, Clone)]
pub struct FromReference {
    /// Which.
    pub input: Input,
    /// Its standard uncertainty: a share, rad or m.
    pub sigma: f64,
    /// p × p, SI.
    pub covariance: Mat<f64>,
}

/// A way to move what was measured.
#[derive(Debug, Clone, Copy)]
enum Moved {
    Stretched,
    Turned(usize),
    Shifted(usize),
}

impl Moved {
    fn of(self, measured: &Measured, step: f64) -> Measured {
        let along = |axis: usize| Vector3::from_fn(|own, _| if own == axis { step } else { 0.0 });
        match self {
            Self::Stretched => measured.stretched(1.0 + step),
            Self::Turned(axis) => measured.turned(&UnitQuaternion::new(along(axis))),
            Self::Shifted(axis) => measured.shifted(&along(axis)),
        }
    }
}

impl Solver<'_> {
    /// What each stated input adds to the covariance of a course's estimates; `full` is the factor of the rows that count.
    pub(super) fn from_reference(
        &self,
        course: &Course,
        weight: &[f64],
        full: &Partial,
    ) -> Result<Vec<FromReference>, FitError> {
        let Some(reference) = self.options.reference else { return Ok(Vec::new()) };
        let counted: Vec<f64> = weight.iter().map(|weight| f64::from(u8::from(*weight > 0.0))).collect();
        let root = course.subspace.covariance_root(full, &course.point.rest);
        let q = self.coordinates(course, &counted, &root)?.q;
        let follows = |column: &[f64]| -> Mat<f64> {
            let column = Mat::from_fn(column.len(), 1, |row, _| column[row]);
            &root * (q.transpose() * column)
        };
        let spread = |moved: &[Moved], sigma: f64| -> Result<Mat<f64>, FitError> {
            let p = root.nrows();
            moved.iter().try_fold(Mat::zeros(p, p), |sum, &moved| {
                let own = follows(&self.moves(course, &counted, moved)?) * faer::Scale(sigma);
                Ok(sum + &own * own.transpose())
            })
        };
        let (turned, shifted) = ([0, 1, 2].map(Moved::Turned), [0, 1, 2].map(Moved::Shifted));
        let mut all = Vec::new();
        let inputs: [(Input, f64, &[Moved]); 3] = [
            (Input::Scale, reference.scale, &[Moved::Stretched]),
            (Input::Rotation, reference.rotation_rad, &turned),
            (Input::Shift, reference.shift_m, &shifted),
        ];
        for (input, sigma, moved) in inputs.into_iter().filter(|(_, sigma, _)| *sigma > 0.0) {
            all.push(FromReference { input, sigma, covariance: spread(moved, sigma)? });
        }
        let sigma = reference.targets_m;
        if sigma > 0.0 {
            let target_of = self.targets();
            let targets = target_of.iter().max().map_or(0, |last| last + 1);
            let p = root.nrows();
            let mut covariance = Mat::zeros(p, p);
            for moved in shifted {
                let column = self.moves(course, &counted, moved)?;
                let mut scores = Mat::<f64>::zeros(q.ncols(), targets);
                for (at, value) in column.iter().enumerate() {
                    let target = target_of[self.layout.row(at)];
                    (0..q.ncols()).for_each(|j| scores[(j, target)] += q[(at, j)] * value);
                }
                let own = &root * scores * faer::Scale(sigma);
                covariance += &own * own.transpose();
            }
            all.push(FromReference { input: Input::Targets, sigma, covariance });
        }
        Ok(all)
    }

    /// What a unit of a movement does to each component, whitened; rows that do not count have none.
    fn moves(&self, course: &Course, counted: &[f64], moved: Moved) -> Result<Vec<f64>, FitError> {
        let at = |step: f64| {
            let mut observations = self.observations.clone();
            observations.measured.iter_mut().for_each(|own| *own = moved.of(own, step));
            residuals(self.plain(), &observations, &course.point.values)
        };
        let (above, below) = (at(STEP)?, at(-STEP)?);
        let sigma = course.noise.sigma_without_memory();
        let each = above.iter().zip(&below).zip(sigma.iter()).enumerate();
        let own = each.map(|(at, ((above, below), sigma))| match counted[self.layout.row(at)] {
            0.0 => 0.0,
            _ => (above - below) / (2.0 * STEP * sigma),
        });
        Ok(own.map(|value| if value.is_finite() { value } else { 0.0 }).collect())
    }

    /// The target of each row: rows with the same coordinates have one.
    fn targets(&self) -> Vec<usize> {
        let mut known: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
        let number = |measured: &Measured| {
            let key = measured.numbers().iter().map(|number| number.to_bits()).collect();
            let next = known.len();
            *known.entry(key).or_insert(next)
        };
        self.observations.measured.iter().map(number).collect()
    }
}
