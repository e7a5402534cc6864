//! Studies whose data or places are read as they were not meant: the mistake is named, or the row refused.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

use serde_json::Value;

use crate::figures::{calibrated, cautions};
use crate::room::{Point, Room, STUDY, TRACKER};
use crate::support::{Folder, run_in};
use testkit::Random;

/// A room's rows with other numbers, and the first targets as a study has them.
fn study(name: &str, change: impl Fn([f64; 3]) -> [f64; 3], place: impl Fn(Point) -> Point) -> Folder {
    let targets = |room: &Room| {
        let mut text = String::from("[objects]\n");
        for (number, target) in room.targets.iter().enumerate().take(8) {
            let [x, y, z] = place(*target);
            writeln!(text, "T{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\" }}")
                .expect("a string");
        }
        text
    };
    study_with(name, |_, row| change(row), targets)
}

/// The same where what is known of places is this; numbers may be changed by station.
fn study_with(
    name: &str,
    change: impl Fn(&str, [f64; 3]) -> [f64; 3],
    known: impl Fn(&Room) -> String,
) -> Folder {
    let folder = Folder::new(name);
    let random = &mut Random::new(11);
    let room = Room::new(random);
    let text = room.rows(random, 0.0);
    let mut rows = String::new();
    for (at, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[2..].iter().filter_map(|cell| cell.parse().ok()).collect();
        if at == 0 {
            writeln!(rows, "{line}").expect("a string");
        } else {
            let [azimuth, elevation, range] = change(cells[0], [numbers[0], numbers[1], numbers[2]]);
            writeln!(rows, "{},{},{azimuth:.9},{elevation:.9},{range:.7}", cells[0], cells[1])
                .expect("a string");
        }
    }
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", ""));
    folder.write("rows.csv", rows).write("study.toml", format!("{STUDY}{}", known(&room)));
    folder
}

/// What the report says is misread: nothing else is told beside it.
fn named(folder: &Folder) -> Vec<Value> {
    let run = run_in(&folder.0, &["calibrate", "study.toml", "--format", "json"], "");
    assert_eq!(run.code, 1, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let own = cautions(&report, "column misread");
    assert_eq!(
        (own.len(), report["cautions"].as_array().map(Vec::len)),
        (1, Some(1)),
        "{}",
        report["cautions"]
    );
    let told = run_in(&folder.0, &["calibrate", "study.toml"], "").stdout;
    assert!(told.starts_with("A COLUMN IS MISREAD") && told.contains("calibrate again"), "{told}");
    let readings = own[0]["readings"].as_array().expect("a list").iter();
    readings.map(|one| one["reading"].clone()).collect()
}

#[test]
fn coordinates_that_are_exchanged_are_named() {
    let found = named(&study("misread-xy", |row| row, |[x, y, z]| [y, x, z]));
    // Or the instrument sees the room in a mirror.
    assert!(found.contains(&serde_json::json!({ "what": "places_exchanged", "of": "objects" })), "{found:?}");
}

#[test]
fn zenith_distances_and_gon_are_named() {
    let zenith = study(
        "misread-zenith",
        |[azimuth, elevation, range]| [azimuth, FRAC_PI_2 - elevation, range],
        |place| place,
    );
    let found = named(&zenith);
    assert_eq!(found[0], serde_json::json!({ "what": "from_zenith", "column": "elevation" }), "{found:?}");
    let in_gon = |angle: f64| angle.to_degrees() / 0.9;
    let gon = study("misread-gon", |[a, e, range]| [in_gon(a), in_gon(e), range], |place| place);
    let degrees = ["azimuth", "elevation"]
        .map(|joint| format!("{joint} = {{ column = \"{joint}\", unit = \"deg\" }}\n"));
    gon.write("rows.csv", gon.read("rows.csv").replace(" [rad]", ""))
        .write("study.toml", format!("{}[columns]\n{}", gon.read("study.toml"), degrees.concat()));
    let found = named(&gon);
    assert_eq!(found[0]["is"], "gon", "{found:?}");
    assert_eq!(found[0]["columns"].as_array().map(Vec::len), Some(2), "{found:?}");
}

#[test]
fn feet_are_named_where_places_say_the_scale() {
    let found = named(&study("misread-feet", |[a, e, range]| [a, e, range / 0.3048], |place| place));
    // Or the places are too large by as much.
    assert!(found.iter().any(|one| one["what"] == "unit" && one["is"] == "ft"), "{found:?}");
}

#[test]
fn columns_that_are_exchanged_are_named_where_nothing_is_known() {
    for exchanged in [true, false] {
        let change = |_: &str, [azimuth, elevation, range]: [f64; 3]| match exchanged {
            true => [elevation, azimuth, range],
            false => [azimuth.to_degrees(), elevation.to_degrees(), range],
        };
        let found = named(&study_with("misread-unknown", change, |_| String::new()));
        assert_eq!(found[0]["what"], if exchanged { "exchanged" } else { "unit" }, "{found:?}");
    }
}

#[test]
fn degrees_of_one_station_are_named() {
    let change = |station: &str, [azimuth, elevation, range]: [f64; 3]| match station {
        "S1" => [azimuth.to_degrees(), elevation.to_degrees(), range],
        _ => [azimuth, elevation, range],
    };
    let found = named(&study_with("misread-station", change, |_| String::new()));
    assert_eq!((&found[0]["what"], &found[0]["station"]), (&"of_station".into(), &"S1".into()), "{found:?}");
    assert_eq!(found[0]["reading"]["is"], "deg", "{found:?}");
}

#[test]
fn a_room_in_a_mirror_is_told_by_rough_stations() {
    let rough = |room: &Room| {
        let mut text = String::from("[stations]\n");
        for (number, ([x, y, z], heading)) in room.stations.iter().enumerate() {
            let (x, y, heading) = (x + 0.2, y - 0.1 * number as f64, heading + 0.05);
            writeln!(
                    text,
                    "S{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\", rough = true }}"
                )
                .expect("a string");
        }
        text
    };
    let reversed = study_with("misread-mirror", |_, [a, e, r]| [-a, e, r], rough);
    let found = named(&reversed);
    let reversed = serde_json::json!({ "what": "reversed", "column": "azimuth" });
    assert!(found.contains(&reversed), "{found:?}");
    let fine = study_with("misread-rough", |_, row| row, rough);
    let report = calibrated(&fine, "study.toml");
    assert!(report["cautions"].as_array().is_some_and(Vec::is_empty), "{}", report["cautions"]);
}

#[test]
fn negative_ranges_are_refused_with_their_line() {
    for (sign, all) in
        [(|azimuth: f64| if azimuth > 0.98 * PI { -1.0 } else { 1.0 }, false), (|_: f64| -1.0, true)]
            as [(fn(f64) -> f64, bool); 2]
    {
        let folder = study("misread-negative", |[a, e, range]| [a, e, sign(a) * range], |place| place);
        let run = run_in(&folder.0, &["calibrate", "study.toml"], "");
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains("a range is not negative"), "{run}");
        assert!(
            !all || run.stderr.contains("line 2, row 1") && run.stderr.contains("(180 of 180 rows are)"),
            "{run}"
        );
    }
}
