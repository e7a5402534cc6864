//! Uncertainty of the reference: errors that many rows have in common, as unknowns of the fit with a stated size.
//!
//! Each input is a number that is zero but for its standard uncertainty. The fit looks for errors and inputs together: what it finds of the
//! inputs is taken out of what was measured, and the errors are fitted again. Their covariance is that of errors and inputs together, so
//! that each input counts once: what the rows show of it is no longer in their noise, and what they cannot show is in the ±.
//!
//! Source: JCGM 100:2008 (GUM), 5.2, correlated inputs; of unknowns with a stated size, C. R. Henderson, Biometrics 31 (1975) 423-447.

use std::collections::BTreeMap;

use faer::Mat;
use nalgebra::{UnitQuaternion, Vector3};

use super::FitError;
use observe::{Measured, Observations};

/// Targets at most that several rows have in common: each is three unknowns.
const TARGETS: usize = 300;

/// Standard uncertainties of what rows are compared with; zero where nothing is stated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reference {
    /// Of the scale of all lengths, as a share.
    pub scale: f64,
    /// Of each coordinate of a target, common to its rows, m.
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

/// What an input does to the estimates.
#[derive(Debug, Clone)]
pub struct FromReference {
    /// Which.
    pub input: Input,
    /// Its standard uncertainty: a share, rad or m.
    pub sigma: f64,
    /// By how much each parameter follows one standard uncertainty of each of its numbers, p × numbers, SI.
    pub followed: Mat<f64>,
}

impl FromReference {
    /// What it adds to the covariance of the estimates, p × p, SI.
    #[must_use]
    pub fn covariance(&self) -> Mat<f64> {
        &self.followed * self.followed.transpose()
    }

    /// What it adds to the standard uncertainty of a combination of parameters, each by its place with its factor, SI.
    #[must_use]
    pub fn contribution(&self, combination: &[(usize, f64)]) -> f64 {
        let of = |number: usize| -> f64 {
            combination.iter().map(|&(at, factor)| factor * self.followed[(at, number)]).sum()
        };
        (0..self.followed.ncols()).map(|number| of(number).powi(2)).sum::<f64>().sqrt()
    }
}

/// A way to move what was measured.
#[derive(Debug, Clone, Copy)]
pub(super) enum Moved {
    Stretched,
    Turned(usize),
    Shifted(usize),
}

impl Moved {
    pub fn of(self, measured: &Measured, step: f64) -> Measured {
        let along = |axis: usize| Vector3::from_fn(|own, _| if own == axis { step } else { 0.0 });
        match self {
            Self::Stretched => measured.stretched(1.0 + step),
            Self::Turned(axis) => measured.turned(&UnitQuaternion::new(along(axis))),
            Self::Shifted(axis) => measured.shifted(&along(axis)),
        }
    }
}

pub(super) const AXES: [usize; 3] = [0, 1, 2];

/// The inputs of a fit: those common to all rows, and behind them three of each target.
#[derive(Debug, Clone)]
pub(super) struct Inputs {
    pub common: Vec<(Input, Moved, f64)>,
    pub targets_m: f64,
    /// Of each row its target, where it shares one.
    pub target_of: Vec<Option<usize>>,
    pub targets: usize,
    /// What was found of each so far, in its standard uncertainties.
    pub found: Vec<f64>,
    /// How many independent numbers of the data they use up.
    pub used: f64,
}

impl Inputs {
    pub fn of(observations: &Observations, reference: &Reference) -> Result<Self, FitError> {
        let stretched = [(Input::Scale, Moved::Stretched, reference.scale)];
        let turned = AXES.map(|axis| (Input::Rotation, Moved::Turned(axis), reference.rotation_rad));
        let shifted = AXES.map(|axis| (Input::Shift, Moved::Shifted(axis), reference.shift_m));
        let common: Vec<_> =
            stretched.into_iter().chain(turned).chain(shifted).filter(|(.., sigma)| *sigma > 0.0).collect();
        let (target_of, targets) = match reference.targets_m > 0.0 {
            true => targets(observations),
            false => (vec![None; observations.rows()], 0),
        };
        if targets > TARGETS {
            return Err(FitError::TooManyTargets { targets, most: TARGETS });
        }
        let found = vec![0.0; common.len() + 3 * targets];
        Ok(Self { common, targets_m: reference.targets_m, target_of, targets, found, used: 0.0 })
    }

    /// What was measured without what was found of the inputs.
    pub fn taken_from(&self, observations: &Observations) -> Observations {
        let mut own = observations.clone();
        let of_targets = self.common.len();
        for (measured, target) in own.measured.iter_mut().zip(&self.target_of) {
            if let Some(target) = target {
                let first = of_targets + 3 * target;
                let by = Vector3::from_fn(|axis, _| -self.targets_m * self.found[first + axis]);
                *measured = measured.shifted(&by);
            }
            for ((_, moved, sigma), found) in self.common.iter().zip(&self.found) {
                *measured = moved.of(measured, -sigma * found);
            }
        }
        own
    }

    /// The inputs by their kinds, each with its standard uncertainty and its places among all.
    pub fn kinds(&self) -> Vec<(Input, f64, Vec<usize>)> {
        let mut kinds: Vec<(Input, f64, Vec<usize>)> = Vec::new();
        for (at, (input, _, sigma)) in self.common.iter().enumerate() {
            match kinds.last_mut().filter(|(known, ..)| known == input) {
                Some((.., places)) => places.push(at),
                None => kinds.push((*input, *sigma, vec![at])),
            }
        }
        if self.targets > 0 {
            kinds.push((Input::Targets, self.targets_m, (self.common.len()..self.found.len()).collect()));
        }
        kinds
    }
}

/// The target of each row that shares one with another, and how many there are. A target of one row is in the noise of that row.
fn targets(observations: &Observations) -> (Vec<Option<usize>>, usize) {
    let label = |row: usize| match observations.targets.get(row) {
        Some(&label) => vec![u64::from(label)],
        // Zero has two signs.
        None => observations.measured[row].numbers().iter().map(|number| (number + 0.0).to_bits()).collect(),
    };
    let mut rows_of: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    let is_point = |row: &usize| observations.measured[*row].point_m().is_some();
    for row in (0..observations.rows()).filter(is_point) {
        rows_of.entry(label(row)).or_default().push(row);
    }
    let mut target_of = vec![None; observations.rows()];
    let mut count = 0;
    for rows in rows_of.values().filter(|rows| rows.len() > 1) {
        rows.iter().for_each(|&row| target_of[row] = Some(count));
        count += 1;
    }
    (target_of, count)
}

/// What the inputs do at the end of a course.
pub(super) struct Followed {
    /// What is found of each, in its standard uncertainties.
    pub found: Vec<f64>,
    pub used: f64,
    pub parts: Vec<FromReference>,
    /// What the noise of the rows adds to the covariance because they say something of the inputs too, p × p, SI.
    pub noise: Mat<f64>,
}
