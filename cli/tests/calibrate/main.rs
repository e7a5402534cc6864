//! The whole loop, as a user runs it.

#[path = "../support/mod.rs"]
mod support;

mod at_zero;
mod bad_studies;
mod bar;
mod by_cause;
mod cameras;
mod circles;
mod drift;
mod drive;
mod few;
mod few_exact;
mod figures;
mod frames;
mod frozen;
mod instruments;
mod ladder;
mod levelled;
mod many;
mod misread;
mod moved;
mod near;
mod noiseless;
mod objects;
mod observations;
mod orientations;
mod outage;
mod pixels;
mod placed;
mod ranges;
mod readings;
mod reference;
mod repeats;
mod room;
mod scatter;
mod sockets;
mod stated;
mod still;
mod survey;
mod together;
mod unexpected;
mod unheld;
mod unusable;
mod weighed;

use serde_json::Value;
use support::{Folder, trueaxis};

const STUDY: &str = "examples/mobile-lidar/study.toml";

/// The example, calibrated into a folder of the test's own.
fn calibrated(name: &str) -> (Folder, Value) {
    let folder = Folder::new(name);
    let out = folder.0.to_str().expect("UTF-8");
    let run = trueaxis(&["calibrate", STUDY, "--out", out]);
    assert_eq!(run.code, 0, "{run}");
    let report = serde_json::from_str(&folder.read("report.json")).expect("JSON");
    (folder, report)
}

#[test]
fn the_loop_closes_on_the_mobile_lidar() {
    let (folder, report) = calibrated("loop");
    assert_eq!(
        folder.names(),
        ["amended.chain", "errors.toml", "instrument.toml", "report.html", "report.json", "residuals.csv"]
    );

    // The encoder of the middle axis is off centre: a rotation of the middle body about x.
    let effects = report["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{effects:#?}");
    assert_eq!(effects[0]["body"], "middle");
    assert_eq!(effects[0]["dof"], "Rx");
    let called: Vec<&Value> = ["names", "confounded_with"]
        .into_iter()
        .flat_map(|key| effects[0][key].as_array().expect("a list"))
        .collect();
    assert!(called.iter().any(|name| *name == "encoder eccentricity of beta"), "{called:?}");
    assert!(effects[0]["p_value"].as_f64().expect("a number") <= 0.001);

    // The noise is 2 arcsec along each of two directions: 2.83 arcsec in length.
    let arcsec = |value: &Value| value.as_f64().expect("a number") * 648_000.0 / std::f64::consts::PI;
    assert!(arcsec(&report["before"]["rms"]) > 7.0, "the effect is seen before");
    for rms in ["rms", "held_out_rms"] {
        let after = arcsec(&report["after"][rms]);
        assert!((2.6..3.1).contains(&after), "{rms} after: {after}");
    }
}

#[test]
fn the_amended_declaration_reads_derives_and_has_nothing_more_to_find() {
    let (folder, report) = calibrated("amended");
    folder.copy("examples/mobile-lidar/measured.csv").copy(STUDY);
    let study = folder.read("study.toml").replace("mobile-lidar.chain", "amended.chain");
    folder.write("study.toml", study);
    let derived = folder.trueaxis(&["derive", "amended.chain", "--observable", "pointing"]);
    assert_eq!(derived.code, 0, "{derived}");
    for coefficient in report["effects"][0]["coefficients"].as_object().expect("a table").keys() {
        assert!(derived.stdout.contains(coefficient), "{coefficient} is in the closed form");
    }
    let again = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    assert_eq!(again.code, 0, "{again}");
    let again: Value = serde_json::from_str(&again.stdout).expect("JSON");
    assert_eq!(again["effects"], Value::Array(Vec::new()), "nothing more is found");
}

#[test]
fn the_errors_written_correct_the_measured_data() {
    let (folder, _) = calibrated("corrected");
    folder.copy("examples/mobile-lidar/measured.csv");
    let arguments = [
        "apply",
        "amended.chain",
        "--errors",
        "errors.toml",
        "--data",
        "measured.csv",
        "--observable",
        "pointing",
        "--out",
        "corrected.csv",
    ];
    let run = folder.trueaxis(&arguments);
    assert_eq!(run.code, 0, "{run}");
    let directions = |table: String| -> Vec<f64> {
        let rows = table.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
        rows.iter()
            .flat_map(|row| {
                row.split(',').skip(5).map(|cell| cell.parse().expect("a number")).collect::<Vec<f64>>()
            })
            .collect()
    };
    let (corrected, measured) =
        (directions(folder.read("corrected.csv")), directions(folder.read("measured.csv")));
    let squares: f64 = corrected.iter().zip(&measured).map(|(a, b)| (a - b).powi(2)).sum();
    let rms_arcsec = (squares / 400.0).sqrt() * 648_000.0 / std::f64::consts::PI;
    assert!((2.6..3.1).contains(&rms_arcsec), "what is left is the noise: {rms_arcsec}");
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let (folder, _) = calibrated("page");
    let page = folder.read("report.html");
    let addresses = page.matches("http").count();
    assert_eq!(
        addresses,
        page.matches("http://www.w3.org/2000/svg").count(),
        "no address but the name of SVG"
    );
    assert!(!page.contains(" src=") && !page.contains("<link"), "no script, no style from elsewhere");
    assert!(page.matches("<svg").count() >= 6, "residuals over every joint");
}

#[test]
fn a_dry_run_shows_the_difference_and_writes_nothing() {
    let folder = Folder::new("dry-run");
    for file in ["mobile-lidar.chain", "measured.csv", "study.toml"] {
        folder.copy(&format!("examples/mobile-lidar/{file}"));
    }
    let before = folder.names();
    let run = folder.trueaxis(&["calibrate", "study.toml", "--dry-run"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("--- mobile-lidar.chain\n+++ mobile-lidar.chain (amended)\n@@"), "{run}");
    let removed = run.stdout.lines().skip(2).filter(|line| line.starts_with('-')).count();
    assert_eq!(removed, 0, "lines are added, none is taken away");
    assert_eq!(folder.names(), before);
}

#[test]
fn the_independent_simulators_still_write_the_data() {
    let Some(python) = testkit::tool(testkit::PYTHON) else { return };
    for (example, files) in [
        ("mobile-lidar", &["measured.csv", "second-run.csv"][..]),
        ("turntable", &["measured.csv"][..]),
        ("probed-arm", &["poses.csv"][..]),
        ("course", &["secret.csv", "secret-2.csv", "secret-3.csv", "secret-4.csv"][..]),
    ] {
        let folder = Folder::new(&format!("simulator-{example}"));
        folder.copy(&format!("examples/{example}/simulate.py"));
        let written = std::process::Command::new(&python).arg("simulate.py").current_dir(&folder.0).status();
        assert!(written.expect("python3 runs").success());
        for file in files {
            let kept = std::fs::read_to_string(support::root().join("examples").join(example).join(file));
            assert_eq!(folder.read(file), kept.expect("the example's data"), "{file}");
        }
    }
}
