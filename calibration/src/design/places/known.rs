//! What the rows so far tell of the errors, the stations and the objects together: one covariance of all their numbers.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Vector3};

use super::seen::Seen;
use fit::noise::Layout;
use fit::{FitError, FitResult, Model};
use observe::Observations;
use observe::unknowns::{Freedom, OF_OBJECT, Shape, Unknowns, WIDTH};

/// Objects that a new station may aim at, those with the most rows; all others are eliminated, as a fit does.
const AIMED_AT: usize = 150;

/// How far what nobody knows may be turned, rad, and where it may be, as a share of how far apart things are: so much more than
/// rows leave open that it tells nothing, and not so much that digits are lost.
const ANY: f64 = 0.1;

/// All numbers that an addition can have to do with.
pub(super) struct Known {
    /// Errors first, in the order of the fit's parameters.
    pub covariance: DMatrix<f64>,
    pub errors: usize,
    /// Where the numbers of each station and each object begin in the covariance; none where it is known or has no part.
    pub stations: Vec<Option<usize>>,
    pub objects: Vec<Option<usize>>,
    /// Objects and stations where the fit has them.
    pub unknowns: Unknowns,
    /// How far apart things are, m: what nobody knows is somewhere within.
    pub extent_m: f64,
}

/// What is known of numbers before any row: one over their standard deviations.
pub(super) fn roots(freedom: Freedom, turns: [bool; 6], extent_m: f64) -> [f64; 6] {
    let (shift_m, turn_rad) = match freedom {
        Freedom::Within { shift_m, turn_rad } => (shift_m, turn_rad),
        Freedom::Free | Freedom::Given => (ANY * extent_m, ANY),
    };
    turns.map(|turn| 1.0 / if turn { turn_rad } else { shift_m })
}

/// Which numbers of a station are turns.
pub(super) const OF_STATION: [bool; 6] = [false, false, false, true, true, true];

/// Which numbers of an object are turns.
pub(super) fn of_object(shape: Shape) -> [bool; 6] {
    let tilts = matches!(shape, Shape::Plane | Shape::Circle | Shape::Ring);
    [tilts, tilts, false, false, false, false]
}

