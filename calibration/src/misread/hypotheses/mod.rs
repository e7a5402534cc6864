//! What a study may misread: a registry, one file a kind of mistake, each with the readings that it tries.

pub(super) mod both;
mod counts;
mod doubled;
mod exchanged;
pub(super) mod from_row;
mod of_station;
mod order;
mod packed;
pub(super) mod places;
mod sense;
mod shifted;
mod sidereal;
mod turned;
mod unit;
mod written;

use model_core::unit::Unit;
use model_core::{SymbolId, SymbolKind};
use serde::Serialize;

use super::policy::RARE;
use fit::range_of;
use observe::{Observations, SiUnit};
use study::{Change, Changed, Notation, Plan, Read, Sample, SampledColumn};
pub(super) use written::Written;

use places::PlaceChange;
pub use places::StatedPlaces;
pub(super) use turned::QUARTERS;

/// Every kind of mistake.
const KINDS: &[fn(&Tried<'_>) -> Vec<Hypothesis>] = &[
    unit::tried,
    counts::tried,
    packed::tried,
    sense::tried,
    sidereal::tried,
    turned::tried,
    exchanged::tried,
    order::tried,
    shifted::tried,
    doubled::tried,
    places::tried,
    of_station::tried,
];

/// What the kinds of mistake are tried on.
pub(super) struct Tried<'a> {
    pub plan: &'a Plan,
    /// Columns of joints.
    pub joints: Vec<&'a SampledColumn>,
    /// Columns of ranges that are readings.
    pub ranges: Vec<&'a SampledColumn>,
    /// Columns of what was observed.
    pub observed: Vec<&'a SampledColumn>,
    /// The rows as the study reads them.
    pub rows: &'a Observations,
    /// The same with all columns of the file.
    pub sample: &'a Sample,
    /// Joints whose zero is estimated.
    pub indexed: Vec<SymbolId>,
}

/// One way to read the data otherwise.
#[derive(Debug, Clone)]
pub(super) struct Hypothesis {
    pub reading: Reading,
    pub changes: Vec<Changed>,
    /// What changes of the places that the study states.
    pub places: Vec<PlaceChange>,
    pub lines: Vec<Written>,
    pub headings: Vec<Heading>,
    /// How improbable it is beforehand, nats.
    pub price: f64,
    /// What the digits alone say for it, nats.
    pub digits: f64,
}

impl Hypothesis {
    /// One that only the study's lines and its price speak of.
    pub fn new(reading: Reading, changes: Vec<Changed>, lines: Vec<Written>, price: f64) -> Self {
        Self { reading, changes, places: Vec::new(), lines, headings: Vec::new(), price, digits: 0.0 }
    }

    /// How much a reading of a column changes with the number as it is written.
    pub fn factor(&self, column: &SampledColumn) -> f64 {
        let factor = |own: &Changed| match own.change {
            Change::Factor(factor) => Some(factor),
            Change::Notation(Notation::Degrees) => Some(1.0_f64.to_radians()),
            Change::Notation(Notation::Hours) => Some(15e-4_f64.to_radians()),
            Change::Notation(Notation::Counts(per_turn)) => Some(std::f64::consts::TAU / per_turn),
            _ => None,
        };
        let own = self.changes.iter().filter(|own| own.place == column.place);
        own.filter_map(factor).next().unwrap_or(column.factor)
    }
}

