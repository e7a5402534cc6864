//! Places spread over where things are, each with what could be aimed at there and how.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use model_core::Chain;
use nalgebra::{Rotation3, Vector3};

use super::Addition;
use super::aim::{Aim, Goal, ranges_of};
use super::known::{Known, extent};
use crate::design::generator;
use fit::robust::median;
use network::{Row, rows};
use observe::kinds::AimedAt;
use observe::unknowns::{Freedom, Known as Placed, Object, Pose, Shape, Station, Unknowns};
use observe::{Measure, Measured, Observations, Series};
use study::{NextPlaces, NextPoses};

/// Places that are compared.
const PLACES: usize = 96;

/// Ways of pointing at one thing, at most and at least.
const WAYS: [usize; 2] = [2, 40];

/// Pointings to choose from, for each that is wanted.
const CHOICE: f64 = 1.5;

/// Rows of one addition at most.
const MOST_ROWS: usize = 100;

/// Lengths that differ by no more than this share are those of one bar, or of one radius.
const ALIKE: f64 = 0.01;

/// A beam that meets a plane at more than this from its normal is lost, as a cosine: 80 degrees.
const GRAZING: f64 = 0.17;

/// A station or an object that is not there yet.
pub(super) enum New {
    Station(Station),
    Object(Object),
}

impl New {
    pub fn station(&self) -> Option<&Station> {
        match self {
            Self::Station(station) => Some(station),
            Self::Object(_) => None,
        }
    }

    pub fn object(&self) -> Option<&Object> {
        match self {
            Self::Object(object) => Some(object),
            Self::Station(_) => None,
        }
    }

    /// How many numbers it brings that are estimated.
    pub fn numbers(&self) -> usize {
        match self {
            Self::Station(station) => station.numbers(),
            Self::Object(object) => object.numbers(),
        }
    }
}

/// What could be added, and how it could be measured.
pub(super) struct Candidate {
    pub new: New,
    pub pointings: Vec<Possible>,
    /// How many pointings are to be measured.
    pub wanted: usize,
    /// Of a new object: how far from its place all of them have to be, m.
    pub radius_m: Option<f64>,
}

/// A row that could be measured; a station or object behind those that there are is the new one.
pub(super) struct Possible {
    pub series: usize,
    pub station: usize,
    pub object: usize,
    /// One value a column of the readings.
    pub readings: Vec<f64>,
}

/// What candidates are made of.
pub(super) struct Candidates<'a> {
    /// Where objects and stations are.
    pub unknowns: Unknowns,
    /// What would be known of another station.
    of_stations: Freedom,
    wanted: &'a NextPlaces,
    /// Rows of each addition, if the study says how many.
    poses: Option<usize>,
    measures: Vec<Measure>,
    /// What an object of each series is.
    kinds: Vec<Option<Addition>>,
    /// How far from its centre each object is observed, m; `None` where that is any distance.
    radii_m: Vec<Option<f64>>,
    /// One a series that observes objects.
    aims: Vec<Option<Aim>>,
    rows: Vec<Row>,
    /// Of each row the point in the frame of the objects, if it is one.
    hits: Vec<Vector3<f64>>,
    /// Of each object where it was hit, and by which series.
    hits_of: Vec<Vec<(usize, Vector3<f64>)>>,
    /// How far a usual plane reaches from its middle, m.
    board_m: f64,
    /// Whether a beam goes from the station to what is observed.
    has_beam: bool,
}

