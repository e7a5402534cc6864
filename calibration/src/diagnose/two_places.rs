//! Objects whose rows lie at two places: two sockets, two targets or two walls under one label.

use model_core::Chain;
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use fit::FitResult;
use network::{Row, rows, tells};
use observe::Observations;
use observe::unknowns::Shape;

/// About two places rows have less than this share of the variance that they have about one; noise leaves a third.
const ABOUT: f64 = 0.01;

/// Rows at the place with fewer, at least, and as a share of all.
const FEWEST: usize = 3;
const SHARE: f64 = 0.1;

/// What lies at two places.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TwoPlaces {
    /// The object whose places are furthest apart.
    pub label: String,
    /// How far, m.
    pub apart_m: f64,
    /// Its rows at the one place, and at the other.
    pub rows: [usize; 2],
    /// Objects that lie at two places, of how many.
    pub objects: [usize; 2],
}

/// The object whose places are furthest apart; `None` where each lies at one.
pub(super) fn two_places(chain: &Chain, observations: &Observations, fit: &FitResult) -> Option<TwoPlaces> {
    let unknowns = observations.unknowns.as_ref()?;
    let there = unknowns.at(unknowns.state(&fit.values));
    let mut points: Vec<Vec<Vector3<f64>>> = vec![Vec::new(); there.objects.len()];
    // Those that were set aside are told as that.
    let counts = |row: &Row| fit.residuals.weight[row.number] > 0.0;
    for row in rows(chain, observations, unknowns, &fit.values).iter().filter(|row| counts(row)) {
        let object = &there.objects[row.object];
        let off = there.stations[row.station].pose.apply(&row.point) - object.place;
        match object.shape {
            // Along a plane rows may lie where they like.
            Shape::Plane => points[row.object].push(object.normal * object.normal.dot(&off)),
            Shape::Point if tells(row) => points[row.object].push(off),
            Shape::Point | Shape::Wire | Shape::Circle | Shape::Ring => {}
        }
    }
    let seen = points.iter().filter(|own| !own.is_empty()).count();
    let apart = points.iter().enumerate().filter_map(|(object, own)| Some((object, split(own)?)));
    let apart: Vec<(usize, (f64, [usize; 2]))> = apart.collect();
    let objects = [apart.len(), seen];
    let furthest = apart.into_iter().max_by(|one, other| one.1.0.total_cmp(&other.1.0))?;
    let (object, (apart_m, rows)) = furthest;
    Some(TwoPlaces { label: there.objects[object].label.clone(), apart_m, rows, objects })
}

/// How far apart two places are that points lie at, and how many at each; `None` where they lie about one.
fn split(points: &[Vector3<f64>]) -> Option<(f64, [usize; 2])> {
    let count = points.len();
    let middle = points.iter().sum::<Vector3<f64>>() / count as f64;
    let squares: Matrix3<f64> =
        points.iter().map(|point| (point - middle) * (point - middle).transpose()).sum();
    let eigen = squares.symmetric_eigen();
    let longest = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let mut along: Vec<f64> = points.iter().map(|point| longest.dot(&(point - middle))).collect();
    along.sort_by(f64::total_cmp);
    let whole: f64 = along.iter().map(|value| value * value).sum();
    let least = FEWEST.max((SHARE * count as f64).ceil() as usize);
    let (mut sum, mut best) = (0.0, None::<(f64, usize)>);
    for (at, value) in along.iter().enumerate() {
        sum += value;
        let (below, above) = (at + 1, count - at - 1);
        if below < least || above < least {
            continue;
        }
        // What lies between the two means: the sum of all is zero.
        let between = sum * sum / below as f64 + sum * sum / above as f64;
        if best.is_none_or(|(most, _)| between > most) {
            best = Some((between, below));
        }
    }
    let (between, below) = best.filter(|(between, _)| whole - between < ABOUT * whole)?;
    let above = count - below;
    // between = below · above / count · apart².
    let apart = (between * count as f64 / (below as f64 * above as f64)).sqrt();
    Some((apart, [below, above]))
}
