//! Mistakes that are made with readings and stated places, and how each is undone.

use std::f64::consts::{FRAC_PI_2, PI};

use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use serde::Serialize;

use fit::range_of;
use observe::kinds::MeasuredLengths;
use observe::unknowns::{Known, Places, Pose, Unknowns};
use observe::{Measure, Observations};

/// Joints that are tried one by one at most.
const JOINTS: usize = 8;

/// Stations that are tried one by one at most.
const STATIONS: usize = 12;

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
    /// A joint counts from elsewhere.
    Turned {
        /// The joint.
        joint: String,
        /// What is to be added, degrees.
        by_deg: i32,
    },
    /// Two joints are exchanged.
    Exchanged {
        /// The joints.
        joints: [String; 2],
    },
    /// Readings from one station are in another unit.
    UnitAt {
        /// The station.
        station: String,
        /// The joints.
        readings: Vec<String>,
        /// In which unit they are, and in which they were read.
        unit: &'static str,
    },
    /// Readings are in another unit.
    Unit {
        /// The joints or the range.
        readings: Vec<String>,
        /// In which unit they are, and in which they were read.
        unit: &'static str,
    },
    /// Lengths are twice as long as they are: diameters for radii.
    Doubled {
        /// Which.
        of: MeasuredLengths,
    },
    /// Measured lengths are in another unit.
    LengthsUnit {
        /// Of what.
        of: MeasuredLengths,
        /// In which unit they are, and in which they were read.
        unit: &'static str,
    },
}

impl Misreading {
    /// Whether everything would be as many times as large without it: residuals are too, and say nothing by their size alone.
    pub(super) fn changes_size(&self) -> bool {
        let is_length = |unit: &&str| LENGTHS.iter().any(|(_, own)| own == unit);
        match self {
            Self::PlacesUnit { .. } => true,
            Self::Unit { unit, .. } | Self::UnitAt { unit, .. } => is_length(unit),
            _ => false,
        }
    }
}

/// Joints and inputs with their readings.
pub(super) type Readings = Vec<(SymbolId, Vec<f64>)>;

/// How to undo it.
pub(super) enum Undo {
    Readings(Box<dyn Fn(&mut Readings)>),
    Places(Box<dyn Fn(&mut Unknowns)>),
    /// Lengths that rows of these measures have are to be multiplied.
    Lengths(MeasuredLengths, f64),
}

impl Undo {
    /// Undoes it in some observations.
    pub fn undo(&self, observations: &mut Observations) {
        match self {
            Self::Readings(change) => change(&mut observations.poses.columns),
            Self::Places(change) => observations.unknowns.as_mut().into_iter().for_each(change),
            Self::Lengths(of, factor) => {
                let measures: Vec<Measure> = observations.poses.measures().collect();
                let own = observations.measured.iter_mut().zip(measures);
                for (measured, _) in own.filter(|(_, measure)| measure.kind().lengths == Some(*of)) {
                    measured.stretch_length(*factor);
                }
            }
        }
    }
}

/// Mistakes that are made, and how each is undone; the likeliest first.
pub(super) fn mistakes(chain: &Chain, places: &Places, sample: &Observations) -> Vec<(Misreading, Undo)> {
    let mut all = of_places(places);
    all.extend(of_readings(chain, sample));
    all.extend(of_stations(chain, sample));
    all.extend(of_lengths(sample));
    all
}

fn of_lengths(sample: &Observations) -> Vec<(Misreading, Undo)> {
    let mut kinds: Vec<MeasuredLengths> = Vec::new();
    for of in sample.poses.series.iter().filter_map(|series| series.measure.kind().lengths) {
        if !kinds.contains(&of) {
            kinds.push(of);
        }
    }
    let mut all = Vec::new();
    for of in kinds {
        if of != MeasuredLengths::Wires {
            all.push((Misreading::Doubled { of }, Undo::Lengths(of, 0.5)));
        }
        let units = LENGTHS.into_iter();
        all.extend(
            units.map(|(factor, unit)| (Misreading::LengthsUnit { of, unit }, Undo::Lengths(of, factor))),
        );
    }
    all
}

