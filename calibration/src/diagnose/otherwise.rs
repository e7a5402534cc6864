//! A fit that is far off, and the one mistake that would explain it: coordinates exchanged, zenith distances for elevations, gon for
//! degrees. Each is undone and the rows are fitted once more; those that leave a small part of the residual are named.

use std::f64::consts::{FRAC_PI_2, PI};

use model_core::{Quantity, SymbolId, SymbolKind};
use serde::Serialize;

use crate::data::unknowns::{Freedom, Pose, Unknowns};
use crate::data::{Observations, SiUnit};
use crate::fit::noise::{Layout, NoiseOptions};
use crate::fit::{FitOptions, Model, fit, range_of, residuals, robust};
use crate::objects::{place, rows};
use crate::search::context::Context;

/// Rows that are fitted at most, evenly spread.
const ROWS: usize = 1500;

/// The share of rows that lies furthest off, of which a mistake need not explain anything.
const FURTHEST: f64 = 0.02;

/// What was read otherwise explains the residual where no more than this share of it is left; one of several, where it leaves no more than
/// so many times what the best leaves.
const LEFT: f64 = 0.1;
const AS_GOOD: f64 = 2.0;

/// A large error is explained where all angles are small without it, rad, and the residual is hardly larger.
const SMALL_RAD: f64 = 0.1;
const HARDLY_LARGER: f64 = 1.5;

/// A mistake is worth a fit where rows start from so much smaller a residual without it, and so many are fitted.
const NEARER: f64 = 0.5;
const FITTED: usize = 6;

/// Steps of such a fit.
const STEPS: usize = 20;

/// So many are named at most.
const MOST: usize = 3;

/// Joints that are tried one by one at most.
const JOINTS: usize = 4;

/// Units that are taken for each other: what a number is to be multiplied by, and the mistake.
const ANGLES: [(f64, &str); 4] = [
    (0.9, "in gon and read as degrees"),
    (1.0 / 0.9, "in degrees and read as gon"),
    (PI / 180.0, "in degrees and read as radians"),
    (180.0 / PI, "in radians and read as degrees"),
];
const LENGTHS: [(f64, &str); 4] = [
    (1e-3, "in mm and read as m"),
    (1e3, "in m and read as mm"),
    (0.3048, "in feet and read as m"),
    (1.0 / 0.3048, "in m and read as feet"),
];

/// What explains the residual, and what is left of it then.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Otherwise {
    /// What is likely wrong: what explains the data about as well, the mistake first that is made most.
    pub mistakes: Vec<Misreading>,
    /// RMS of the residual as the data were read, without the rows furthest off, SI.
    pub before: f64,
    /// The same without the first mistake.
    pub after: f64,
    /// Their unit.
    pub unit: SiUnit,
}

/// Places that a study states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StatedPlaces {
    /// Those of objects.
    Objects,
    /// Those of stations.
    Stations,
    /// Both.
    Both,
}

/// A way in which data or places are read that they were not meant in.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Misreading {
    /// x and y of places are exchanged: northing and easting.
    ExchangedXY {
        /// Of which.
        of: StatedPlaces,
    },
    /// Places are in another unit of length.
    PlacesUnit {
        /// Of which.
        of: StatedPlaces,
        /// In which unit they are, and in which they were read.
        unit: &'static str,
    },
    /// Headings run the other way.
    HeadingsReversed,
    /// Headings count from y to x: bearings.
    HeadingsFromY {
        /// Whether x and y are exchanged as well.
        exchanged: bool,
    },
    /// A joint runs the other way.
    Reversed {
        /// The joint.
        joint: String,
    },
    /// A joint counts from the zenith, not from the horizon.
    FromZenith {
        /// The joint.
        joint: String,
    },
    /// Two joints are exchanged.
    Exchanged {
        /// The joints.
        joints: [String; 2],
    },
    /// Readings are in another unit.
    Unit {
        /// The joints or the range.
        readings: Vec<String>,
        /// In which unit they are, and in which they were read.
        unit: &'static str,
    },
}

/// Joints and inputs with their readings.
type Readings = Vec<(SymbolId, Vec<f64>)>;

/// How to undo it.
enum Undo {
    Readings(Box<dyn Fn(&mut Readings)>),
    Places(Box<dyn Fn(&mut Unknowns)>),
}

