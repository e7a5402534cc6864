//! Where objects and stations came out, and how surely.
//!
//! Where nothing holds the frame it is that of one station, which then is exact: coordinates are from there. The uncertainties are
//! those of the rows' own noise, which is as large as the residuals say, and of the errors, which objects and stations follow.

use faer::{Mat, Side};
use model_core::Chain;
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use fit::noise::Layout;
use fit::objects::Spread;
use fit::sweep::{Weighting, eliminated};
use fit::{FitError, FitResult, Model};
use observe::Observations;
use observe::unknowns::{Freedom, Known, Object, Pose, Shape, Station, Unknowns};

/// How surely what stands in for a frame is where it is, m and rad: so that nothing else sees it move.
const HELD: f64 = 1e-10;

/// Where a station is anywhere, m.
const ANYWHERE_M: f64 = 1e6;

/// Where everything came out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Placed {
    /// The stations that rows name.
    pub stations: Vec<PlacedStation>,
    /// The objects.
    pub objects: Vec<PlacedObject>,
}

/// What the data had to say about a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// Nothing: the study says that it is there.
    Exact,
    /// Something, beside what the study states with an uncertainty.
    Stated,
    /// All.
    Estimated,
    /// Nothing: it is the frame of the others, which nothing holds.
    Frame,
}

/// A station, in the objects' frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlacedStation {
    /// Its label.
    pub station: String,
    /// Where its pose is from.
    pub origin: Origin,
    /// x, y, z, m.
    pub place_m: [f64; 3],
    /// Roll, pitch, heading, rad.
    pub turns_rad: [f64; 3],
    /// The standard uncertainty of each coordinate, m; none of what nothing holds.
    pub place_uncertainties_m: [Option<f64>; 3],
    /// The same of each turn, rad.
    pub turn_uncertainties_rad: [Option<f64>; 3],
    /// Its rows.
    pub rows: usize,
    /// Those of them that were set aside.
    pub rows_set_aside: usize,
}

/// An object, in the objects' frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlacedObject {
    /// Its label.
    pub object: String,
    /// What it is: `point`, `plane`, `circle`, `wire`, `sphere`.
    pub kind: &'static str,
    /// Where its place is from.
    pub origin: Origin,
    /// The point, the anchor, the centre; of a plane a point amid its rows; m.
    pub place_m: [f64; 3],
    /// The standard uncertainty of each coordinate, m; none of what nothing holds, and of a point of a plane.
    pub place_uncertainties_m: [Option<f64>; 3],
    /// The normal of a plane, the axis of a circle.
    pub normal: Option<[f64; 3]>,
    /// How far the normal or the axis may lean in the direction that is known worst, as a standard uncertainty, rad.
    pub normal_uncertainty_rad: Option<f64>,
    /// How far a plane is from the origin along its normal; what the reading of a wire lacks; m.
    pub offset_m: Option<f64>,
    /// Its standard uncertainty, m; of a plane that of where it is along its normal, at its point.
    pub offset_uncertainty_m: Option<f64>,
    /// The radius of a circle or a sphere that no column says, m.
    pub radius_m: Option<f64>,
    /// Its standard uncertainty, m.
    pub radius_uncertainty_m: Option<f64>,
    /// Its rows.
    pub rows: usize,
    /// Those of them that were set aside.
    pub rows_set_aside: usize,
}

