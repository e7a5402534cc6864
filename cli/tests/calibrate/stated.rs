//! What a study states of places, against what its rows say: a tracker's control points, and a rough pose that is none.
//!
//! The tracker is without errors but for a scale of its ranges, so that what it reads of a point has a closed form.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::figures::{calibrated, cautions, error, first_effect, holds, number};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::{Folder, run_in};
use testkit::Random;

const CONTROLS: usize = 8;
const LONGER: f64 = 1e-4;
const STATED_M: f64 = 1e-3;

/// The first targets as somebody else measured them; `blunder` is added to the first of all.
fn controls(room: &Room, random: &mut Random, blunder: f64) -> String {
    let mut text = String::from("[objects]\n");
    for (number, place) in room.targets.iter().enumerate().take(CONTROLS) {
        let [x, y, z] = place.map(|value| value + STATED_M * random.normal());
        let x = if number == 0 { x + blunder } else { x };
        writeln!(text, "T{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", sigma = \"1 mm\" }}")
            .expect("a string");
    }
    text
}

/// A millimetre over eight points in a room tells a scale to some 60 ppm, however well the tracker reads.
#[test]
fn a_scale_is_no_surer_than_the_control_points_that_hold_it() {
    let folder = Folder::new("stated-controls");
    folder.write("tracker.chain", TRACKER);
    let mut squares = 0.0;
    for seed in 1..=8 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let study = format!("{STUDY}{}", controls(&room, random, 0.0));
        folder.write("rows.csv", room.rows(random, LONGER)).write("study.toml", study);
        let report = calibrated(&folder, "study.toml");
        let [value, sigma] = error(&report, "longer");
        let pull = (value - LONGER) / sigma;
        assert!(pull.abs() < 4.0 && (30e-6..120e-6).contains(&sigma), "{seed}: {value} ± {sigma}");
        assert!(!report["cautions"].to_string().contains("not where it is stated"), "{seed}");
        squares += pull * pull;
    }
    // Chance keeps the sum of eight squares between these but once in a thousand times.
    assert!((0.6..28.0).contains(&squares), "{squares}");
}

/// Points that are stated to a millimetre show a scale that nobody declared, and what it would have taken with it.
#[test]
fn stated_points_show_a_scale_that_nobody_declared() {
    let folder = Folder::new("stated-scale");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    for (seed, longer) in [(31, 1e-3), (32, -5e-4), (33, 0.0)] {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let study = format!("{STUDY}{}", controls(&room, random, 0.0));
        folder.write("rows.csv", room.rows(random, longer)).write("study.toml", study);
        let report = calibrated(&folder, "study.toml");
        if longer == 0.0 {
            assert_eq!(report["effects"], serde_json::json!([]));
        } else {
            assert!(first_effect(&report).contains("range scale"), "{}", report["effects"]);
            holds(&report, &[("range_scale", longer)]);
        }
        holds(&report, &[("range_zero", 0.0)]);
    }
}

/// A point that is elsewhere altogether is no scale of the ranges.
#[test]
fn a_blunder_among_stated_points_is_no_scale() {
    let folder = Folder::new("stated-scale-blunder");
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", ""));
    let random = &mut Random::new(34);
    let room = Room::new(random);
    let study = format!("{STUDY}{}", controls(&room, random, 0.08));
    folder.write("rows.csv", room.rows(random, 0.0)).write("study.toml", study);
    let report = calibrated(&folder, "study.toml");
    assert_eq!(report["effects"], serde_json::json!([]));
    let named = cautions(&report, "not where it is stated");
    assert!(named.len() == 1 && named[0]["label"] == "T0", "{}", report["cautions"]);
}

/// Stations with their uncertainty, the first so far off along x.
fn stations(room: &Room, random: &mut Random, off_m: f64) -> String {
    let mut text = String::from("[stations]\n");
    for (number, (place, heading)) in room.stations.iter().enumerate() {
        let [x, y, z] = place.map(|value| value + STATED_M * random.normal());
        let x = if number == 0 { x + off_m } else { x };
        let place = format!("x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\"");
        writeln!(text, "S{number} = {{ {place}, sigma = \"1 mm\" }}").expect("a string");
    }
    text
}