/// Why it is worth looking.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Doubt {
    /// The residual is large.
    Residual,
    /// The residual is not, but an error is.
    Error,
}

/// The mistakes that explain it, where rows observe objects; `None` if none does.
pub(super) fn otherwise(whole: &Context<'_>, doubt: Doubt) -> Option<Otherwise> {
    let observations = whole.request.observations;
    observations.unknowns.as_ref()?;
    let step = observations.rows().div_ceil(ROWS).max(1);
    let chosen: Vec<usize> = (0..observations.rows()).step_by(step).collect();
    let sample = observations.select(&chosen);
    let placed = placed(whole, &sample, None)?;
    let (from, before) = (placed.relative, left_by(whole, &placed.observations)?);
    let explains = |left: &Left| match doubt {
        Doubt::Residual => left.relative() <= LEFT * before.relative(),
        Doubt::Error => left.largest_rad < SMALL_RAD && left.rms <= HARDLY_LARGER * before.rms,
    };
    // Where everything starts tells most of them apart, in no time; few are fitted.
    let starts = mistakes(whole, &sample).into_iter().enumerate().filter_map(|(number, (mistake, undo))| {
        Some((number, mistake, self::placed(whole, &sample, Some(&undo))?))
    });
    let nearer = |placed: &Placed| doubt == Doubt::Error || placed.relative < NEARER * from;
    let mut starts: Vec<(usize, Misreading, Placed)> =
        starts.filter(|(_, _, placed)| nearer(placed)).collect();
    starts.sort_by(|a, b| a.2.relative.total_cmp(&b.2.relative));
    starts.truncate(FITTED);
    starts.sort_by_key(|(number, ..)| *number);
    let mut found: Vec<(Misreading, Left)> = Vec::new();
    for (_, mistake, placed) in starts {
        let left = left_by(whole, &placed.observations);
        found.extend(left.filter(explains).map(|left| (mistake, left)));
    }
    // Counted from elsewhere, a joint that runs the other way is no more than that.
    let reversed = |one: &Misreading| match one {
        Misreading::FromZenith { joint } => Some(joint.clone()),
        _ => None,
    };
    let is_reversed = |joint: &String| {
        found.iter().any(|(other, _)| matches!(other, Misreading::Reversed { joint: own } if own == joint))
    };
    let twice: Vec<bool> =
        found.iter().map(|(one, _)| reversed(one).as_ref().is_some_and(is_reversed)).collect();
    let mut twice = twice.into_iter();
    found.retain(|_| twice.next() == Some(false));
    let best = found.iter().map(|(_, left)| left.relative()).fold(f64::INFINITY, f64::min);
    found.retain(|(_, left)| left.relative() <= AS_GOOD * best);
    found.truncate(MOST);
    let after = found.first()?.1.rms;
    let unit = sample.poses.series.first()?.measure.unit();
    let mistakes = found.into_iter().map(|(mistake, _)| mistake).collect();
    Some(Otherwise { mistakes, before: before.rms, after, unit })
}

/// Mistakes that are made, and how each is undone; the likeliest first.
fn mistakes(whole: &Context<'_>, sample: &Observations) -> Vec<(Misreading, Undo)> {
    let mut all = of_places(sample);
    all.extend(of_readings(whole, sample));
    all
}

fn of_places(sample: &Observations) -> Vec<(Misreading, Undo)> {
    let Some(unknowns) = &sample.unknowns else { return Vec::new() };
    let is_stated = |label: &str, freedom: Freedom| freedom != Freedom::Free && !label.is_empty();
    let objects = unknowns.objects.iter().any(|own| is_stated(&own.label, own.freedom));
    let stations = unknowns.stations.iter().any(|own| is_stated(&own.label, own.freedom));
    let kinds: &[StatedPlaces] = match (objects, stations) {
        (true, true) => &[StatedPlaces::Both, StatedPlaces::Objects, StatedPlaces::Stations],
        (true, false) => &[StatedPlaces::Objects],
        (false, true) => &[StatedPlaces::Stations],
        (false, false) => &[],
    };
    let mut all = Vec::new();
    for &of in kinds {
        all.push((
            Misreading::ExchangedXY { of },
            Undo::Places(Box::new(move |own| each_place(own, of, |[x, y, z]| [y, x, z]))),
        ));
    }
    if stations {
        all.push((
            Misreading::HeadingsReversed,
            Undo::Places(Box::new(|own| each_heading(own, |heading| -heading))),
        ));
        for exchanged in [false, true] {
            all.push((
                Misreading::HeadingsFromY { exchanged },
                Undo::Places(Box::new(move |own| {
                    each_heading(own, |heading| FRAC_PI_2 - heading);
                    if exchanged {
                        each_place(own, StatedPlaces::Both, |[x, y, z]| [y, x, z]);
                    }
                })),
            ));
        }
    }
    for &of in kinds {
        for (factor, unit) in LENGTHS {
            all.push((
                Misreading::PlacesUnit { of, unit },
                Undo::Places(Box::new(move |own| {
                    each_place(own, of, |place| place.map(|value| value * factor));
                })),
            ));
        }
    }
    all
}

