//! The places that a study states: x and y exchanged, another unit, headings that run the other way or are bearings.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;
use serde::Serialize;

use super::{Hypothesis, Reading, Tried};
use crate::misread::policy::{EXCHANGED_PRICE, ZENITH_PRICE};
use observe::unknowns::{Known, Object, Pose, Station};

/// What a number in one unit is to be multiplied by where it was read in another.
const UNITS: [(f64, [&str; 2]); 4] =
    [(1e-3, ["mm", "m"]), (1e3, ["m", "mm"]), (0.3048, ["ft", "m"]), (1.0 / 0.3048, ["m", "ft"])];

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

/// What is read otherwise of stated places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::misread) enum PlaceChange {
    /// x and y are exchanged.
    Exchanged(StatedPlaces),
    /// Every coordinate is multiplied.
    Scaled(StatedPlaces, f64),
    /// Headings run the other way.
    HeadingsReversed,
    /// Headings count from y to x.
    HeadingsFromY,
}

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let places = &tried.plan.places;
    let kinds: &[StatedPlaces] = match (places.objects.is_empty(), places.stations.is_empty()) {
        (false, false) => &[StatedPlaces::Both, StatedPlaces::Objects, StatedPlaces::Stations],
        (false, true) => &[StatedPlaces::Objects],
        (true, false) => &[StatedPlaces::Stations],
        (true, true) => &[],
    };
    let own = |reading: Reading, places: Vec<PlaceChange>, price: f64| Hypothesis {
        places,
        ..Hypothesis::new(reading, Vec::new(), Vec::new(), price)
    };
    let mut all = Vec::new();
    for &of in kinds {
        all.push(own(Reading::PlacesExchanged { of }, vec![PlaceChange::Exchanged(of)], EXCHANGED_PRICE));
        all.extend(UNITS.map(|(factor, [is, read])| {
            own(Reading::PlacesUnit { of, is, read }, vec![PlaceChange::Scaled(of, factor)], 0.0)
        }));
    }
    if !places.stations.is_empty() {
        all.push(own(Reading::HeadingsReversed, vec![PlaceChange::HeadingsReversed], ZENITH_PRICE));
        let from_y = |exchanged: bool| Reading::HeadingsFromY { exchanged };
        let both = vec![PlaceChange::HeadingsFromY, PlaceChange::Exchanged(StatedPlaces::Both)];
        all.push(own(from_y(false), vec![PlaceChange::HeadingsFromY], ZENITH_PRICE));
        all.push(own(from_y(true), both, ZENITH_PRICE + EXCHANGED_PRICE));
    }
    all
}

impl PlaceChange {
    /// Changes places that are written, rough ones too.
    pub fn make(self, objects: &mut [Object], stations: &mut [Station]) {
        match self {
            Self::Exchanged(of) => each(objects, stations, of, |at| Vector3::new(at.y, at.x, at.z)),
            Self::Scaled(of, factor) => each(objects, stations, of, |at| at * factor),
            Self::HeadingsReversed => each_heading(stations, |heading| -heading),
            Self::HeadingsFromY => each_heading(stations, |heading| FRAC_PI_2 - heading),
        }
    }
}

fn each(
    objects: &mut [Object],
    stations: &mut [Station],
    of: StatedPlaces,
    change: impl Fn(Vector3<f64>) -> Vector3<f64>,
) {
    if of != StatedPlaces::Stations {
        objects
            .iter_mut()
            .filter(|own| own.known == Known::Yes)
            .for_each(|own| own.place = change(own.place));
    }
    if of != StatedPlaces::Objects {
        let written = stations.iter_mut().filter(|own| own.is_written());
        written.for_each(|own| own.pose.shift = change(own.pose.shift));
    }
}

fn each_heading(stations: &mut [Station], change: impl Fn(f64) -> f64) {
    for own in stations.iter_mut().filter(|own| own.is_written()) {
        let (roll, pitch, heading) = own.pose.turn.euler_angles();
        own.pose = Pose::new(own.pose.shift, roll, pitch, change(heading));
    }
}
