//! Real instruments: what the search must find in them, and how well the amended declaration must do on data that
//! no stage saw (the whole search repeated without each fold).
//!
//! Bounds: `SOURCE.md` beside the data says what others published and found.

use calibration::calibrate::Calibration;

use crate::data::{arcsec, load};

/// Calibrates an example, and holds the RMS of the residuals that no stage saw, SI, to a bound.
fn calibrated(study: &str, bound: f64) -> Option<Calibration> {
    let found = load(study)?.calibrate();
    let (before, after) = (found.diagnosis.before, found.diagnosis.after);
    println!(
        "{study}: held-out RMS {:?} -> {:?} {} (bound {bound}), in sample {:?} -> {:?}",
        before.held_out_rms_kept, after.held_out_rms_kept, found.diagnosis.unit, before.rms, after.rms
    );
    for effect in &found.diagnosis.effects {
        println!("  {} ({}), p {}", effect.text, effect.names.join("; "), effect.p_value);
    }
    let held_out = after.held_out_rms_kept.unwrap();
    assert!(held_out <= bound, "{study}: held-out RMS {held_out} {} above {bound}", found.diagnosis.unit);
    Some(found)
}

/// All names of the effects accepted up to `first`, those that could stand in their place aside.
fn names(found: &Calibration, first: usize) -> Vec<String> {
    found.diagnosis.effects.iter().take(first).flat_map(|effect| effect.names.clone()).collect()
}

fn has(names: &[String], part: &str) -> bool {
    names.iter().any(|name| name.contains(part))
}

fn rad(arcsec: f64) -> f64 {
    (arcsec / 3600.0).to_radians()
}

#[test]
fn auxtel_2022_04_has_the_third_harmonic_of_azimuth() {
    let Some(found) = calibrated("examples/auxtel/auxtel-2022-04.toml", rad(1.78)) else { return };
    assert!(has(&names(&found, 2), "azimuth axis, 3 per turn"), "{:?}", names(&found, 9));
}

/// Published with 22 terms, leaving one out: 7.38 arcsec. An independent nested search found 14.9.
#[test]
fn auxtel_2020_03_follows_a_law_of_elevation() {
    let Some(found) = calibrated("examples/auxtel/auxtel-2020-03.toml", rad(14.9)) else { return };
    assert!(
        found.diagnosis.effects.iter().any(|effect| effect.driver == "elevation"),
        "{:?}",
        names(&found, 9)
    );
    assert_eq!(found.diagnosis.after.held_out_rows_kept, 44, "no row is set aside");
}

#[test]
fn iram_2013_04_bends_and_follows_the_temperature() {
    let Some(found) = calibrated("examples/iram30m/iram30m-2013-04.toml", rad(3.8)) else { return };
    assert!(has(&names(&found, 1), "gravity flexure of tube about x"), "{:?}", names(&found, 9));
    assert!((per_kelvin(&found) + 0.22).abs() < 0.06, "{} arcsec/K", per_kelvin(&found));
}

/// The bound holds over every row, outliers and all.
#[test]
fn iram_2013_10_bends_and_follows_the_temperature_too() {
    let Some(found) = calibrated("examples/iram30m/iram30m-2013-10.toml", rad(3.6)) else { return };
    assert!(has(&names(&found, 1), "gravity flexure of tube about x"), "{:?}", names(&found, 9));
    assert!(found.diagnosis.after.held_out_rms.unwrap() <= rad(3.6));
    assert!((per_kelvin(&found) + 0.22).abs() < 0.06, "{} arcsec/K", per_kelvin(&found));
}

/// How the elevation follows the temperature, arcsec/K.
fn per_kelvin(found: &Calibration) -> f64 {
    let temperature = found.diagnosis.effects.iter().find(|effect| effect.driver == "temperature").unwrap();
    arcsec(*temperature.coefficients.values().next().unwrap())
}

/// The bound holds over every row.
#[test]
fn equatorial_a_bends() {
    let Some(found) = calibrated("examples/equatorial/equatorial-a.toml", rad(165.0)) else { return };
    assert!(has(&names(&found, 1), "gravity flexure of tube about x"), "{:?}", names(&found, 9));
    assert_eq!(found.diagnosis.after.held_out_rows_kept, 454, "no row is set aside");
}

/// An independent analysis left 62 arc seconds over every row. The guards against effects that cancel each other cost 0.8 there,
/// and take 262 to 146 in regions left out; without refraction among the candidates, which a declination does not show, four
/// outliers cost 6 more, what is kept gains 5, and regions left out 3.
#[test]
fn equatorial_b_is_explained() {
    let Some(found) = calibrated("examples/equatorial/equatorial-b.toml", rad(52.0)) else { return };
    assert!(found.diagnosis.after.held_out_rms.unwrap() <= rad(70.0));
}

#[test]
fn encoders_repeat_once_twice_and_four_times_and_with_the_motor() {
    for study in ["examples/encoder/encoder-a.toml", "examples/encoder/encoder-b.toml"] {
        let Some(found) = calibrated(study, 0.03_f64.to_radians()) else { continue };
        let names = names(&found, 99);
        for part in ["eccentricity", "ellipticity", ", 4 per turn", ", 50 per turn", ", 100 per turn"] {
            assert!(has(&names, part), "{study}: {part} in {names:?}");
        }
    }
}

#[test]
fn the_arm_has_joint_errors_and_no_temperature() {
    let Some(found) = calibrated("examples/ur10/ur10.toml", 0.41e-3) else { return };
    assert!(found.diagnosis.effects.iter().all(|effect| !effect.driver.contains("temperature")));
}