impl<'a> Candidates<'a> {
    /// Of observations whose objects and stations, `unknowns`, are where the fit has them.
    pub fn of(
        chain: &Chain,
        observations: &Observations,
        unknowns: Unknowns,
        of_stations: Freedom,
        values: &[f64],
        next: &NextPoses,
        wanted: &'a NextPlaces,
    ) -> Self {
        let poses = &observations.poses;
        let aims = poses.series.iter().map(|series| {
            let observes = series.measure.observes_object() && !series.rows.is_empty();
            observes.then(|| Aim::new(chain, series.observable, poses, &next.ranges, values))
        });
        let rows = rows(chain, observations, &unknowns, values);
        let hits: Vec<Vector3<f64>> =
            rows.iter().map(|row| unknowns.stations[row.station].pose.apply(&row.point)).collect();
        let mut hits_of = vec![Vec::new(); unknowns.objects.len()];
        rows.iter().zip(&hits).for_each(|(row, hit)| hits_of[row.object].push((row.series, *hit)));
        let planes = unknowns.objects.iter().zip(&hits_of).filter(|(own, _)| own.shape == Shape::Plane);
        let reach = planes
            .filter(|(_, hits)| !hits.is_empty())
            .map(|(plane, hits)| median(hits.iter().map(|(_, hit)| (hit - plane.place).norm()).collect()));
        Self {
            aims: aims.collect(),
            board_m: median(reach.collect()),
            hits_of,
            measures: poses.series.iter().map(|series| series.measure).collect(),
            kinds: poses.series.iter().map(|series| kind(series, observations)).collect(),
            radii_m: radii_m(observations, &unknowns),
            has_beam: !ranges_of(chain, poses, &next.ranges).is_empty(),
            unknowns,
            of_stations,
            wanted,
            poses: next.count,
            rows,
            hits,
        }
    }

    /// How far apart things are, m.
    pub fn extent_m(&self) -> f64 {
        extent(self.things())
    }

    /// Where things are: stations, points, and where planes were hit.
    fn things(&self) -> impl Iterator<Item = Vector3<f64>> + Clone {
        let hits = self.rows.iter().zip(&self.hits).filter(|(row, _)| row.measure.kind().aim != AimedAt::Way);
        let points = self.unknowns.objects.iter().filter(|object| object.shape != Shape::Plane);
        self.stations()
            .map(|station| station.pose.shift)
            .chain(points.map(|object| object.place))
            .chain(hits.map(|(_, hit)| *hit))
    }

    /// The stations from which rows observe something.
    fn stations(&self) -> impl Iterator<Item = &Station> + Clone {
        let used: BTreeSet<usize> = self.rows.iter().map(|row| row.station).collect();
        let all = self.unknowns.stations.iter().enumerate();
        all.filter(move |(number, _)| used.contains(number)).map(|(_, station)| station)
    }

    /// What could be added of a kind.
    pub fn all(&self, adds: Addition, known: &Known) -> Vec<Candidate> {
        let candidates = parallel::each(PLACES, |number| match adds {
            Addition::Station => self.station(number, known),
            _ => self.object(number, adds),
        });
        candidates.into_iter().flatten().collect()
    }

    /// Coordinate number so of a place, between the ends of where things are or where the study says.
    fn within(&self, axis: usize, share: f64, of_stations: bool) -> f64 {
        let stations = self.stations().map(|station| station.pose.shift[axis]);
        let things = self.things().map(|thing| thing[axis]);
        let ends = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (low, high) = match &self.wanted.bounds[axis] {
            Some(range) => (range.start, range.end),
            // An instrument stands as high as it has stood.
            None if of_stations && axis == 2 => ends(&mut { stations }),
            None => ends(&mut { things }),
        };
        low + (high - low) * share
    }

