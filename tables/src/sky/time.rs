//! Instants of UTC, and the sidereal time there.

use std::f64::consts::TAU;

use chrono::{NaiveDate, NaiveDateTime, NaiveTime};

use super::{nutation, precession};

/// 2000 January 1, 12 h, as a Julian day.
const J2000: f64 = 2_451_545.0;
/// Days of a Julian century.
const CENTURY: f64 = 36_525.0;
/// TT less UTC, days: since 2017; a few seconds more or less turn precession and aberration by nothing that shows.
///
/// Source: IERS, Bulletin C 52 (2016).
const TT: f64 = 69.184 / 86_400.0;
/// The day zero of modified Julian days.
const MODIFIED: f64 = 2_400_000.5;

/// An instant of UTC, within 0.9 s of UT1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Days since J2000.
    days: f64,
}

impl Moment {
    /// Of a Julian day.
    #[must_use]
    pub fn of_julian_day(day: f64) -> Self {
        Self { days: day - J2000 }
    }

    /// Of a modified Julian day.
    #[must_use]
    pub fn of_modified_julian_day(day: f64) -> Self {
        Self { days: day - (J2000 - MODIFIED) }
    }

    /// Of a date and a time as ISO 8601 and FITS write them, `2026-01-31T18:01:00.5`, with a blank for the `T` and a `Z` behind; none of
    /// anything else.
    #[must_use]
    pub fn of_text(text: &str) -> Option<Self> {
        let text = text.trim().trim_matches(['\'', '"']).trim();
        let text = text.strip_suffix(['Z', 'z']).or_else(|| text.strip_suffix("+00:00")).unwrap_or(text);
        let read = |form: &str| NaiveDateTime::parse_from_str(text, form).ok();
        let instant = ["%Y-%m-%dT%H:%M:%S%.f", "%Y-%m-%d %H:%M:%S%.f", "%Y/%m/%d %H:%M:%S%.f"];
        let instant = instant.iter().find_map(|form| read(form))?;
        let noon = NaiveDate::from_ymd_opt(2000, 1, 1)?.and_time(NaiveTime::from_hms_opt(12, 0, 0)?);
        let since = instant - noon;
        let seconds = since.num_seconds() as f64 + f64::from(since.subsec_nanos()) * 1e-9;
        Some(Self { days: seconds / 86_400.0 })
    }

    /// Julian centuries of TT since J2000.
    #[must_use]
    pub(super) fn centuries_tt(self) -> f64 {
        (self.days + TT) / CENTURY
    }
}

/// The apparent sidereal time at a longitude (degrees, east positive), hours.
///
/// Source: IERS Conventions (2010), equations 5.14 and 5.32: the angle of the Earth's rotation and the precession of the equinox, with the
/// equation of the equinoxes.
#[must_use]
pub fn sidereal_hours(instant: Moment, longitude_deg: f64) -> f64 {
    let t = instant.centuries_tt();
    let rotated =
        0.779_057_273_264_0 + 0.002_737_811_911_354_48 * instant.days + instant.days.rem_euclid(1.0);
    let precessed_arcsec =
        0.014_506 + t * (4_612.156_534 + t * (1.391_581_7 + t * (-0.000_000_44 - t * 0.000_029_956)));
    let [in_longitude, _] = nutation::angles(t);
    let equation_turns = in_longitude * precession::obliquity(t).cos() / TAU;
    let turns = rotated + precessed_arcsec / 1_296_000.0 + equation_turns + longitude_deg / 360.0;
    turns.rem_euclid(1.0) * 24.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_are_read_as_they_are_written() {
        let noon = Moment::of_julian_day(2_451_545.0);
        for text in [
            "2000-01-01T12:00:00",
            "2000-01-01 12:00:00.000Z",
            "'2000-01-01T12:00:00.00'",
            "2000/01/01 12:00:00",
        ] {
            assert_eq!(Moment::of_text(text), Some(noon), "{text}");
        }
        assert_eq!(Moment::of_modified_julian_day(51_544.5), noon);
        for text in [
            "",
            "2000-01-01",
            "2000-02-30T12:00:00",
            "2000-01-01T25:00:00",
            "12:00:00",
            "2000-01-01T12:00:00+01:00",
        ] {
            assert_eq!(Moment::of_text(text), None, "{text}");
        }
    }
}
