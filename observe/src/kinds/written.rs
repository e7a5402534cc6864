//! How a study writes a kind of observation, and how a row of a table is read by it.

use std::sync::LazyLock;

use model_core::Quantity;
use nalgebra::{UnitQuaternion, Vector3};

use super::Measure;
use super::measured::Measured;

/// How far from one the length of a unit vector may be in a file: written with three digits.
pub const UNIT_TOLERANCE: f64 = 2e-3;

/// What the observable of a chain is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Observes {
    /// A direction.
    Direction,
    /// A point.
    Point,
    /// How a body is turned.
    Orientation,
    /// Where a camera sees a point.
    Image,
}

/// Which readings of an instrument may stand in the columns, where an observable shows readings and no vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OfReadings {
    /// None.
    Nothing,
    /// An azimuth, and an elevation or a zenith distance.
    TwoAngles,
    /// A range.
    Range,
}

/// A column that a study names by a key.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The key.
    pub name: &'static str,
    /// Words of a header, in small letters, by any of which a column is taken for it; empty where none is guessed.
    pub headers: &'static [&'static str],
}

impl Key {
    /// A column whose header is not guessed.
    pub(super) const fn new(name: &'static str) -> Self {
        Self { name, headers: &[] }
    }
}

/// What a study has written, as far as it tells one way from another of the same name.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// Whether a key is written.
    pub names: &'a dyn Fn(&str) -> bool,
    /// Whether the observable shows two readings.
    pub shows_two: bool,
}

/// One row of a table, as a kind reads it.
pub trait Cells {
    /// The number in a column, SI; 0 where there is no such column.
    fn at(&self, column: usize) -> f64;

    /// The unit vector of an azimuth and an elevation (or what the observable counts for it), rad, and the elevation.
    fn direction(&self, azimuth_rad: f64, second_rad: f64) -> (Vector3<f64>, f64);

    /// The vector of the observable at the readings of the row without errors.
    fn nominal(&mut self) -> Vector3<f64>;

    /// The orientation that the columns say.
    ///
    /// # Errors
    /// Why they say none.
    fn orientation(&mut self) -> Result<UnitQuaternion<f64>, String>;
}

/// What a chain shows in one row, as a kind writes it.
pub trait Shows {
    /// The vector of the observable.
    fn vector(&self) -> Vector3<f64>;

    /// The same without errors.
    fn nominal(&self) -> Vector3<f64>;

    /// The azimuth and the elevation (or what the observable counts for it) of a direction, rad.
    fn angles(&self, direction: &Vector3<f64>) -> [f64; 2];
}

/// How the columns of a way are filled with what a chain shows.
#[derive(Debug, Clone, Copy)]
pub struct Filled {
    /// The numbers, SI, in the order of the columns; those behind the last column mean nothing.
    pub of: fn(&dyn Shows) -> [f64; 3],
    /// Whether they depend on what is shown without errors.
    pub beside_nominal: bool,
    /// Whether the first is an angle that goes round.
    pub turns: bool,
}

impl Filled {
    /// With numbers of the vector alone, of which none goes round.
    pub(super) const fn with(of: fn(&dyn Shows) -> [f64; 3]) -> Option<Self> {
        Some(Self { of, beside_nominal: false, turns: false })
    }
}

/// A way to write a kind in a study: `kind = "…"` and its columns.
#[derive(Debug)]
pub struct Written {
    /// The name.
    pub name: &'static str,
    /// What has to be observed.
    pub of: Observes,
    /// What the numbers of its columns are; those of an orientation are what its columns are.
    pub quantity: Quantity,
    /// The columns, in order. Of several lists that count of which a column is named, else the last. None is given for an
    /// orientation, of which there are more ways than lists.
    pub columns: &'static [&'static [Key]],
    /// The readings that may stand in them.
    pub of_readings: OfReadings,
    /// Whether it is this that is meant, of several ways of one name.
    pub is_meant: fn(&Asked<'_>) -> bool,
    /// Reads a row; an error says why it cannot be.
    pub read: fn(&mut dyn Cells) -> Result<Measured, String>,
    /// How it is written of what a chain shows; `None` where its rows hold what a chain alone does not show.
    pub filled: Option<Filled>,
}

impl Written {
    /// One that has its name for itself and whose rows hold nothing but the readings.
    pub(super) const fn readings(name: &'static str, of: Observes, quantity: Quantity) -> Self {
        Self {
            name,
            of,
            quantity,
            columns: &[],
            of_readings: OfReadings::Nothing,
            is_meant: |_| true,
            read: |_| Ok(Measured::Readings),
            filled: None,
        }
    }

    /// The columns that count where a study names these.
    #[must_use]
    pub fn columns(&self, asked: &Asked<'_>) -> &'static [Key] {
        let is_named = |own: &&&[Key]| own.iter().any(|key| (asked.names)(key.name));
        self.columns.iter().find(is_named).or(self.columns.last()).copied().unwrap_or_default()
    }
}

/// Every way in which a study may write a kind, in the order of the table.
pub fn ways() -> impl Iterator<Item = (Measure, &'static Written)> {
    Measure::ALL.iter().flat_map(|&measure| measure.kind().written.iter().map(move |way| (measure, way)))
}

/// The names that a study may write, each once.
pub static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let mut names: Vec<&'static str> = Vec::new();
    for (_, way) in ways() {
        if !names.contains(&way.name) {
            names.push(way.name);
        }
    }
    names
});

/// The words in a header by which a column of this key is guessed, in small letters.
#[must_use]
pub fn headers(key: &str) -> &'static [&'static str] {
    let keys = ways().flat_map(|(_, way)| way.columns.iter().copied().flatten());
    keys.filter(|own| own.name == key).map(|own| own.headers).find(|own| !own.is_empty()).unwrap_or_default()
}

/// A length of a row, which is not negative.
pub(super) fn length(cells: &mut dyn Cells) -> Result<Measured, String> {
    let length_m = cells.at(0);
    if length_m < 0.0 {
        return Err(format!("a length of {length_m} m is negative"));
    }
    Ok(Measured::Length { length_m })
}