/// What is read otherwise.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Reading {
    /// Columns are in another unit.
    Unit {
        /// The columns of the file.
        columns: Vec<String>,
        /// The unit that they are in, and the one that they were read in.
        is: &'static str,
        /// The same as the study reads it; none where it is no unit of the table.
        read: Option<&'static str>,
    },
    /// A column is in counts of an encoder.
    Counts {
        /// The column of the file.
        column: String,
        /// Counts a turn.
        per_turn: u32,
    },
    /// Digits of columns are degrees, minutes and seconds.
    Packed {
        /// The columns of the file.
        columns: Vec<String>,
        /// How they are written.
        notation: &'static str,
    },
    /// A column counts the other way.
    Reversed {
        /// The column of the file.
        column: String,
    },
    /// A column is an angle from the zenith, and was read as one from the horizon.
    FromZenith {
        /// The column of the file.
        column: String,
    },
    /// Columns are right ascensions, read as hour angles: what a sidereal time that the study does not name has more is the hour angle.
    RightAscension {
        /// The columns of the file.
        columns: Vec<String>,
        /// The column of the sidereal time.
        sidereal: String,
    },
    /// A column counts from elsewhere.
    Turned {
        /// The column of the file.
        column: String,
        /// What is to be added, deg.
        by_deg: i16,
    },
    /// Numbers of a column are twice what they are taken for: diameters for radii.
    Doubled {
        /// The column of the file.
        column: String,
    },
    /// x and y of the places that the study states are exchanged: northing and easting.
    PlacesExchanged {
        /// Of which.
        of: StatedPlaces,
    },
    /// The places that the study states are in another unit of length.
    PlacesUnit {
        /// Of which.
        of: StatedPlaces,
        /// The unit that they are in, and the one that they were read in.
        is: &'static str,
        /// The same as the study reads it.
        read: &'static str,
    },
    /// The headings of stations that the study states run the other way.
    HeadingsReversed,
    /// The headings of stations that the study states count from y to x: bearings.
    HeadingsFromY {
        /// Whether x and y are exchanged as well.
        exchanged: bool,
    },
    /// The rows of one station are read otherwise than the rest.
    OfStation {
        /// How they are read.
        reading: Box<Reading>,
        /// The station.
        station: String,
    },
    /// Some rows alone are read otherwise.
    FromRow {
        /// How they are read.
        reading: Box<Reading>,
        /// The first row of them, or the first behind them.
        row: u64,
        /// Whether it is the rows before that one.
        before: bool,
    },
    /// The four columns of a quaternion are in another order.
    Order {
        /// The columns of the file, as the study reads them: w, x, y, z.
        columns: Vec<String>,
        /// What they hold.
        order: &'static str,
    },
    /// A rotation is the inverse of what the study takes it for.
    Inverse {
        /// The columns of the file.
        columns: Vec<String>,
    },
    /// What was measured stands in another frame.
    Frame {
        /// By how much it is to be turned, deg.
        by_deg: f64,
        /// About which axis, a unit vector.
        axis: [f64; 3],
        /// The whole hours in which the sky turns by as much.
        #[serde(skip_serializing_if = "Option::is_none")]
        hours: Option<u8>,
    },
    /// Two mistakes at once.
    Both {
        /// What they are.
        readings: [Box<Reading>; 2],
    },
    /// Rows are of two kinds that no column tells apart.
    TwoStates {
        /// The errors in which they differ.
        errors: Vec<String>,
        /// By how much, SI, error by error.
        by: Vec<f64>,
        /// Their units.
        units: Vec<SiUnit>,
        /// The rows of the smaller kind, of those that were looked at.
        rows: Vec<u64>,
        /// How many rows were looked at.
        of: usize,
    },
    /// Two columns are exchanged.
    Exchanged {
        /// The columns of the file.
        columns: [String; 2],
    },
    /// Readings of joints stand in other rows than what was observed at them.
    Shifted {
        /// The columns of the file.
        columns: Vec<String>,
        /// A row takes the readings of the row that stands so many before.
        by: i64,
    },
}

/// A heading that states another unit than that of its column's numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Heading {
    /// As the file has it.
    pub heading: String,
    /// The unit of the numbers.
    pub is: &'static str,
}

/// A line to write into a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Line {
    /// The table: `columns` or `observed`, or that of the study's `[[also]]`.
    pub table: &'static str,
    /// `azimuth = { column = "az", unit = "gon" }`
    pub text: String,
}

