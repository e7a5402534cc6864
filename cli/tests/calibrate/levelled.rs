//! Stations that were levelled, and nothing else is known of.

use std::fmt::Write;

use nalgebra::{Rotation3, Vector3};

use crate::figures::{calibrated, cautions, holds, number};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::{Folder, run_in};
use testkit::Random;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
const LEVELLED: &str = "[stations]\n\"*\" = { levelled = \"5 arcsec\" }\n";

/// The room's targets in two faces; the last station shares two of them with the others and has six of its own. Each is off level by
/// so many rad.
fn rows(room: &Room, random: &mut Random, off_level_rad: f64) -> String {
    let mut rows = String::from("station,object,azimuth [rad],elevation [rad],range [m]\n");
    for (number, ([x, y, z], heading)) in room.stations.iter().enumerate() {
        let [roll, pitch] = [(); 2].map(|()| off_level_rad * random.normal());
        let turn = Rotation3::from_euler_angles(roll, pitch, *heading);
        for (target, [p, q, r]) in room.targets.iter().enumerate() {
            if (number == 2 && (2..24).contains(&target)) || (number < 2 && target >= 24) {
                continue;
            }
            let own = turn.inverse() * Vector3::new(p - x, q - y, r - z);
            let (azimuth, elevation, range) = (own.x.atan2(own.y), (own.z / own.norm()).asin(), own.norm());
            let pi = std::f64::consts::PI;
            for [azimuth, elevation] in [[azimuth, elevation], [azimuth + pi, pi - elevation]] {
                let [across, up, along] = [1e-5, 1e-5, 2e-5].map(|noise| noise * random.normal());
                let (azimuth, elevation, range) = (azimuth + across, elevation + up, range + along);
                writeln!(rows, "S{number},T{target},{azimuth:.9},{elevation:.9},{range:.7}")
                    .expect("a string");
            }
        }
    }
    rows
}

/// Two shared targets place a levelled station, and its levels hold it in rows that are held out, too.
#[test]
fn two_targets_place_a_levelled_station() {
    let folder = Folder::new("levelled");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    for seed in 1..=5 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        folder.write("rows.csv", rows(&room, random, 5.0 * ARCSEC)).write("study.toml", STUDY);
        let run = run_in(&folder.0, &["calibrate", "study.toml"], "");
        assert!(run.code == 2 && run.stderr.contains("two of a levelled station"), "{run}");
        folder.write("study.toml", format!("{STUDY}{LEVELLED}"));
        let report = calibrated(&folder, "study.toml");
        let zero = ["trunnion", "index", "beam_aside", "collimation", "range_zero"].map(|name| (name, 0.0));
        holds(&report, &zero);
        assert!(cautions(&report, "not where it is stated").is_empty(), "{}", report["cautions"]);
        for station in report["places"]["stations"].as_array().expect("stations") {
            let [turns, sigma] = ["turns_rad", "turn_uncertainties_rad"].map(|key| &station[key]);
            for axis in 0..2 {
                assert!(number(&turns[axis]).abs() < 25.0 * ARCSEC, "{seed}: {station}");
                assert!((0.5..6.0).contains(&(number(&sigma[axis]) / ARCSEC)), "{seed}: {station}");
            }
        }
        let held_out = number(&report["after"]["held_out_rms_kept"]);
        assert!(held_out < 3.0 * number(&report["after"]["rms"]), "{seed}: {}", report["after"]);
    }
}

/// One that was not levelled says so.
#[test]
fn a_station_that_is_off_level_is_named() {
    let folder = Folder::new("levelled-off");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    let random = &mut Random::new(7);
    let room = Room::new(random);
    folder
        .write("rows.csv", rows(&room, random, 90.0 * ARCSEC))
        .write("study.toml", format!("{STUDY}{LEVELLED}"));
    let run = run_in(&folder.0, &["calibrate", "study.toml"], "");
    assert!(run.stdout.contains("out of level"), "{run}");
}

#[test]
fn a_level_beside_a_pose_is_refused() {
    let folder = Folder::new("levelled-refused");
    folder.write("tracker.chain", TRACKER);
    let random = &mut Random::new(3);
    folder.write("rows.csv", Room::new(random).rows(random, 0.0));
    let exact = "x = \"0 m\", y = \"0 m\", z = \"0 m\", heading = \"0 deg\"";
    for (station, told) in [
        ("S0 = { levelled = \"-5 arcsec\" }".to_owned(), "the standard uncertainty of a level is positive"),
        ("S0 = { levelled = \"5 arcsec\", pitch = \"0 deg\" }".to_owned(), "a levelled station is upright"),
        (format!("S0 = {{ {exact}, levelled = \"5 arcsec\" }}"), "no place or heading is known"),
        (format!("\"*\" = {{ {exact}, rough = true }}"), "only that they were levelled can be stated"),
        ("S9 = { levelled = \"5 arcsec\" }".to_owned(), "no row has to do with `S9`"),
    ] {
        folder.write("study.toml", format!("{STUDY}[stations]\n{station}\n"));
        let run = run_in(&folder.0, &["identify", "study.toml"], "");
        assert!(run.code == 2 && run.stderr.contains(told), "{station}: {run}");
    }
}