/// Where objects and stations are by a fit of these rows; none where they observe no objects, or the fit is not usable.
///
/// # Errors
/// The fit is none of these rows.
pub fn placed(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
) -> Result<Option<Placed>, FitError> {
    let Some(unknowns) = observations.unknowns.as_ref().filter(|_| fit.outcome.is_usable()) else {
        return Ok(None);
    };
    let rows = Counts::of(unknowns, &fit.residuals.weight);
    let mut there = unknowns.at(unknowns.state(&fit.values));
    let frame = Frame::of(unknowns, &rows);
    if let Some(frame) = &frame {
        frame.take(unknowns, &mut there);
    }
    let observations = Observations { unknowns: Some(there), ..observations.clone() };
    let spread = spread(chain, &observations, fit)?;
    let Some(there) = &observations.unknowns else { unreachable!("they were put there") };
    let of = |first: usize, count: usize| Uncertain { spread: &spread, first, count };
    let stations = there.stations.iter().enumerate().zip(there.first_of_stations());
    let stations = stations.filter(|((_, own), _)| !own.label.is_empty()).map(|((at, own), first)| {
        let is_frame = frame.as_ref().is_some_and(|frame| frame.station == at);
        let origin = if is_frame { Origin::Frame } else { origin(own.freedom) };
        station(own, origin, &of(first, own.numbers()), rows.stations[at])
    });
    let is_sphere = without_length(&observations, there);
    let objects = there.objects.iter().enumerate().zip(there.first_of_objects());
    // Of one whose rows have no value nothing is known.
    let objects = objects.filter(|((_, own), _)| own.known == Known::Yes);
    let objects = objects
        .map(|((at, own), first)| object(own, is_sphere[at], &of(first, own.numbers()), rows.objects[at]));
    Ok(Some(Placed { stations: stations.collect(), objects: objects.collect() }))
}

/// How many rows everything has, and how many of them were set aside.
struct Counts {
    stations: Vec<[usize; 2]>,
    objects: Vec<[usize; 2]>,
}

impl Counts {
    fn of(unknowns: &Unknowns, weight: &[f64]) -> Self {
        let mut counts = Self {
            stations: vec![[0; 2]; unknowns.stations.len()],
            objects: vec![[0; 2]; unknowns.objects.len()],
        };
        for ((object, &station), weight) in unknowns.object.iter().zip(&unknowns.station).zip(weight) {
            let objects = object.map(|object| &mut counts.objects[object as usize]);
            for [rows, aside] in objects.into_iter().chain([&mut counts.stations[station as usize]]) {
                *rows += 1;
                *aside += usize::from(*weight == 0.0);
            }
        }
        counts
    }
}

/// What stands in for what would hold the frame, where nothing does: a station.
struct Frame {
    station: usize,
    /// The one point that is exact: the station says nothing but how all of it is turned.
    point: Option<usize>,
}

impl Frame {
    /// Of the stations that were levelled, whose pose is written, or else of all, that with most rows. None where the frame is held, or by two points or
    /// more, which leave no turn or one about their line.
    fn of(unknowns: &Unknowns, rows: &Counts) -> Option<Self> {
        let seen = || unknowns.stations.iter().enumerate().filter(|(at, _)| rows.stations[*at][0] > 0);
        let points = unknowns.points_of_frame();
        let are_free = unknowns.objects.iter().all(|own| own.freedom == Freedom::Free);
        if seen().any(|(_, own)| own.freedom != Freedom::Free) || !(are_free || points.len() == 1) {
            return None;
        }
        let most = |(at, own): &(usize, &Station)| {
            let told = (own.level_rad.is_some(), own.is_written());
            (told, rows.stations[*at][0], std::cmp::Reverse(*at))
        };
        let (station, _) = seen().max_by_key(most)?;
        Some(Self { station, point: points.first().copied() })
    }

    /// Moves all of it so that the station is as it started, and holds it there; by levels it may lean.
    fn take(&self, unknowns: &Unknowns, there: &mut Unknowns) {
        let (start, now) = (&unknowns.stations[self.station].pose, there.stations[self.station].pose);
        let is_levelled = there.stations[self.station].level_rad.is_some();
        let mut back = start.after(&now.inverse());
        if is_levelled {
            let turned = start.angles().0[2] - now.angles().0[2];
            back = Pose::new(Vector3::zeros(), 0.0, 0.0, turned);
        }
        let stays = match self.point {
            Some(point) => [there.objects[point].place; 2],
            None => [now.shift, start.shift],
        };
        back.shift = stays[1] - back.turn * stays[0];
        there.stations.iter_mut().for_each(|station| station.pose = back.after(&station.pose));
        for object in &mut there.objects {
            object.place = back.apply(&object.place);
            object.normal = back.turn * object.normal;
        }
        there.stations[self.station].freedom = match self.point {
            None if !is_levelled => Freedom::Given,
            None => Freedom::Within { shift_m: HELD, turn_rad: HELD },
            Some(_) => Freedom::Within { shift_m: ANYWHERE_M, turn_rad: HELD },
        };
    }
}

