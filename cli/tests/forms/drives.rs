//! Scanners on vehicles: a trajectory as SBET and points by time, from `init` to boresight, lever arm and a corrected trajectory.
//!
//! `examples/trajectory/simulate.py` wrote the files from the public description of SBET and of WGS 84.

use crate::support::{Folder, Run};

/// Bytes of a record, and of a number.
const RECORD: usize = 136;
const NUMBER: usize = 8;

/// What was planted: forward, right, down, m; roll, pitch, heading, degrees.
const STREET: [(&str, f64); 6] = [
    ("lever_forward", -0.62),
    ("lever_right", 0.17),
    ("lever_down", -0.95),
    ("boresight_heading", 0.35),
    ("boresight_pitch", -0.22),
    ("boresight_roll", 0.41),
];
const FLIGHT: [(&str, f64); 6] = [
    ("lever_forward", 0.35),
    ("lever_right", -0.12),
    ("lever_down", 0.41),
    ("boresight_heading", -0.3),
    ("boresight_pitch", 0.15),
    ("boresight_roll", 0.25),
];

/// A folder with a table of points and its trajectory.
fn folder(test: &str, name: &str) -> Folder {
    let folder = Folder::new(&format!("drives-{test}"));
    for ending in ["csv", "sbet"] {
        folder.copy(&format!("examples/trajectory/{name}.{ending}"));
    }
    folder
}

fn told(folder: &Folder, arguments: &[&str]) -> Run {
    let run = folder.trueaxis(arguments);
    assert_eq!(run.code, 0, "{run}");
    run
}

/// Errors and their standard uncertainties of a report, rad and m.
fn errors(folder: &Folder) -> Vec<(String, f64, f64)> {
    let report: serde_json::Value =
        serde_json::from_str(&folder.read("result/report.json")).expect("a report is JSON");
    let number = |own: &serde_json::Value| own.as_f64().unwrap_or(f64::NAN);
    let errors = report["errors"].as_array().expect("a report has errors");
    errors
        .iter()
        .map(|own| {
            let name = own["name"].as_str().expect("an error has a name").to_owned();
            (name, number(&own["value"]), number(&own["standard_uncertainty"]))
        })
        .collect()
}

/// From a table of points and a trajectory to the errors that were planted.
fn recovered(name: &str, planted: &[(&str, f64); 6], says: &[&str]) -> Folder {
    let files = [format!("{name}.csv"), format!("{name}.sbet")];
    let folder = folder(name, name);
    let init = told(&folder, &["init", &files[0], &files[1], "--out", "study.toml"]);
    for says in says {
        assert!(init.stderr.contains(says), "{says}: {init}");
    }
    told(&folder, &["calibrate", "study.toml", "--out", "result"]);
    let found = errors(&folder);
    for (error, truth) in planted {
        let (_, estimate, sigma) = found.iter().find(|(own, ..)| own == error).expect("it was estimated");
        let truth = if error.starts_with("boresight") { truth.to_radians() } else { *truth };
        assert!(
            (estimate - truth).abs() < 3.5 * sigma,
            "{name}: {error}: {estimate} ± {sigma}, planted {truth}"
        );
        // Level roads and roofs show the height of a scanner where its vehicle tilts.
        let most = if *error == "lever_down" { 0.1 } else { 0.02 };
        assert!(*sigma < most, "{name}: {error}: ± {sigma}");
    }
    folder
}

#[test]
fn boresight_and_lever_arm_come_out_of_a_drive_and_of_a_flight() {
    recovered("flight", &FLIGHT, &[]);
    let folder = recovered("street", &STREET, &["standard GPS time"]);
    told(&folder, &["apply", "result/instrument.toml", "--data", "street.csv", "--out", "corrected.csv"]);
    let corrected = folder.read("corrected.csv");
    let rows = |column| crate::column(&corrected, column);
    // The road is level, whatever the vehicle did.
    let walls: Vec<&str> = corrected.lines().skip(1).filter_map(|line| line.split(',').nth(1)).collect();
    let road: Vec<f64> =
        rows("hit_z").into_iter().zip(&walls).filter(|(_, wall)| **wall == "road").map(|(z, _)| z).collect();
    let mean = road.iter().sum::<f64>() / road.len() as f64;
    let off = crate::rms(road.iter().map(|z| z - mean));
    assert!(off < 0.008, "{off} m");
    trajectory_is_corrected(&folder);
}

/// The numbers of a file of records.
fn numbers(folder: &Folder, file: &str) -> Vec<f64> {
    let bytes = std::fs::read(folder.0.join(file)).expect("a trajectory");
    bytes.chunks_exact(NUMBER).map(|own| f64::from_le_bytes(own.try_into().expect("8 bytes"))).collect()
}

