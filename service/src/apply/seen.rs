//! How directions and points are written and read: as x, y and z, or as two angles.

use std::f64::consts::{PI, TAU};

use model_core::{Chain, ObservableId, ObservableKind, Quantity};
use observe::spherical_of_direction;

use super::uncertain::along;
use crate::refusal::Refusal;

/// How a direction is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum As {
    /// Components x, y and z; points are always written so.
    Vector,
    /// Azimuth from y through x, and elevation above the xy plane.
    AzimuthElevation,
    /// Hour angle and declination, for a chain whose x is west, y the meridian on the equator, z the pole.
    HaDec,
}

/// One observable as its columns have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen {
    observable: ObservableId,
    form: As,
    is_direction: bool,
    /// Names of what is shown, in the form that it is written in.
    parts: Vec<&'static str>,
}

const ARCSEC: f64 = PI / 648_000.0;

impl Seen {
    /// An observable in a form; points have components only.
    ///
    /// # Errors
    /// Angles are asked of a point that was named.
    pub fn new(chain: &Chain, observable: ObservableId, form: As, is_named: bool) -> Result<Self, Refusal> {
        let shown = chain.observable(observable);
        let is_direction = shown.kind == ObservableKind::Direction && shown.is_vector();
        if is_named && !shown.is_vector() && form != As::Vector {
            let name = &shown.name;
            return Err(Refusal::Input(format!(
                "`{name}` shows single readings, which are written as they are; leave --as out, or name a direction with --observable"
            )));
        }
        if is_named && !is_direction && form != As::Vector {
            let name = &shown.name;
            return Err(Refusal::Input(format!(
                "`{name}` is a point, and angles say where a direction goes; leave --as out, or name a direction with --observable"
            )));
        }
        let form = if is_direction { form } else { As::Vector };
        let parts = match form {
            As::Vector => shown.labels().collect(),
            As::AzimuthElevation => vec!["azimuth", "elevation"],
            As::HaDec => vec!["ha", "dec"],
        };
        Ok(Self { observable, form, is_direction, parts })
    }

    /// How many numbers the observable shows.
    pub fn shown(&self, chain: &Chain) -> usize {
        chain.observable(self.observable).shown.len()
    }

    /// Names of the columns that are read, without a unit, and what they measure.
    pub fn read_names(&self, chain: &Chain) -> Vec<(String, Quantity)> {
        let name = &chain.observable(self.observable).name;
        let quantity = match (self.form, self.is_direction) {
            (As::Vector, true) => Quantity::Number,
            (As::Vector, false) => Quantity::Length,
            _ => Quantity::Angle,
        };
        self.parts.iter().map(|part| (format!("{name}_{part}"), quantity)).collect()
    }

    /// Headers of the columns that are written; with the correction if that is wanted.
    pub fn headers(&self, chain: &Chain, correction: bool) -> Vec<String> {
        let name = &chain.observable(self.observable).name;
        let (unit, small) = match self.form {
            As::Vector => ("", ""),
            _ => (" [deg]", " [arcsec]"),
        };
        let own = self.parts.iter().map(|part| format!("{name}_{part}{unit}"));
        let corrections = self.parts.iter().filter(|_| correction);
        own.chain(corrections.map(|part| format!("{name}_{part}_correction{small}"))).collect()
    }

    /// The columns that are written, from the value with the errors and what the errors add to it.
    pub fn columns(&self, value: &[Vec<f64>], error: Option<&[Vec<f64>]>) -> Vec<Vec<f64>> {
        if self.form == As::Vector {
            return value.iter().chain(error.into_iter().flatten()).cloned().collect();
        }
        let rows = value[0].len();
        let mut columns = vec![Vec::with_capacity(rows); if error.is_some() { 4 } else { 2 }];
        for row in 0..rows {
            let at = [0, 1, 2].map(|axis: usize| value[axis][row]);
            let angles = angles(at);
            columns[0].push(angles[0].to_degrees());
            columns[1].push(angles[1].to_degrees());
            if let Some(error) = error {
                let turned = turn(at, [0, 1, 2].map(|axis: usize| error[axis][row]));
                columns[2].push(turned[0] / ARCSEC);
                columns[3].push(turned[1] / ARCSEC);
            }
        }
        columns
    }