/// How surely all numbers are known where the fit ended; none where nobody knows how large the noise is.
fn spread(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
) -> Result<Option<Vec<Spread>>, FitError> {
    let model = Model::new(chain, &observations.poses, &fit.parameters)?;
    let (layout, sigma) = (Layout::of(observations), fit.noise.sigma_without_memory());
    let mut values = fit.values[..chain.symbols.len()].to_vec();
    values.resize(values.len() + observations.unknowns.as_ref().map_or(0, Unknowns::numbers), 0.0);
    let weight = &fit.residuals.weight;
    let aside: Vec<bool> = weight.iter().map(|weight| *weight == 0.0).collect();
    let swept = |weighting| eliminated(&model, observations, &layout, &values, &sigma, weighting, &aside);
    let (full, eliminated) = swept(Weighting::Full)?;
    let tally = if weight.iter().all(|weight| [0.0, 1.0].contains(weight)) {
        full
    } else {
        swept(Weighting::Biweight)?.0
    };
    let kept = layout.row_of_each().filter(|&row| !aside[row]).count() as f64;
    let variance = tally.variance_factor(kept, kept - fit.degrees_of_freedom);
    let root = of_columns(&model, &fit.covariance).filter(|_| variance.is_finite());
    Ok(eliminated.zip(root).map(|(eliminated, root)| eliminated.spread(variance, &root)))
}

/// A matrix whose product with its own transpose is the covariance of the model's columns; none where there is none.
fn of_columns(model: &Model, covariance: &Mat<f64>) -> Option<Mat<f64>> {
    if covariance.col_iter().any(|column| column.iter().any(|value| !value.is_finite())) {
        return None;
    }
    let eigen = covariance.self_adjoint_eigen(Side::Lower).ok()?;
    let values = eigen.S().column_vector();
    let mut root = Mat::zeros(model.columns(), covariance.ncols());
    for (row, column) in model.column_of().iter().enumerate() {
        let Some(column) = *column else { continue };
        for own in 0..covariance.ncols() {
            root[(column, own)] = eigen.U()[(row, own)] * values[own].max(0.0).sqrt();
        }
    }
    Some(root)
}

/// How surely the numbers of one thing are known.
struct Uncertain<'a> {
    spread: &'a Option<Vec<Spread>>,
    first: usize,
    count: usize,
}

impl Uncertain<'_> {
    /// The standard uncertainty of a sum of its numbers, each with its factor; none where a number with a part in it is not held.
    fn along(&self, parts: &[(usize, f64)]) -> Option<f64> {
        if self.count == 0 {
            return Some(0.0);
        }
        let first = self.first + parts.first()?.0;
        let own = self.spread.as_ref()?.iter().find(|own| own.own.contains(&first))?;
        let start = own.own.iter().position(|&at| at == self.first)?;
        let parts: Vec<(usize, f64)> = parts
            .iter()
            .filter(|(_, factor)| *factor != 0.0)
            .map(|&(at, factor)| (start + at, factor))
            .collect();
        let each = |&(a, by_a): &(usize, f64)| {
            parts.iter().map(|&(b, by_b)| by_a * by_b * own.covariance[(a, b)]).sum::<f64>()
        };
        parts.iter().all(|(at, _)| own.held[*at]).then(|| parts.iter().map(each).sum::<f64>().max(0.0).sqrt())
    }

    /// That of three numbers, the first of which is so many behind its first.
    fn of_three(&self, first: usize) -> [Option<f64>; 3] {
        [0, 1, 2].map(|axis| self.along(&[(first + axis, 1.0)]))
    }

    /// That of the direction in which its first two numbers, which tilt a normal, are known worst.
    fn of_tilt(&self) -> Option<f64> {
        let [a, b] = [self.along(&[(0, 1.0)])?, self.along(&[(1, 1.0)])?].map(|own| own * own);
        // The variance of the sum has twice the covariance in it.
        let covariance = (self.along(&[(0, 1.0), (1, 1.0)])?.powi(2) - a - b) / 2.0;
        let apart = ((a - b) / 2.0).hypot(covariance);
        Some(((a + b) / 2.0 + apart).sqrt())
    }
}