/// A scale that only stated stations show is found, and one that is not there is not.
#[test]
fn stated_stations_show_a_scale_that_nobody_declared() {
    let folder = Folder::new("stated-scale-stations");
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", ""));
    for (seed, longer) in [(41, 3e-3), (42, -3e-3), (43, 0.0)] {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let study = format!("{STUDY}{}", stations(&room, random, 0.0));
        folder.write("rows.csv", room.rows(random, longer)).write("study.toml", study);
        let report = calibrated(&folder, "study.toml");
        if longer == 0.0 {
            assert_eq!(report["effects"], serde_json::json!([]));
        } else {
            assert!(first_effect(&report).contains("range scale"), "{}", report["effects"]);
            holds(&report, &[("range_scale", longer)]);
        }
        assert!(cautions(&report, "not where it is stated").is_empty(), "{}", report["cautions"]);
    }
}

/// Residuals in metres are smaller in a smaller room. Where many rows read roughly, and places tell a scale no better than to some
/// hundred ppm, that is no reason to make it smaller: the scale would come out by the number of components times its variance too small.
#[test]
fn many_rough_rows_do_not_shrink_the_room() {
    let folder = Folder::new("stated-many");
    folder.write("tracker.chain", TRACKER);
    let (mut pulls, mut by_size) = (0.0, 0.0);
    for seed in 51..=54 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let mut rows = room.rows(random, LONGER);
        for _ in 1..40 {
            let more = room.rows(random, LONGER);
            rows.push_str(more.split_once('\n').expect("a heading").1);
        }
        let study = format!("{STUDY}{}", stations(&room, random, 0.0)).replace("\"1 mm\"", "\"3 mm\"");
        folder.write("rows.csv", rows).write("study.toml", study);
        let report = calibrated(&folder, "study.toml");
        let [value, sigma] = error(&report, "longer");
        pulls += (value - LONGER) / sigma;
        by_size += 3.0 * f64::from(40 * 180) * sigma;
    }
    // Each is off by chance alone; else they would be by as many of their ± as there are components, times it.
    assert!(pulls.abs() < 4.0 * 2.0 && by_size > 16.0, "{pulls} of {by_size}");
}

/// Two places tell one distance: whether it is too long or one of them is wrong, no row says.
#[test]
fn a_scale_that_one_distance_shows_is_told_beside_the_places() {
    let folder = Folder::new("stated-scale-distance");
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", ""));
    let random = &mut Random::new(45);
    let room = Room::new(random);
    let two: String = stations(&room, random, 0.0).lines().take(3).map(|line| format!("{line}\n")).collect();
    folder.write("rows.csv", room.rows(random, 5e-3)).write("study.toml", format!("{STUDY}{two}"));
    let report = calibrated(&folder, "study.toml");
    assert_eq!(report["effects"], serde_json::json!([]));
    assert_eq!(cautions(&report, "not where it is stated").len(), 2, "{}", report["cautions"]);
    let own = cautions(&report, "a scale, or stations stated wrongly");
    let [scale, uncertainty] = ["scale", "uncertainty"].map(|name| number(&own[0][name]));
    assert!((scale - 5e-3).abs() < 4.0 * uncertainty, "{scale} ± {uncertainty}");
    let told = run_in(&folder.0, &["calibrate", "study.toml"], "").stdout;
    assert!(told.contains("Ty(range_scale*range)") && told.contains("Do not correct with it yet"), "{told}");
}

/// A station that is stated wrongly is no scale.
#[test]
fn a_station_that_is_stated_wrongly_is_no_scale() {
    let folder = Folder::new("stated-station-blunder");
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", ""));
    let random = &mut Random::new(44);
    let room = Room::new(random);
    let study = format!("{STUDY}{}", stations(&room, random, 0.2));
    folder.write("rows.csv", room.rows(random, 0.0)).write("study.toml", study);
    let report = calibrated(&folder, "study.toml");
    assert!(!cautions(&report, "not where it is stated").is_empty(), "{}", report["cautions"]);
    assert_eq!(report["effects"], serde_json::json!([]));
    assert!(cautions(&report, "a scale, or stations stated wrongly").is_empty());
}

