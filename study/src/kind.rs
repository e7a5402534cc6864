//! What the numbers of an observation are, as a study writes it: a name from the registry of kinds.

use model_core::{Observable, ObservableKind};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use observe::Measure;
use observe::kinds::{Asked, NAMES, Observes, OfReadings, Written, ways};

/// A name of the registry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind(&'static str);

impl<'de> Deserialize<'de> for Kind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let known = NAMES.iter().find(|own| **own == name);
        known.map(|own| Self(own)).ok_or_else(|| D::Error::unknown_variant(&name, &NAMES))
    }
}

impl Kind {
    /// As it is written.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// The ways that have this name.
    fn ways(self) -> impl Iterator<Item = (Measure, &'static Written)> {
        ways().filter(move |(_, way)| way.name == self.0)
    }

    /// Which of them is meant for an observable; `None` where none measures it.
    pub fn way(self, of: Observes, asked: &Asked<'_>) -> Option<(Measure, &'static Written)> {
        self.ways().find(|(_, way)| way.of == of && (way.is_meant)(asked))
    }

    /// What is measured of an object where these keys are written; `None` where none is observed.
    pub fn of_object(self, names: &dyn Fn(&str) -> bool) -> Option<Measure> {
        let asked = Asked { names, shows_two: false };
        let meant = self.ways().find(|(measure, way)| measure.observes_object() && (way.is_meant)(&asked));
        meant.map(|(measure, _)| measure)
    }

    /// Whether rows observe objects of which nobody knows where they are.
    pub fn observes_objects(self) -> bool {
        self.ways().any(|(measure, _)| measure.observes_object())
    }

    /// Whether it measures an observable that is this.
    pub fn measures(self, of: Observes) -> bool {
        self.ways_of(of).next().is_some()
    }

    /// The kinds by which an observable that is this may be measured.
    pub fn ways_of(self, of: Observes) -> impl Iterator<Item = Measure> {
        self.ways().filter(move |(_, way)| way.of == of).map(|(measure, _)| measure)
    }

    /// Which readings of an instrument its columns may hold.
    pub fn of_readings(self) -> OfReadings {
        self.ways().next().map_or(OfReadings::Nothing, |(_, way)| way.of_readings)
    }
}

/// What an observable is.
pub fn observes(observable: &Observable) -> Observes {
    if observable.is_orientation() {
        Observes::Orientation
    } else if observable.is_image() {
        Observes::Image
    } else if observable.kind == ObservableKind::Point {
        Observes::Point
    } else {
        Observes::Direction
    }
}

/// The names that are measured so, as a sentence lists them: `"a", "b" or "c"`.
pub fn names_of(is_listed: impl Fn(Kind) -> bool) -> String {
    let names = NAMES.iter().filter(|name| is_listed(Kind(name))).map(|name| format!("\"{name}\""));
    let names: Vec<String> = names.collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}