/// Every hypothesis about the columns of a study. Of one kind each is as likely as the others.
pub(super) fn all(
    plan: &Plan,
    columns: &[SampledColumn],
    indexed: Vec<SymbolId>,
    (rows, sample): (&Observations, &Sample),
) -> Vec<Hypothesis> {
    let of = |is: &dyn Fn(&SampledColumn) -> bool| columns.iter().filter(|column| is(column)).collect();
    let joints: Vec<&SampledColumn> = of(&|column| is_joint(plan, column));
    let observed: Vec<&SampledColumn> = of(&|column| matches!(column.read, Read::Observed(_)));
    let measured: Vec<SymbolId> =
        plan.sources.iter().filter_map(|source| range_of(&plan.chain, source.observable)).collect();
    let ranges = of(&|column| matches!(column.read, Read::Reading(id) if measured.contains(&id)));
    let tried = Tried { plan, joints, ranges, observed, rows, sample, indexed };
    let mut all = Vec::new();
    for kind in KINDS {
        let mut own = kind(&tried);
        let alternatives = (own.len().max(1) as f64).ln();
        own.iter_mut().for_each(|hypothesis| hypothesis.price += alternatives - RARE.ln());
        all.extend(own);
    }
    all
}

/// Whether a column holds readings of a joint.
pub(super) fn is_joint(plan: &Plan, column: &SampledColumn) -> bool {
    match column.read {
        Read::Reading(id) => plan.chain.symbol(id).kind == SymbolKind::Joint,
        Read::Observed(_) => false,
    }
}

/// Columns that one habit may spoil: all joints, all that was observed, all with ranges, and each alone.
fn sets<'a>(tried: &Tried<'a>, may: impl Fn(&SampledColumn) -> bool) -> Vec<Vec<&'a SampledColumn>> {
    let of = |columns: &[&'a SampledColumn]| columns.iter().copied().filter(|column| may(column)).collect();
    let (joints, observed): (Vec<&SampledColumn>, Vec<&SampledColumn>) =
        (of(&tried.joints), of(&tried.observed));
    let all = [joints.clone(), observed.clone(), of(&tried.ranges)].concat();
    let each: Vec<Vec<&SampledColumn>> = all.iter().map(|column| vec![*column]).collect();
    let mut sets: Vec<Vec<&SampledColumn>> = Vec::new();
    for set in [joints, observed, all].into_iter().chain(each) {
        if !set.is_empty() && !sets.contains(&set) {
            sets.push(set);
        }
    }
    sets
}

/// How far the numbers of a column reach, as they are written.
fn span(column: &SampledColumn) -> f64 {
    let most = column.written.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = column.written.iter().copied().fold(f64::INFINITY, f64::min);
    most - least
}

/// Each of these columns by its name in the file.
fn names(columns: &[&SampledColumn]) -> Vec<String> {
    columns.iter().map(|column| column.name.clone()).collect()
}

/// A line that reads a column so: `how` is what stands behind its name.
fn line(plan: &Plan, column: &SampledColumn, file_column: &str, how: Vec<(&'static str, String)>) -> Written {
    let source = column.place.source;
    let (tables, key) = match column.read {
        Read::Reading(id) => (["columns", "also.columns"], plan.chain.symbol(id).name.clone()),
        Read::Observed(at) => (["observed", "also.observed"], plan.observed_key(source, at).to_owned()),
    };
    let table = tables[usize::from(source > 0)];
    Written { table, key, column: file_column.to_owned(), how }
}

/// The unit of the study's line for a column, to be kept in a line that changes something else, and what changes.
fn beside_unit(
    column: &SampledColumn,
    how: impl IntoIterator<Item = (&'static str, String)>,
) -> Vec<(&'static str, String)> {
    let unit = named(column).filter(|_| column.unit_is_of_study).map(|unit| ("unit", quoted(unit)));
    unit.into_iter().chain(how).collect()
}

/// A text as a study's file has it.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// The unit that a column is read in.
fn named(column: &SampledColumn) -> Option<&'static str> {
    let is = |unit: &Unit| unit.measures().quantity() == column.quantity && unit.in_si() == column.factor;
    Unit::all().find(is).map(Unit::name)
}
