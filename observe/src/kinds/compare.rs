//! Rows of one series beside what the chain predicts for them, and what a kind of observation makes of the two.
//!
//! A kind hands in what it makes of one row; the loop over rows stands here and is compiled for each kind.

use nalgebra::Vector3;

use super::measured::Measured;
use super::residual::{Component, Part};
use super::seeing::{Seeing, TurnsBy, adjusted};
use crate::unknowns::{State, WIDTH};

/// Consecutive rows of one series.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a> {
    /// How many.
    pub count: usize,
    /// What the chain predicts: x, y, z of each of its vectors, an array of all rows for each.
    pub predicted: &'a [f64],
    /// What was measured; `None` where poses alone are seen: residuals are zero then.
    pub measured: Option<&'a [Measured]>,
    /// What is unknown, if anything is.
    pub unknown: Option<Unknown<'a>>,
    /// Which way each row was seen, of any length, or for a sight from a point of the chain all of the beam: three arrays of all rows.
    pub beams: Option<&'a [f64]>,
}

/// What rows have to do with that is unknown.
#[derive(Debug, Clone, Copy)]
pub struct Unknown<'a> {
    /// Objects and stations with their numbers.
    pub state: &'a State<'a>,
    /// Which row of the observations is the first.
    pub start: usize,
    /// What turns with a station.
    pub turns_by: TurnsBy,
}

/// What is made of rows. Arrays hold all rows of the first component, then all of the second.
#[derive(Debug)]
pub struct Compared<'a> {
    /// Measured minus predicted, rad or m; 0 where the chain has no finite value.
    pub residual: &'a mut [f64],
    /// Per row, whether the chain has a finite value there.
    pub defined: &'a mut Vec<bool>,
    /// Gradient of each predicted component by x, y, z of each vector that the chain predicts: an array of rows for each.
    pub gradient: &'a mut [f64],
    /// Per row and component the derivatives of what is predicted by what is unknown of object and station; none are written where
    /// nothing is.
    pub unknown: &'a mut Vec<[f64; WIDTH]>,
}

/// A row that is none of its kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("it measures something else than its series, or observes an object that is none")]
pub struct Mismatch {
    /// Which, counted from 0 among those that were compared.
    pub row: usize,
}

impl Rows<'_> {
    /// What the chain predicts for a row.
    pub(super) fn at(&self, row: usize) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| self.predicted[axis * self.count + row])
    }

    /// Compares rows that observe nothing unknown: `of` says the components of what was measured, `exactly` what would be measured
    /// where the chain is right.
    pub(super) fn each<const M: usize>(
        &self,
        to: &mut Compared<'_>,
        of: impl Fn(&Measured, &Vector3<f64>) -> Option<[Part; M]>,
        exactly: impl Fn(&Vector3<f64>) -> Measured,
    ) -> Result<(), Mismatch> {
        for row in 0..self.count {
            let predicted = self.at(row);
            let measured = self.measured.map_or_else(|| exactly(&predicted), |measured| measured[row]);
            let parts = of(&measured, &predicted).ok_or(Mismatch { row })?;
            to.put(self.count, row, &parts);
        }
        self.nothing_unknown::<M>(to);
        Ok(())
    }

    /// The rows hang on nothing unknown, though others may.
    pub(super) fn nothing_unknown<const M: usize>(&self, to: &mut Compared<'_>) {
        if self.unknown.is_some() {
            to.unknown.resize(M * self.count, [0.0; WIDTH]);
        }
    }

    /// Compares rows that observe objects: `of` says the components of a row by what is predicted and the beam.
    pub(super) fn each_seen<const M: usize>(
        &self,
        to: &mut Compared<'_>,
        of: impl Fn(&Seeing<'_>, &Vector3<f64>, &Vector3<f64>) -> Option<[Component; M]>,
    ) -> Result<(), Mismatch> {
        for row in 0..self.count {
            let predicted = self.at(row);
            let beam = self
                .beams
                .map_or(predicted, |beams| Vector3::from_fn(|axis, _| beams[axis * self.count + row]));
            let seen = || {
                let unknown = self.unknown?;
                let measured = &self.measured?[row];
                let seeing = Seeing::new(unknown.state, unknown.start + row, measured, unknown.turns_by)?;
                let seen = of(&seeing, &predicted, &beam)?;
                match unknown.turns_by {
                    TurnsBy::Adjusted => adjusted(seen, &predicted, &beam, |p, beam| of(&seeing, p, beam)),
                    TurnsBy::Object | TurnsBy::Prediction => Some(seen),
                }
            };
            let components = seen().ok_or(Mismatch { row })?;
            to.put(self.count, row, &components.map(|own| own.part));
            to.unknown.extend(components.map(|own| own.unknown));
        }
        Ok(())
    }
}

impl Compared<'_> {
    /// Writes down what is left of a row, of so many.
    fn put<const M: usize>(&mut self, count: usize, row: usize, parts: &[Part; M]) {
        let is_defined = parts.iter().all(|(residual, _)| residual.is_finite());
        self.defined.push(is_defined);
        for (component, (residual, gradient)) in parts.iter().enumerate() {
            self.residual[component * count + row] = if is_defined { *residual } else { 0.0 };
            for axis in 0..3 {
                self.gradient[(3 * component + axis) * count + row] = gradient[axis];
            }
        }
    }
}