    fn station(&self, number: usize, known: &Known) -> Option<Candidate> {
        let first = self.stations().find(|station| !station.label.is_empty())?;
        let share = shares::<4>(number);
        let shift = Vector3::from_fn(|axis, _| self.within(axis, share[axis], true));
        let heading = self.wanted.bounds[3].clone().unwrap_or(-PI..PI);
        let heading = heading.start + (heading.end - heading.start) * share[3];
        // As upright as the others.
        let (.., yaw) = first.pose.turn.euler_angles();
        let turn = Rotation3::from_euler_angles(0.0, 0.0, heading - yaw) * first.pose.turn;
        let pose = Pose { turn, shift };
        let station = Station {
            freedom: self.of_stations,
            known: Placed::Yes,
            pose,
            ..Station::unknown(String::new())
        };
        let wanted = self.poses.unwrap_or_else(|| self.rows_per(|row| row.station));

        let seen: BTreeSet<(usize, usize)> = self.rows.iter().map(|row| (row.series, row.object)).collect();
        let aimed: Vec<(usize, usize)> = seen
            .into_iter()
            .filter(|&(_, object)| {
                known.objects[object].is_some() || self.unknowns.objects[object].numbers() == 0
            })
            .collect();
        let each = (CHOICE * wanted as f64 / aimed.len().max(1) as f64).ceil() as usize;
        let new = self.unknowns.stations.len();
        let mut pointings = Vec::new();
        for (series, object) in aimed {
            let Some(aim) = &self.aims[series] else { continue };
            let thing = &self.unknowns.objects[object];
            let on_board = self.measures[series].kind().aim == AimedAt::Board;
            let goals: Vec<Goal> = if on_board {
                self.spots(series, object, each).iter().map(|spot| Goal::Point(pose.back(spot))).collect()
            } else {
                vec![goal(self.measures[series], &pose, thing, self.radii_m[object])]
            };
            let ways = (each / goals.len().max(1)).clamp(WAYS[0], WAYS[1]);
            for goal in goals {
                if let (Goal::Point(there), true) = (goal, on_board)
                    && self.grazes(&(pose.turn * there), &thing.normal)
                {
                    continue;
                }
                let ways = aim.at(goal, ways);
                pointings.extend(ways.into_iter().map(|readings| Possible {
                    series,
                    station: new,
                    object,
                    readings,
                }));
            }
        }
        let new = New::Station(station);
        (!pointings.is_empty()).then_some(Candidate { new, pointings, wanted, radius_m: None })
    }

    fn object(&self, number: usize, adds: Addition) -> Option<Candidate> {
        let series = self.kinds.iter().position(|kind| *kind == Some(adds))?;
        let aim = self.aims[series].as_ref()?;
        let measure = self.measures[series];
        let shape = measure.shape()?;
        let share = shares::<5>(number);
        let place = Vector3::from_fn(|axis, _| self.within(axis, share[axis], false));
        let mut object = Object::unknown(String::new(), shape);
        (object.place, object.known) = (place, Placed::Yes);
        let own = self.unknowns.objects.iter().filter(|own| own.shape == shape);
        object.freedom = as_the_others(own.clone().map(|own| own.freedom));
        if matches!(shape, Shape::Plane | Shape::Circle | Shape::Ring) {
            let (up, around) = (2.0 * share[3] - 1.0, 2.0 * PI * share[4]);
            let level = (1.0 - up * up).sqrt();
            object.normal = Vector3::new(level * around.cos(), level * around.sin(), up);
        }
        if matches!(shape, Shape::Wire | Shape::Circle) {
            object.offset = median(own.map(|own| own.offset).collect());
        }
        let radius_m = self.usual_radius_m(series);
        let wanted = self.poses.unwrap_or_else(|| self.rows_per(|row| row.object));
        let stations: BTreeSet<usize> =
            self.rows.iter().filter(|row| row.series == series).map(|row| row.station).collect();
        let ways = (CHOICE * wanted as f64 / stations.len().max(1) as f64).ceil() as usize;
        let ways = ways.clamp(WAYS[0], WAYS[1]);
        let new = self.unknowns.objects.len();
        let mut pointings = Vec::new();
        for station in stations {
            let pose = self.unknowns.stations[station].pose;
            let goal = match measure.kind().aim {
                AimedAt::Board if self.grazes(&(place - pose.shift), &object.normal) => continue,
                AimedAt::Board => {
                    Goal::Board(pose.back(&place), pose.turn.inverse() * object.normal, self.board_m)
                }
                _ => goal(measure, &pose, &object, radius_m),
            };
            let readings = aim.at(goal, ways);
            pointings.extend(readings.into_iter().map(|readings| Possible {
                series,
                station,
                object: new,
                readings,
            }));
        }
        let new = New::Object(object);
        (!pointings.is_empty()).then_some(Candidate { new, pointings, wanted, radius_m })
    }

    /// How far from its centre an object of a series is observed, as the others are; `None` where that is any distance.
    fn usual_radius_m(&self, series: usize) -> Option<f64> {
        let own = self.rows.iter().filter(|row| row.series == series).map(|row| row.object);
        let own: BTreeSet<usize> = own.collect();
        own.into_iter().map(|object| self.radii_m[object]).collect::<Option<Vec<f64>>>().and_then(middle)
    }