    /// Headers of the standard uncertainties: of each angle in arc seconds, of each component in its own unit.
    pub fn uncertainty_headers(&self, chain: &Chain) -> Vec<String> {
        let name = &chain.observable(self.observable).name;
        let small = if self.form == As::Vector { "" } else { " [arcsec]" };
        self.parts.iter().map(|part| format!("{name}_{part}_uncertainty{small}")).collect()
    }

    /// The standard uncertainty of each column, from the value with the errors and its [covariance](super::Uncertain::columns).
    pub fn uncertainties(&self, value: &[Vec<f64>], covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let rows = value[0].len();
        if self.form == As::Vector {
            let count = value.len();
            let own =
                |at: usize| (0..rows).map(|row| covariance[at * count + at][row].max(0.0).sqrt()).collect();
            return (0..count).map(own).collect();
        }
        let mut columns = [Vec::with_capacity(rows), Vec::with_capacity(rows)];
        for (row, ((x, y), z)) in value[0].iter().zip(&value[1]).zip(&value[2]).enumerate() {
            let (x, y, z) = (*x, *y, *z);
            let flat = x.hypot(y);
            let square = flat * flat + z * z;
            // Of atan2(x, y), and of the elevation above the xy plane.
            let azimuth = [y / (flat * flat), -x / (flat * flat), 0.0];
            let elevation = [-x * z / (flat * square), -y * z / (flat * square), flat / square];
            for (column, gradient) in columns.iter_mut().zip([azimuth, elevation]) {
                column.push(along(&gradient, covariance, row) / ARCSEC);
            }
        }
        columns.into()
    }

    /// The vector that columns say, as they were read: of length one for a direction.
    pub fn vector(&self, columns: &[&[f64]], row: usize) -> [f64; 3] {
        match self.form {
            As::Vector => {
                let vector = [0, 1, 2].map(|axis: usize| columns[axis][row]);
                let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
                if self.is_direction { vector.map(|part| part / length) } else { vector }
            }
            _ => {
                let ((sin_a, cos_a), (sin_e, cos_e)) = (columns[0][row].sin_cos(), columns[1][row].sin_cos());
                [sin_a * cos_e, cos_a * cos_e, sin_e]
            }
        }
    }
}

/// Azimuth and elevation of a vector, rad: azimuth from 0 to 2π, hour angle the same.
fn angles(vector: [f64; 3]) -> [f64; 2] {
    let [azimuth_rad, elevation_rad] = spherical_of_direction(&vector.into());
    [azimuth_rad.rem_euclid(TAU), elevation_rad]
}

/// By how much azimuth and elevation grew when `added` was added to make `v`, rad, without losing the digits of a small turn.
fn turn(v: [f64; 3], added: [f64; 3]) -> [f64; 2] {
    let before = [0, 1, 2].map(|axis: usize| v[axis] - added[axis]);
    // sin and cos of the difference of two azimuths, times both lengths.
    let sine = added[0] * v[1] - v[0] * added[1];
    let cosine = before[0] * v[0] + before[1] * v[1];
    let (flat, flat_before) = (v[0].hypot(v[1]), before[0].hypot(before[1]));
    let flat_added = if flat + flat_before > 0.0 {
        (added[0] * (v[0] + before[0]) + added[1] * (v[1] + before[1])) / (flat + flat_before)
    } else {
        0.0
    };
    let up_sine = added[2] * flat - v[2] * flat_added;
    let up_cosine = flat * flat_before + v[2] * before[2];
    [sine.atan2(cosine), up_sine.atan2(up_cosine)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_the_difference_of_the_angles() {
        let direction = |a: f64, e: f64| [a.sin() * e.cos(), a.cos() * e.cos(), e.sin()];
        for (a, e, da, de) in
            [(0.3, 0.5, 1e-3, -2e-3), (3.1, -1.2, 0.2, 0.1), (6.27, 0.0, 0.02, 1e-9), (-2.0, 1.4, 0.0, 0.0)]
        {
            let (from, to) = (direction(a, e), direction(a + da, e + de));
            let added = [0, 1, 2].map(|axis: usize| to[axis] - from[axis]);
            let [grown_a, grown_e] = turn(to, added);
            assert!(
                (grown_a - da).abs() < 1e-14 && (grown_e - de).abs() < 1e-14,
                "{a} {e}: {grown_a} {grown_e}"
            );
            let [there_a, there_e] = angles(to);
            assert!((there_a - (a + da).rem_euclid(TAU)).abs() < 1e-14 && (there_e - (e + de)).abs() < 1e-14);
        }
    }
}