fn of_places(places: &Places) -> Vec<(Misreading, Undo)> {
    let (objects, stations) = (!places.objects.is_empty(), !places.stations.is_empty());
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

/// Changes places that are written, rough ones too.
fn each_place(unknowns: &mut Unknowns, of: StatedPlaces, change: impl Fn([f64; 3]) -> [f64; 3]) {
    if of != StatedPlaces::Stations {
        let written = unknowns.objects.iter_mut().filter(|own| own.known == Known::Yes);
        written.for_each(|own| own.place = change(own.place.into()).into());
    }
    if of != StatedPlaces::Objects {
        let written = unknowns.stations.iter_mut().filter(|own| own.is_written());
        written.for_each(|own| own.pose.shift = change(own.pose.shift.into()).into());
    }
}

/// Changes the headings that are written of stations, rough ones too.
fn each_heading(unknowns: &mut Unknowns, change: impl Fn(f64) -> f64) {
    for own in unknowns.stations.iter_mut().filter(|own| own.is_written()) {
        let (roll, pitch, heading) = own.pose.turn.euler_angles();
        own.pose = Pose::new(own.pose.shift, roll, pitch, change(heading));
    }
}

fn of_readings(chain: &Chain, sample: &Observations) -> Vec<(Misreading, Undo)> {
    let [joints, shifts] = [Quantity::Angle, Quantity::Length].map(|of| joints(chain, sample, of));
    let name = |id: SymbolId| chain.symbol(id).name.clone();
    let mapped = |ids: Vec<SymbolId>, change: fn(f64, f64) -> f64, by: f64| {
        Undo::Readings(Box::new(move |columns| {
            let own = columns.iter_mut().filter(|(id, _)| ids.contains(id));
            own.for_each(|(_, values)| values.iter_mut().for_each(|value| *value = change(*value, by)));
        }))
    };
    let scaled = |value: f64, factor: f64| value * factor;
    let mut all = Vec::new();
    let few = |joints: &[SymbolId]| if joints.len() > JOINTS { Vec::new() } else { joints.to_vec() };
    let (tried, tried_shifts) = (few(&joints), few(&shifts));
    for [one, other] in pairs(&tried).chain(pairs(&tried_shifts)) {
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
    for &id in &tried_shifts {
        all.push((Misreading::Reversed { joint: name(id) }, mapped(vec![id], scaled, -1.0)));
    }
    for &id in &tried {
        all.push((Misreading::Reversed { joint: name(id) }, mapped(vec![id], scaled, -1.0)));
        let from_zenith = mapped(vec![id], |value, by| by - value, FRAC_PI_2);
        all.push((Misreading::FromZenith { joint: name(id) }, from_zenith));
    }
    for &id in &tried {
        for quarters in [1, -1, 2] {
            let turned = mapped(vec![id], |value, by| value + by, f64::from(quarters) * FRAC_PI_2);
            all.push((Misreading::Turned { joint: name(id), by_deg: 90 * quarters }, turned));
        }
    }
    // All together, and each alone.
    let sets = |all: Vec<SymbolId>, tried: &[SymbolId]| {
        let alone: Vec<Vec<SymbolId>> = tried.iter().filter(|_| all.len() > 1).map(|&id| vec![id]).collect();
        std::iter::once(all).chain(alone).filter(|ids| !ids.is_empty())
    };
    let of_angles = sets(joints, &tried).map(|ids| (ids, ANGLES));
    let of_lengths =
        range(chain, sample).map(|range| vec![range]).into_iter().chain(sets(shifts, &tried_shifts));
    for (ids, units) in of_angles.chain(of_lengths.map(|ids| (ids, LENGTHS))) {
        for (factor, unit) in units {
            let readings = ids.iter().map(|&id| name(id)).collect();
            all.push((Misreading::Unit { readings, unit }, mapped(ids.clone(), scaled, factor)));
        }
    }
    all
}

/// Every two of some joints.
fn pairs(joints: &[SymbolId]) -> impl Iterator<Item = [SymbolId; 2]> {
    joints.iter().enumerate().flat_map(|(at, &one)| joints[at + 1..].iter().map(move |&other| [one, other]))
}

/// The range that rows are measured with, where there is one.
pub(super) fn range(chain: &Chain, sample: &Observations) -> Option<SymbolId> {
    let mut ranges: Vec<SymbolId> =
        sample.poses.series.iter().filter_map(|series| range_of(chain, series.observable)).collect();
    ranges.sort_unstable();
    ranges.dedup();
    if let [range] = ranges[..] { Some(range) } else { None }
}

/// The rows of one station in another unit than those of the others.
fn of_stations(chain: &Chain, sample: &Observations) -> Vec<(Misreading, Undo)> {
    let Some(unknowns) = &sample.unknowns else { return Vec::new() };
    let ranges = range(chain, sample).into_iter().collect();
    let read = [(joints(chain, sample, Quantity::Angle), ANGLES), (ranges, LENGTHS)];
    let mut all = Vec::new();
    let labels = unknowns.stations.iter().map(|own| &own.label);
    for (at, label) in labels.enumerate().filter(|(_, label)| !label.is_empty()).take(STATIONS) {
        let is_own: Vec<bool> = unknowns.station.iter().map(|&own| own as usize == at).collect();
        if !is_own.contains(&true) || !is_own.contains(&false) {
            continue;
        }
        let units = read.iter().filter(|(ids, _)| !ids.is_empty());
        for (ids, (factor, unit)) in units.flat_map(|(ids, units)| units.iter().map(move |unit| (ids, *unit)))
        {
            let readings = ids.iter().map(|&id| chain.symbol(id).name.clone()).collect();
            let (ids, is_own) = (ids.clone(), is_own.clone());
            let undo = move |columns: &mut Readings| {
                for (_, values) in columns.iter_mut().filter(|(id, _)| ids.contains(id)) {
                    let own = values.iter_mut().zip(&is_own).filter(|(_, is_own)| **is_own);
                    own.for_each(|(value, _)| *value *= factor);
                }
            };
            let mistake = Misreading::UnitAt { station: label.clone(), readings, unit };
            all.push((mistake, Undo::Readings(Box::new(undo))));
        }
    }
    all
}

/// The joints that turn, or those that shift, and are read.
fn joints(chain: &Chain, sample: &Observations, of: Quantity) -> Vec<SymbolId> {
    let is_one = |id: &SymbolId| {
        let symbol = chain.symbol(*id);
        symbol.kind == SymbolKind::Joint && symbol.quantity == of
    };
    sample.poses.columns.iter().map(|(id, _)| *id).filter(is_one).collect()
}