fn origin(freedom: Freedom) -> Origin {
    match freedom {
        Freedom::Given => Origin::Exact,
        Freedom::Within { .. } => Origin::Stated,
        Freedom::Free => Origin::Estimated,
    }
}

fn station(
    own: &Station,
    origin: Origin,
    uncertain: &Uncertain<'_>,
    [rows, aside]: [usize; 2],
) -> PlacedStation {
    let Pose { shift, .. } = own.pose;
    let (turns_rad, by_turn): ([f64; 3], Matrix3<f64>) = own.pose.angles();
    // What stands in for the frame is held, and does not say how surely.
    let exact = |own: f64| if own < 10.0 * HELD { 0.0 } else { own };
    let turn =
        |row: usize| uncertain.along(&[0, 1, 2].map(|axis| (3 + axis, by_turn[(row, axis)]))).map(exact);
    PlacedStation {
        station: own.label.clone(),
        origin,
        place_m: shift.into(),
        turns_rad,
        place_uncertainties_m: uncertain.of_three(0).map(|own| own.map(exact)),
        turn_uncertainties_rad: [0, 1, 2].map(turn),
        rows,
        rows_set_aside: aside,
    }
}

fn object(
    own: &Object,
    is_sphere: bool,
    uncertain: &Uncertain<'_>,
    [rows, aside]: [usize; 2],
) -> PlacedObject {
    let mut placed = PlacedObject {
        object: own.label.clone(),
        kind: match own.shape {
            Shape::Plane => "plane",
            Shape::Point => "point",
            Shape::Wire if is_sphere => "sphere",
            Shape::Wire => "wire",
            Shape::Circle | Shape::Ring => "circle",
        },
        origin: origin(own.freedom),
        place_m: own.place.into(),
        place_uncertainties_m: [None; 3],
        normal: None,
        normal_uncertainty_rad: None,
        offset_m: None,
        offset_uncertainty_m: None,
        radius_m: None,
        radius_uncertainty_m: None,
        rows,
        rows_set_aside: aside,
    };
    let normal = Some(own.normal.into());
    match own.shape {
        Shape::Plane => {
            (placed.normal, placed.normal_uncertainty_rad) = (normal, uncertain.of_tilt());
            placed.offset_m = Some(own.normal.dot(&own.place));
            placed.offset_uncertainty_m = uncertain.along(&[(2, 1.0)]);
        }
        Shape::Point => placed.place_uncertainties_m = uncertain.of_three(0),
        Shape::Wire => {
            placed.place_uncertainties_m = uncertain.of_three(0);
            let (value, uncertainty) = (Some(own.offset), uncertain.along(&[(3, 1.0)]));
            if is_sphere {
                (placed.radius_m, placed.radius_uncertainty_m) = (value, uncertainty);
            } else {
                (placed.offset_m, placed.offset_uncertainty_m) = (value, uncertainty);
            }
        }
        Shape::Circle | Shape::Ring => {
            (placed.normal, placed.normal_uncertainty_rad) = (normal, uncertain.of_tilt());
            placed.place_uncertainties_m = uncertain.of_three(2);
            if own.shape == Shape::Circle {
                (placed.radius_m, placed.radius_uncertainty_m) =
                    (Some(own.offset), uncertain.along(&[(5, 1.0)]));
            }
        }
    }
    placed
}

/// Per object whether its rows read no length: what has the numbers of a wire is a sphere then.
fn without_length(observations: &Observations, unknowns: &Unknowns) -> Vec<bool> {
    let mut without = vec![true; unknowns.objects.len()];
    for (object, measured) in unknowns.object.iter().zip(&observations.measured) {
        if let (Some(object), Some(length_m)) = (object, measured.length_m()) {
            without[*object as usize] &= length_m == 0.0;
        }
    }
    without
}