impl Known {
    /// `values` are those of the fit, objects and stations where the observations have them; `sizes` those of the errors as far
    /// as the study says.
    pub fn of(
        model: &Model,
        observations: &Observations,
        unknowns: &Unknowns,
        fit: &FitResult,
        values: &[f64],
        sizes: &[f64],
        extent_m: f64,
    ) -> Result<Self, FitError> {
        let layout = Layout::of(observations);
        let sigma = fit.noise.sigma_without_memory();
        let root: Vec<f64> = sigma
            .iter()
            .zip(layout.row_of_each())
            .map(|(sigma, row)| fit.residuals.weight[row].sqrt() / sigma)
            .collect();
        let seen = Seen::of(model, observations, &layout, values, &root)?;
        let errors = sizes.len();
        let mut next = errors;
        let mut place = |numbers: usize| {
            next += numbers;
            (numbers > 0).then_some(next - numbers)
        };
        let stations: Vec<Option<usize>> =
            unknowns.stations.iter().map(|station| place(station.numbers())).collect();
        let mut rows = vec![0_usize; unknowns.objects.len()];
        unknowns.object.iter().flatten().for_each(|&object| rows[object as usize] += 1);
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by_key(|&object| (std::cmp::Reverse(rows[object]), object));
        let mut objects = vec![None; rows.len()];
        for &object in order.iter().take(AIMED_AT) {
            objects[object] = place(unknowns.objects[object].numbers());
        }
        let mut information = DMatrix::zeros(next, next);
        let mut of_object: BTreeMap<Option<u32>, Vec<&Seen>> = BTreeMap::new();
        for one in &seen {
            of_object.entry(unknowns.object[one.row]).or_default().push(one);
        }
        for (at, size) in sizes.iter().enumerate() {
            information[(at, at)] += size.powi(-2);
        }
        for (station, &start) in unknowns.stations.iter().zip(&stations) {
            let Some(start) = start else { continue };
            for (number, root) in roots(station.freedom, OF_STATION, extent_m).into_iter().enumerate() {
                information[(start + number, start + number)] += root * root;
            }
        }
        for (object, seen) in of_object {
            let (own, thing) = match object {
                Some(object) => (objects[object as usize], Some(&unknowns.objects[object as usize])),
                None => (None, None),
            };
            let k = thing.map_or(0, |thing| thing.numbers());
            let mut known: Vec<usize> = (0..errors).collect();
            for one in &seen {
                let start = stations[unknowns.station[one.row] as usize];
                let Some(start) = start.filter(|start| object.is_some() && !known.contains(start)) else {
                    continue;
                };
                known.extend(start..start + WIDTH - OF_OBJECT);
            }
            // The object's numbers first.
            let mut rows = DMatrix::zeros(seen.len(), k + known.len());
            for (i, one) in seen.iter().enumerate() {
                (0..k).for_each(|j| rows[(i, j)] = one.unknown[j]);
                one.errors.iter().enumerate().for_each(|(j, value)| rows[(i, k + j)] = *value);
                let Some(start) = stations[unknowns.station[one.row] as usize].filter(|_| object.is_some())
                else {
                    continue;
                };
                let Some(first) = known.iter().position(|&at| at == start) else {
                    unreachable!("every station of these rows is among what they know")
                };
                (0..WIDTH - OF_OBJECT).for_each(|j| rows[(i, k + first + j)] = one.unknown[OF_OBJECT + j]);
            }
            let mut normal = rows.transpose() * &rows;
            if let Some(thing) = thing {
                let roots = roots(thing.freedom, self::of_object(thing.shape), extent_m);
                (0..k).for_each(|j| normal[(j, j)] += roots[j] * roots[j]);
            }
            let (kept, places) = match own {
                Some(start) => (normal, (start..start + k).chain(known).collect::<Vec<_>>()),
                None => (without_first(&normal, k), known),
            };
            for (i, &to) in places.iter().enumerate() {
                for (j, &other) in places.iter().enumerate() {
                    information[(to, other)] += kept[(i, j)];
                }
            }
        }
        let covariance = inverse(information)
            .ok_or_else(|| FitError::WrongShape { why: "the information so far is not finite".to_owned() })?;
        Ok(Self { covariance, errors, stations, objects, unknowns: unknowns.clone(), extent_m })
    }

    /// The covariance of the errors alone.
    pub fn of_errors(&self) -> DMatrix<f64> {
        self.covariance.view((0, 0), (self.errors, self.errors)).into_owned()
    }
}

/// A normal matrix once its first numbers have followed all others.
fn without_first(normal: &DMatrix<f64>, k: usize) -> DMatrix<f64> {
    let rest = normal.ncols() - k;
    let behind = normal.view((k, k), (rest, rest)).into_owned();
    if k == 0 {
        return behind;
    }
    let Some(inverse) = inverse(normal.view((0, 0), (k, k)).into_owned()) else { return behind };
    let across = normal.view((0, k), (k, rest));
    behind - across.transpose() * inverse * across
}

/// The inverse of a normal matrix, each number in units of its own information.
pub(super) fn inverse(mut normal: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scale: Vec<f64> = normal.diagonal().iter().map(|value| value.sqrt().recip()).collect();
    let scaled = |matrix: &mut DMatrix<f64>| {
        for (i, row) in scale.iter().enumerate() {
            scale.iter().enumerate().for_each(|(j, column)| matrix[(i, j)] *= row * column);
        }
    };
    scaled(&mut normal);
    let mut inverse = normal.cholesky()?.inverse();
    scaled(&mut inverse);
    Some(inverse)
}

/// How far apart the places of things are, at least 1 m.
pub(super) fn extent(places: impl Iterator<Item = Vector3<f64>> + Clone) -> f64 {
    let ends = |axis: usize, start: f64, choose: fn(f64, f64) -> f64| {
        places.clone().map(|place| place[axis]).fold(start, choose)
    };
    let size = |axis| ends(axis, f64::NEG_INFINITY, f64::max) - ends(axis, f64::INFINITY, f64::min);
    Vector3::new(size(0), size(1), size(2)).norm().max(1.0)
}
