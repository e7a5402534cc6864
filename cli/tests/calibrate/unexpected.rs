//! Beside unknown targets: errors much larger than anybody expects, and functions of a reading that no catalogue has.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::figures::{calibrated, first_effect, holds};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::Folder;
use testkit::Random;

/// What a calibration makes of a room that something reads like this.
fn report(name: &str, seed: u64, read: impl Fn([f64; 3]) -> [f64; 3]) -> Value {
    let folder = Folder::new(name);
    let random = &mut Random::new(seed);
    let room = Room::new(random);
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    folder.write("rows.csv", room.rows_read(random, read)).write("study.toml", STUDY);
    calibrated(&folder, "study.toml")
}

/// Sixty times its size, which holds what the data do not show: as long as it is held, all that it leaves looks like noise.
#[test]
fn a_range_zero_much_larger_than_its_size_is_shown() {
    for (seed, zero_m) in [(51, 0.3), (52, -0.2)] {
        let report =
            report("large-zero", seed, |[azimuth, elevation, range]| [azimuth, elevation, range - zero_m]);
        holds(&report, &[("range_zero", zero_m), ("trunnion", 0.0), ("index", 0.0), ("collimation", 0.0)]);
        assert_eq!(report["effects"], serde_json::json!([]));
    }
}

/// A wave of four metres is neither zero nor scale of the ranges, and has nothing to do with angles.
#[test]
fn a_wave_of_the_range_is_found_along_the_range() {
    let wave = |range: f64| 0.5e-3 * (TAU * range / 4.0).sin();
    let report =
        report("range-wave", 53, |[azimuth, elevation, range]| [azimuth, elevation, range - wave(range)]);
    let effects = report["effects"].as_array().expect("a list");
    assert!(!effects.is_empty());
    for effect in effects {
        assert!(effect["driver"] == "range" && effect["body"] == "beam", "{effect}");
    }
    holds(&report, &[("trunnion", 0.0), ("index", 0.0), ("collimation", 0.0)]);
}

/// A large slow wave is most of what the fit takes for noise; and `range_zero` is what it is where the function that says it is zero.
#[test]
fn a_wave_that_is_most_of_the_noise_is_found() {
    for seed in [57, 58, 59] {
        let wave = |range: f64| 2e-3 * (TAU * range / 8.0).sin();
        let report = report("slow-wave", seed, |[azimuth, elevation, range]| {
            [azimuth, elevation, range - wave(range)]
        });
        let effects = report["effects"].as_array().expect("a list");
        let is_there = |effect: &Value| effect["driver"] == "range" && effect["body"] == "beam";
        assert!(!effects.is_empty() && effects.iter().all(is_there), "{seed}: {effects:?}");
        assert_eq!(report["beside_functions"][0]["errors"], serde_json::json!(["range_zero"]), "{seed}");
    }
}

/// Many harmonics follow two jumps; one plateau says it.
#[test]
fn a_plateau_is_not_taken_for_harmonics() {
    for seed in [54, 55, 56] {
        let report = report("plateau", seed, |[azimuth, elevation, range]| {
            let azimuth = azimuth.rem_euclid(TAU);
            let up = if (1.5..4.0).contains(&azimuth) { 3e-4 } else { 0.0 };
            [azimuth - up, elevation, range]
        });
        assert_eq!(report["effects"].as_array().expect("a list").len(), 1, "{}", report["effects"]);
        assert!(first_effect(&report).contains("plateau"), "{}", first_effect(&report));
    }
}