    /// Whether a beam would be lost on a plane.
    fn grazes(&self, beam: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        self.has_beam && beam.normalize().dot(normal).abs() < GRAZING
    }

    /// Some points at which a plane was hit, spread over its rows.
    fn spots(&self, series: usize, object: usize, count: usize) -> Vec<Vector3<f64>> {
        let own: Vec<Vector3<f64>> =
            self.hits_of[object].iter().filter(|(by, _)| *by == series).map(|(_, hit)| *hit).collect();
        let count = count.clamp(1, own.len());
        (0..count).map(|at| own[at * own.len() / count]).collect()
    }

    /// Rows of a station or object, at the median.
    fn rows_per(&self, of: impl Fn(&Row) -> usize) -> usize {
        let mut count: Vec<f64> = Vec::new();
        for row in &self.rows {
            let at = of(row);
            if count.len() <= at {
                count.resize(at + 1, 0.0);
            }
            count[at] += 1.0;
        }
        count.retain(|count| *count > 0.0);
        (median(count) as usize).clamp(1, MOST_ROWS)
    }
}

/// Where to aim to observe an object that is no plane, from a pose.
fn goal(measure: Measure, pose: &Pose, thing: &Object, radius_m: Option<f64>) -> Goal {
    let there = pose.back(&thing.place);
    match (measure.kind().aim, radius_m) {
        (AimedAt::Way, _) => Goal::Way(there),
        (AimedAt::Circle, Some(radius_m)) => {
            Goal::Circle(there, pose.turn.inverse() * thing.normal, radius_m)
        }
        (AimedAt::Sphere, Some(radius_m)) => Goal::Sphere(there, radius_m),
        (AimedAt::Sphere, None) => Goal::Anything,
        (AimedAt::Point | AimedAt::Board, _) | (AimedAt::Circle, None) => Goal::Point(there),
    }
}

/// What an object of a series is.
fn kind(series: &Series, observations: &Observations) -> Option<Addition> {
    let mut lengths = observations.measured[series.rows.clone()].iter().filter_map(Measured::length_m);
    Addition::of(series.measure, lengths.any(|length_m| length_m != 0.0))
}

/// Per object how far from its centre its rows are, m: its radius, or the length that all of them read.
fn radii_m(observations: &Observations, unknowns: &Unknowns) -> Vec<Option<f64>> {
    let mut read: Vec<Vec<f64>> = vec![Vec::new(); unknowns.objects.len()];
    for (object, measured) in unknowns.object.iter().zip(&observations.measured) {
        if let (Some(object), Some(length_m)) = (object, measured.length_m()) {
            read[*object as usize].push(length_m);
        }
    }
    let radius_m = |(object, read): (&Object, Vec<f64>)| match object.shape {
        Shape::Circle => Some(object.offset),
        Shape::Wire if read.iter().all(|length_m| *length_m == 0.0) => Some(object.offset),
        Shape::Ring => middle(read),
        Shape::Point => middle(read.clone())
            .filter(|usual| read.iter().all(|length_m| (length_m - usual).abs() <= ALIKE * usual)),
        Shape::Wire | Shape::Plane => None,
    };
    unknowns.objects.iter().zip(read).map(radius_m).collect()
}

/// One in the middle of some lengths: of bars of two lengths no third one.
fn middle(mut lengths_m: Vec<f64>) -> Option<f64> {
    lengths_m.sort_by(f64::total_cmp);
    lengths_m.get(lengths_m.len() / 2).copied()
}

/// What would be known of one more: what is known of every other.
pub(super) fn as_the_others(mut others: impl Iterator<Item = Freedom>) -> Freedom {
    let Some(first) = others.next() else { return Freedom::Free };
    if others.all(|other| other == first) { first } else { Freedom::Free }
}

/// A point of so many dimensions that fill the unit cube evenly.
fn shares<const N: usize>(number: usize) -> [f64; N] {
    let steps = generator(N);
    std::array::from_fn(|axis| ((number as f64 + 0.5) * steps[axis]).fract())
}
