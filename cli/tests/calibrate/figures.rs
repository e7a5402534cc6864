//! What tests of several kinds of observation read from a report.

use serde_json::Value;

use crate::support::{Folder, run_in};

/// The report of a study in a folder.
pub fn calibrated(folder: &Folder, study: &str) -> Value {
    let run = run_in(&folder.0, &["calibrate", study, "--format", "json"], "");
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
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
