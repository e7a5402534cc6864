//! `trueaxis init`: what it makes of a table runs, and finds what an independent simulator planted.

#[path = "../support/mod.rs"]
mod support;

mod hostile;
mod measured;
mod otherwise;
mod targets;

use std::collections::BTreeMap;
use std::process::Command;

use serde_json::Value;
use support::{Folder, Run, root};

/// `init` and `calibrate` in a folder; what each said.
fn begun(folder: &Folder, data: &str) -> [Run; 2] {
    let study = format!("{}.toml", data.trim_end_matches(".csv"));
    let init = folder.trueaxis(&["init", data]);
    assert_eq!(init.code, 0, "{data}: {init}");
    [init, folder.trueaxis(&["calibrate", &study, "--format", "json"])]
}

/// Values and standard uncertainties of the errors that a report holds for determined.
fn determined(report: &Value) -> BTreeMap<String, (f64, f64)> {
    let errors = report["errors"].as_array().expect("errors");
    errors
        .iter()
        .filter(|error| error["separable"] == true && error["shown"] != false)
        .map(|error| {
            let number = |key: &str| error[key].as_f64().expect("a number");
            (
                error["name"].as_str().expect("a name").to_owned(),
                (number("value"), number("standard_uncertainty")),
            )
        })
        .collect()
}

/// Standard uncertainties that an estimate may be off.
const WITHIN: f64 = 5.0;

#[test]
fn what_was_planted_in_an_instrument_of_each_kind_is_found() {
    let Some(python) = testkit::tool(testkit::PYTHON) else { return };
    // How many of the planted errors such data determine by themselves, at least.
    for (kind, least) in [
        ("alt-azimuth", 7),
        ("equatorial", 6),
        ("gimbal", 6),
        ("scanner", 8),
        ("total-station", 5),
        ("turntable", 4),
        ("encoder", 1),
        ("arm", 12),
    ] {
        let folder = Folder::new(&format!("init-{kind}"));
        let script = root().join("cli/tests/init/simulate.py");
        let written = Command::new(&python).arg(script).arg(kind).current_dir(&folder.0).output();
        let written = written.expect("python3 runs");
        assert!(written.status.success(), "{}", String::from_utf8_lossy(&written.stderr));
        let planted = String::from_utf8(written.stdout).expect("UTF-8");
        let [init, calibrate] = begun(&folder, &format!("{kind}.csv"));
        assert!(init.stdout.starts_with(kind), "{init}");
        assert_eq!(calibrate.code, 0, "{kind}: {calibrate}");
        let report: Value = serde_json::from_str(&calibrate.stdout).expect("JSON");
        let found = determined(&report);
        let mut compared = 0;
        for line in planted.lines() {
            let (name, value) = line.split_once(' ').expect("a name and a value");
            let planted: f64 = value.parse().expect("a number");
            let Some((value, sigma)) = found.get(name) else { continue };
            assert!(
                (value - planted).abs() < WITHIN * sigma,
                "{kind}, {name}: {value} ± {sigma}, planted {planted}"
            );
            compared += 1;
        }
        assert!(compared >= least, "{kind}: {compared} of the planted errors are determined: {found:?}");
    }
}

#[test]
fn the_templates_are_listed() {
    let folder = Folder::new("init-list");
    let run = folder.trueaxis(&["init", "--list"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for name in [
        "alt-azimuth",
        "equatorial",
        "scanner",
        "total-station",
        "gimbal",
        "turntable",
        "arm",
        "encoder",
        "machine",
        "ball-bar",
        "r-test",
        "vehicle",
    ] {
        assert!(run.stdout.contains(name), "{run}");
    }
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 100), "{run}");
}
