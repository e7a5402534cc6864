//! What tests of several kinds of observation read from a report.

use serde_json::Value;

use crate::support::{Folder, run_in};

/// The report of a study in a folder.
pub fn calibrated(folder: &Folder, study: &str) -> Value {
    let run = run_in(&folder.0, &["calibrate", study, "--format", "json"], "");
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// The cautions of a kind.
pub fn cautions<'a>(report: &'a Value, kind: &str) -> Vec<&'a Value> {
    let all = report["cautions"].as_array().expect("a list").iter();
    all.filter(|one| one["kind"] == kind).collect()
}

/// What has to be a number.
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Data of `pan.chain` with `errors.toml` in a folder, at tilts of up to 60°; `more` are more options.
pub fn simulate_pan(folder: &Folder, poses: usize, noise: &str, seed: usize, more: &[&str]) {
    let (poses, seed) = (poses.to_string(), seed.to_string());
    let mut arguments =
        vec!["simulate", "pan.chain", "--errors", "errors.toml", "--range", "tilt=-60..60 deg"];
    arguments.extend(["--poses", &poses, "--noise", noise, "--seed", &seed, "--out", "data.csv"]);
    arguments.extend(more);
    let made = folder.trueaxis(&arguments);
    assert_eq!(made.code, 0, "{made}");
}

/// Value and standard uncertainty of an error, SI.
pub fn error(report: &Value, name: &str) -> [f64; 2] {
    let errors = report["errors"].as_array().expect("a list");
    let own = errors.iter().find(|error| error["name"] == name).unwrap_or_else(|| panic!("no {name}"));
    ["value", "standard_uncertainty"].map(|key| own[key].as_f64().unwrap_or_else(|| panic!("{own}")))
}

/// Every error holds what was planted within four of its ±.
pub fn holds(report: &Value, planted: &[(&str, f64)]) {
    for (name, planted) in planted {
        let [value, sigma] = error(report, name);
        assert!((value - planted).abs() < 4.0 * sigma, "{name}: {value} ± {sigma}, not {planted}");
    }
}

/// The names of the first effect.
pub fn first_effect(report: &Value) -> String {
    report["effects"][0]["names"].to_string()
}
