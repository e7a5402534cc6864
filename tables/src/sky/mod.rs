//! The sky of a date: from J2000 to the equator and equinox of date, and the sidereal time.
//!
//! What is seen is the apparent place as seen from the centre of the Earth: precession and nutation turn the frame, aberration moves the star.
//! Left out are the Earth's own turning (0.3″ at most), light that the Sun bends (0.02″ from 20° of it on), refraction, and parallax and proper motion, which a plate solve has in it.

mod nutation;
mod precession;
mod time;

pub use time::{Moment, sidereal_hours};

use std::f64::consts::TAU;

/// The constant of aberration, rad.
///
/// Source: IAU (1976) system, 20.49552″.
const ABERRATION: f64 = 20.495_52 * ARCSEC;
/// One arc second, rad.
const ARCSEC: f64 = TAU / 1_296_000.0;

/// A direction or a velocity.
type Vector = [f64; 3];
/// Rows of a rotation.
type Matrix = [Vector; 3];

/// The apparent right ascension (hours) and declination (degrees) of date of a place of J2000 (the frame of catalogues, ICRS).
#[must_use]
pub fn of_date(instant: Moment, [right_ascension_hours, declination_deg]: [f64; 2]) -> [f64; 2] {
    let centuries = instant.centuries_tt();
    let [(sin_ra, cos_ra), (sin_dec, cos_dec)] =
        [15.0 * right_ascension_hours, declination_deg].map(|degrees| degrees.to_radians().sin_cos());
    let star = [cos_dec * cos_ra, cos_dec * sin_ra, sin_dec];
    let velocity = earth(centuries);
    // Second order in v/c is 0.001″.
    let along: f64 = (0..3).map(|axis| star[axis] * velocity[axis]).sum();
    let moved: Vector = std::array::from_fn(|axis| star[axis] + velocity[axis] - along * star[axis]);
    let [x, y, z] = turned(&precession::matrix(centuries, nutation::angles(centuries)), moved);
    let hours = (y.atan2(x) / TAU * 24.0).rem_euclid(24.0);
    [hours, z.atan2(x.hypot(y)).to_degrees()]
}

/// The velocity of the Earth over that of light, in the frame of J2000, to 0.02″: an ellipse about the Sun.
///
/// Source: J. Meeus, Astronomical Algorithms (1998), chapters 23 and 25.
fn earth(centuries: f64) -> Vector {
    let t = centuries;
    let mean_longitude = 280.466_46 + t * (36_000.769_83 + t * 0.000_303_2);
    let anomaly = (357.529_11 + t * (35_999.050_29 - t * 0.000_153_7)).to_radians();
    let equation = (1.914_602 - 0.004_817 * t) * anomaly.sin()
        + (0.019_993 - 0.000_101 * t) * (2.0 * anomaly).sin()
        + 0.000_289 * (3.0 * anomaly).sin();
    let eccentricity = 0.016_708_634 - t * (0.000_042_037 + t * 0.000_000_126_7);
    // Longitudes of date less the general precession since J2000.
    let precessed = t * (1.396_971 + t * 0.000_308_6);
    let sun = (mean_longitude + equation - precessed).to_radians();
    let perihelion = (102.937_35 + t * (1.719_46 + t * 0.000_46) - precessed).to_radians();
    let (sin_sun, cos_sun) = sun.sin_cos();
    let (sin_perihelion, cos_perihelion) = perihelion.sin_cos();
    let (x, y) = (
        ABERRATION * (sin_sun - eccentricity * sin_perihelion),
        ABERRATION * (-cos_sun + eccentricity * cos_perihelion),
    );
    let (sin_tilt, cos_tilt) = (precession::OBLIQUITY_ARCSEC * ARCSEC).sin_cos();
    [x, y * cos_tilt, y * sin_tilt]
}

fn turned(matrix: &Matrix, vector: Vector) -> Vector {
    matrix.map(|row| (0..3).map(|axis| row[axis] * vector[axis]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By `tests/sky/apparent.py`, which is ERFA's.
    const REFERENCE: &str = include_str!("../../tests/sky/apparent.txt");

    #[test]
    fn validate_places_of_date_and_sidereal_times_to_a_tenth_of_an_arc_second() {
        let mut farthest_arcsec: f64 = 0.0;
        let mut rows = 0;
        for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let &[days, ra, dec, expected_ra, expected_dec, longitude, sidereal] = numbers.as_slice() else {
                panic!("{line}")
            };
            let instant = Moment::of_julian_day(days);
            let [found_ra, found_dec] = of_date(instant, [ra, dec]);
            let turn = |hours: f64| 15.0 * 3600.0 * (hours - 24.0 * (hours / 24.0).round());
            let across = turn(found_ra - expected_ra) * expected_dec.to_radians().cos();
            let along = 3600.0 * (found_dec - expected_dec);
            let late = turn(sidereal_hours(instant, longitude) - sidereal);
            farthest_arcsec = farthest_arcsec.max(across.abs()).max(along.abs()).max(late.abs());
            rows += 1;
        }
        assert!(rows >= 40 && farthest_arcsec < 0.1, "{rows} rows, up to {farthest_arcsec} arcsec");
    }
}
