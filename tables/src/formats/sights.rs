//! Sights of an equatorial mount: where it truly pointed and where it said, as hour angles and declinations, with the side of its pier.

use crate::sky::{Moment, of_date, sidereal_hours};

/// The columns of sights.
pub(super) const NAMES: [&str; 5] =
    ["true_ha_deg", "true_dec_deg", "encoder_ha_deg", "encoder_dec_deg", "pier_sign"];

/// Which of them a file has.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Sight {
    /// Hour angle and declination of what was seen, degrees.
    pub truth_deg: Option<[f64; 2]>,
    /// The same as the mount said it.
    pub read_deg: Option<[f64; 2]>,
    /// 1 normal, −1 through the pole.
    pub pier: Option<f64>,
}

impl Sight {
    /// Its cells in the order of the columns; none where it has none.
    pub fn cells(&self) -> [Option<f64>; 5] {
        let of = |place: Option<[f64; 2]>, at: usize| place.map(|place| place[at]);
        [of(self.truth_deg, 0), of(self.truth_deg, 1), of(self.read_deg, 0), of(self.read_deg, 1), self.pier]
    }
}

/// Of which equator and equinox a place is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Equinox {
    Date,
    J2000,
}

impl Equinox {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Date => "of date",
            Self::J2000 => "J2000",
        }
    }
}

/// Where an instrument stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// Latitude, degrees, north positive.
    pub latitude_deg: f64,
    /// Longitude, degrees, east positive.
    pub longitude_deg: f64,
}

/// When a sight was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clock {
    sidereal_hours: f64,
    instant: Option<Moment>,
}

impl Clock {
    /// By a sidereal time in hours, or else by an instant at a site; none without either.
    pub fn of(sidereal: Option<f64>, instant: Option<Moment>, site: Option<Site>) -> Option<Self> {
        let computed = || Some(sidereal_hours(instant?, site?.longitude_deg));
        sidereal.or_else(computed).map(|sidereal_hours| Self { sidereal_hours, instant })
    }

    /// Hour angle and declination of date, degrees, of a right ascension in hours and a declination in degrees. Places of J2000 need an
    /// instant.
    pub fn seen(&self, equinox: Equinox, place: [f64; 2]) -> [f64; 2] {
        let [ra, dec] = match (equinox, self.instant) {
            (Equinox::J2000, Some(instant)) => of_date(instant, place),
            _ => place,
        };
        [ha_deg(self.sidereal_hours, ra), dec]
    }
}

/// The hour angle of a right ascension at a sidereal time, both in hours, as degrees between −180 and 180.
pub(super) fn ha_deg(sidereal_hours: f64, right_ascension_hours: f64) -> f64 {
    let degrees = 15.0 * (sidereal_hours - right_ascension_hours);
    degrees - 360.0 * (degrees / 360.0).round()
}

/// The side of the pier that a cell states: 1 where the tube is east of it and looks west, the normal way; −1 on the other side.
///
/// Source: ASCOM Initiative, `ITelescopeV3.SideOfPier`: `pierEast` is the normal pointing state, `pierWest` the one through the pole.
pub(super) fn pier(text: &str) -> Option<f64> {
    let word: String = text.trim().to_lowercase().chars().filter(|letter| letter.is_alphanumeric()).collect();
    match word.as_str() {
        "e" | "east" | "piereast" | "normal" => Some(1.0),
        "w" | "west" | "pierwest" | "throughthepole" | "beyondthepole" => Some(-1.0),
        _ => None,
    }
}

/// What was taken for granted of the side of the pier.
pub(super) const PIER_REMARK: &str = "the side of the pier is where the tube is: `E` looks west and is the normal side, `W` looks east; if \
                                      your program means where the tube looks, swap them";