/// The corrected trajectory is that of the scanner, and every other number stays.
fn trajectory_is_corrected(folder: &Folder) {
    let run = told(
        folder,
        &["apply", "result/instrument.toml", "--data", "street.sbet", "--out", "corrected.sbet"],
    );
    assert!(run.stdout.starts_with("2001 records."), "{run}");
    assert!(run.stdout.contains("differs from the corrected trajectory by 0.000 mm and 0.000″"), "{run}");
    let found = errors(folder);
    let value = |name: &str| found.iter().find(|(own, ..)| own == name).expect("it was estimated").1;
    let lever = ["lever_forward", "lever_right", "lever_down"].map(value);
    let [given, corrected] = ["street.sbet", "corrected.sbet"].map(|file| numbers(folder, file));
    assert_eq!(given.len(), corrected.len());
    for (before, after) in given.chunks_exact(17).zip(corrected.chunks_exact(17)) {
        for at in [0, 4, 5, 6, 10, 11, 12, 13, 14, 15, 16] {
            assert_eq!(before[at].to_bits(), after[at].to_bits(), "number {at}");
        }
        // North, east and down by the radii of curvature of WGS 84 at 48.2083° N, 190 m.
        let moved = [
            (after[1] - before[1]) * 6_371_170.0,
            (after[2] - before[2]) * 6_390_242.0 * before[1].cos(),
            before[3] - after[3],
        ];
        let [roll, pitch, heading] = [before[7], before[8], before[9] - before[10]];
        let [(sr, cr), (sp, cp), (sh, ch)] = [roll, pitch, heading].map(f64::sin_cos);
        let [f, r, d] = lever;
        let expected = [
            ch * cp * f + (ch * sp * sr - sh * cr) * r + (ch * sp * cr + sh * sr) * d,
            sh * cp * f + (sh * sp * sr + ch * cr) * r + (sh * sp * cr - ch * sr) * d,
            -sp * f + cp * sr * r + cp * cr * d,
        ];
        for (moved, expected) in moved.iter().zip(expected) {
            assert!((moved - expected).abs() < 1e-4, "{moved} m, by the lever arm {expected} m");
        }
    }
    // Points by the corrected trajectory and the mounting without errors are the calibrated ones.
    assert!(run.stdout.contains("the nominal mounting with the corrected trajectory differs"), "{run}");
}

#[test]
fn what_is_wrong_with_a_trajectory_is_said_with_the_record_or_the_row() {
    let folder = folder("wrong", "street");
    told(&folder, &["init", "street.csv", "street.sbet"]);
    let study = folder.read("street.toml");
    let bytes = std::fs::read(folder.0.join("street.sbet")).expect("a trajectory");
    let refused = |name: &str, study: &str, words: &[&str]| {
        folder.write("own.toml", study);
        let run = folder.trueaxis(&["calibrate", "own.toml"]);
        assert_eq!(run.code, 2, "{name}: {run}");
        let said = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in words {
            assert!(said.contains(word), "{name}: {word}: {said}");
        }
    };
    let spoiled = |name: &str, bytes: &[u8], words: &[&str]| {
        folder.write("own.sbet", bytes);
        refused(name, &study.replace("\"street.sbet\"", "\"own.sbet\""), words);
    };
    spoiled(
        "cut off",
        &bytes[..10 * RECORD + 77],
        &["own.sbet: record 11: it has 77 of 136 bytes", "copy it again"],
    );
    spoiled("empty", b"", &["record 1: it has 0 of 136 bytes"]);
    let twice = [&bytes[..5 * RECORD], &bytes[3 * RECORD..]].concat();
    spoiled(
        "goes back",
        &twice,
        &["own.sbet: record 6: its time", "is not later than", "take the records from there on out"],
    );
    let mut degrees = bytes.clone();
    degrees[7 * RECORD + NUMBER..][..NUMBER].copy_from_slice(&48.2_f64.to_le_bytes());
    spoiled("degrees", &degrees, &["record 8: its latitude is 48.2", "export the trajectory in radians"]);
    spoiled(
        "half",
        &bytes[..1000 * RECORD],
        &["street.csv:", "its time", "rows are outside", "Leave these rows out"],
    );
    let gap = [&bytes[..400 * RECORD], &bytes[440 * RECORD..]].concat();
    spoiled("gap", &gap, &["is in a gap of own.sbet", "of 900 rows", "write gap = \"1.02"]);
    let line = study.lines().find(|line| line.starts_with("offset")).expect("times are counted otherwise");
    refused(
        "weeks",
        &study.replace(line, ""),
        &[
            "street.csv: line 2, row 1: its time 400421600.",
            "900 of 900 rows are outside",
            "write offset = \"-400112000 s\"",
        ],
    );
    refused(
        "no column",
        &study.replace("\"gps_time [s]\"", "\"gps\""),
        &["no column `gps`", "`gps_time [s]`"],
    );
    refused("a key", &study.replace("offset =", "ofset ="), &["ofset"]);
}