/// Changes stated places.
fn each_place(unknowns: &mut Unknowns, of: StatedPlaces, change: impl Fn([f64; 3]) -> [f64; 3]) {
    if of != StatedPlaces::Stations {
        let stated = unknowns.objects.iter_mut().filter(|own| own.freedom != Freedom::Free);
        stated.for_each(|own| own.place = change(own.place.into()).into());
    }
    if of != StatedPlaces::Objects {
        let stated = unknowns.stations.iter_mut().filter(|own| own.freedom != Freedom::Free);
        stated.for_each(|own| own.pose.shift = change(own.pose.shift.into()).into());
    }
}

/// Changes the headings that are written of stations, rough ones too.
fn each_heading(unknowns: &mut Unknowns, change: impl Fn(f64) -> f64) {
    for own in unknowns.stations.iter_mut().filter(|own| !own.label.is_empty()) {
        let (roll, pitch, heading) = own.pose.turn.euler_angles();
        own.pose = Pose::new(own.pose.shift, roll, pitch, change(heading));
    }
}

fn of_readings(whole: &Context<'_>, sample: &Observations) -> Vec<(Misreading, Undo)> {
    let chain = &whole.request.plan.chain;
    let is_joint = |id: &SymbolId| {
        let symbol = chain.symbol(*id);
        symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle
    };
    let joints: Vec<SymbolId> = sample.poses.columns.iter().map(|(id, _)| *id).filter(is_joint).collect();
    let name = |id: SymbolId| chain.symbol(id).name.clone();
    let mapped = |ids: Vec<SymbolId>, change: fn(f64, f64) -> f64, by: f64| {
        Undo::Readings(Box::new(move |columns| {
            let own = columns.iter_mut().filter(|(id, _)| ids.contains(id));
            own.for_each(|(_, values)| values.iter_mut().for_each(|value| *value = change(*value, by)));
        }))
    };
    let scaled = |value: f64, factor: f64| value * factor;
    let mut all = Vec::new();
    if let [one, other] = joints[..] {
        let exchange = move |columns: &mut Readings| {
            let at = |wanted| columns.iter().position(|(id, _)| *id == wanted);
            if let (Some(a), Some(b)) = (at(one), at(other)) {
                let own = std::mem::take(&mut columns[a].1);
                columns[a].1 = std::mem::replace(&mut columns[b].1, own);
            }
        };
        let joints = [name(one), name(other)];
        all.push((Misreading::Exchanged { joints }, Undo::Readings(Box::new(exchange))));
    }
    let tried = if joints.len() > JOINTS { &[][..] } else { &joints[..] };
    for &id in tried {
        all.push((Misreading::Reversed { joint: name(id) }, mapped(vec![id], scaled, -1.0)));
        let from_zenith = mapped(vec![id], |value, by| by - value, FRAC_PI_2);
        all.push((Misreading::FromZenith { joint: name(id) }, from_zenith));
    }
    let alone = tried.iter().filter(|_| joints.len() > 1).map(|&id| vec![id]);
    for ids in std::iter::once(joints.clone()).chain(alone).filter(|ids| !ids.is_empty()) {
        for (factor, unit) in ANGLES {
            let readings = ids.iter().map(|&id| name(id)).collect();
            all.push((Misreading::Unit { readings, unit }, mapped(ids.clone(), scaled, factor)));
        }
    }
    let mut ranges: Vec<SymbolId> =
        sample.poses.series.iter().filter_map(|series| range_of(chain, series.observable)).collect();
    ranges.sort_unstable();
    ranges.dedup();
    if let [range] = ranges[..] {
        for (factor, unit) in LENGTHS {
            let readings = vec![name(range)];
            all.push((Misreading::Unit { readings, unit }, mapped(vec![range], scaled, factor)));
        }
    }
    all
}