#[test]
fn a_control_point_that_is_stated_wrongly_is_named() {
    let folder = Folder::new("stated-blunder");
    let random = &mut Random::new(20);
    let room = Room::new(random);
    let study = format!("{STUDY}{}", controls(&room, random, 0.05));
    folder
        .write("tracker.chain", TRACKER)
        .write("rows.csv", room.rows(random, LONGER))
        .write("study.toml", study);
    let report = calibrated(&folder, "study.toml");
    let named = cautions(&report, "not where it is stated");
    assert_eq!(named.len(), 1, "{}", report["cautions"]);
    assert_eq!(named[0]["label"], "T0");
    assert!((0.02..0.06).contains(&named[0]["away_m"].as_f64().expect("a number")), "{named:?}");
}

/// A heading half a turn off, and a place 40 m away: targets that stations share say where they stood.
#[test]
fn a_rough_pose_that_is_far_off_changes_no_error() {
    let folder = Folder::new("stated-rough");
    let random = &mut Random::new(40);
    let room = Room::new(random);
    folder.write("tracker.chain", TRACKER).write("rows.csv", room.rows(random, LONGER));
    let of = |poses: &str| {
        folder.write("study.toml", format!("{STUDY}[fit]\nfix = {{ longer = 0 }}\n{poses}"));
        let report = calibrated(&folder, "study.toml");
        ["trunnion", "index", "beam_aside", "collimation"].map(|name| error(&report, name))
    };
    let without = of("");
    let [first, second, third] = room.stations.map(|(place, heading)| {
        move |more: f64, away: f64| {
            let [x, y, z] = place;
            // The chain turns against its azimuth.
            format!(
                "{{ x = \"{} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{} rad\", rough = true }}\n",
                x + away,
                heading + more
            )
        }
    });
    for (more, away) in [(0.0, 0.0), (PI, 0.0), (0.0, 40.0)] {
        let poses = format!(
            "[stations]\nS0 = {}S1 = {}S2 = {}",
            first(0.0, 0.0),
            second(more, away),
            third(0.0, 0.0)
        );
        for ([value, sigma], [other, _]) in without.into_iter().zip(of(&poses)) {
            assert!((value - other).abs() < 1e-2 * sigma, "{more}, {away}: {value} and {other} ± {sigma}");
        }
    }
}

/// A point of which the study is sure, 8 cm off, and a station whose heading is: all rows are set aside, and say together what is wrong.
#[test]
fn an_exact_place_that_is_wrong_is_told_by_its_rows() {
    let folder = Folder::new("stated-exact");
    folder.write("tracker.chain", TRACKER);
    let random = &mut Random::new(7);
    let room = Room::new(random);
    folder.write("rows.csv", room.rows(random, LONGER));
    let mut points = String::from("[objects]\n");
    for (number, [x, y, z]) in room.targets.iter().enumerate().take(CONTROLS) {
        let x = if number == 0 { x + 0.08 } else { *x };
        writeln!(points, "T{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\" }}").expect("a string");
    }
    let mut stations = String::from("[stations]\n");
    for (number, ([x, y, z], heading)) in room.stations.iter().enumerate() {
        let heading = if number == 2 { heading + 0.02 } else { *heading };
        let pose = format!("x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\"");
        writeln!(stations, "S{number} = {{ {pose} }}").expect("a string");
    }
    for (study, what, label, shift, turn) in
        [(points, "point", "T0", -0.08, 0.0), (stations, "station", "S2", 0.0, 0.02)]
    {
        folder.write("study.toml", format!("{STUDY}{study}"));
        let report = calibrated(&folder, "study.toml");
        let named = cautions(&report, "not where it is stated");
        assert_eq!(named.len(), 1, "{}", report["cautions"]);
        assert_eq!((&named[0]["what"], &named[0]["label"]), (&what.into(), &label.into()));
        assert!((number(&named[0]["shift_m"][0]) - shift).abs() < 0.005, "{named:?}");
        assert!((number(&named[0]["turn_rad"]) - turn).abs() < 1e-3, "{named:?}");
        for kind in ["rows scatter more", "rows set aside share something"] {
            assert!(cautions(&report, kind).is_empty(), "{}", report["cautions"]);
        }
        let told = run_in(&folder.0, &["calibrate", "study.toml"], "").stdout;
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(told.contains("by all of its rows") && told.contains("Do not correct with it yet"), "{told}");
    }
}