/// What a fit leaves.
#[derive(Debug, Clone, Copy)]
struct Left {
    /// RMS without the rows furthest off, SI.
    rms: f64,
    /// How far away what is observed usually is, m.
    away_m: f64,
    /// The largest error that is an angle, rad.
    largest_rad: f64,
}

impl Left {
    /// In units of how far away things are: a room that is read a thousand times as large has residuals a thousand times as large.
    fn relative(&self) -> f64 {
        self.rms / self.away_m
    }
}

/// Rows with a mistake undone, objects and stations where they start.
struct Placed {
    observations: Observations,
    /// What is left at the start, in units of how far away things are.
    relative: f64,
}

/// `None` where there is nowhere to start from.
fn placed(whole: &Context<'_>, sample: &Observations, undo: Option<&Undo>) -> Option<Placed> {
    let plan = whole.request.plan;
    let mut observations = sample.clone();
    let unknowns = observations.unknowns.as_mut()?;
    // As the study says; where the rest is comes from the rows anew.
    for station in unknowns.stations.iter_mut().filter(|own| !own.label.is_empty()) {
        *station = plan.places.station(&station.label);
    }
    for object in &mut unknowns.objects {
        *object = plan.places.object(&object.label, object.shape);
    }
    match undo {
        None => {}
        Some(Undo::Places(change)) => change(unknowns),
        Some(Undo::Readings(change)) => change(&mut observations.poses.columns),
    }
    place(&plan.chain, &mut observations, &plan.fit.start).ok()?;
    if observations.rows() < sample.rows() {
        return None;
    }
    let numbers = observations.unknowns.as_ref()?.numbers();
    let mut values = plan.fit.start.clone();
    values.resize(plan.chain.symbols.len() + numbers, 0.0);
    let model = Model::without_columns(&plan.chain, &observations.poses);
    let raw = residuals(&model, &observations, &values).ok()?;
    let relative = trimmed_rms(&observations, &raw)? / away_m(whole, &observations, &values)?;
    Some(Placed { observations, relative })
}

/// What a fit of them leaves.
fn left_by(whole: &Context<'_>, observations: &Observations) -> Option<Left> {
    let plan = whole.request.plan;
    let noise = NoiseOptions { variance: false, serial: false, ..plan.fit.noise.by_residuals() };
    let options =
        FitOptions { noise, max_iterations: plan.fit.max_iterations.min(STEPS), ..plan.fit.clone() };
    let fit = fit(&plan.chain, observations, &options).ok()?;
    let is_angle = |id: &&SymbolId| plan.chain.symbol(**id).quantity == Quantity::Angle;
    let angles = fit.parameters.iter().filter(is_angle).map(|id| fit.values[id.index()].abs());
    Some(Left {
        rms: trimmed_rms(observations, &fit.residuals.raw)?,
        away_m: away_m(whole, observations, &fit.values)?,
        largest_rad: angles.fold(0.0, f64::max),
    })
}

/// How far away what is observed usually is, m.
fn away_m(whole: &Context<'_>, observations: &Observations, values: &[f64]) -> Option<f64> {
    let points = rows(&whole.request.plan.chain, observations, observations.unknowns.as_ref()?, values);
    Some(robust::median(points.iter().map(|row| row.point.norm()).collect()))
}

/// RMS of the residual without the rows furthest off, SI; `None` where more have none.
fn trimmed_rms(observations: &Observations, raw: &[f64]) -> Option<f64> {
    let layout = Layout::of(observations);
    let mut squares: Vec<f64> = layout.norms(raw).map(|norm| norm * norm).collect();
    let all = squares.len();
    squares.retain(|square| square.is_finite());
    squares.sort_by(f64::total_cmp);
    let kept = all - (all as f64 * FURTHEST) as usize;
    squares.truncate(kept);
    (squares.len() == kept && kept > 0).then(|| (squares.iter().sum::<f64>() / kept as f64).sqrt())
}
