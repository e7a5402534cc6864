//! Tables of targets that nobody placed: those of `examples/objects/simulate.py`, whose circle sits off centre.

use serde_json::Value;

use crate::begun;
use crate::support::{Folder, root};

/// What begins from the table says so, and has no scale, which nothing would hold.
#[test]
fn labels_of_targets_and_stations_begin_a_study_of_unknown_ones() {
    let folder = Folder::new("init-targets");
    let table = std::fs::read_to_string(root().join("examples/objects/targets.csv")).expect("it is there");
    folder.write("rows.csv", table.replace("station,object,", "setup,prism,"));
    let [init, calibrate] = begun(&folder, "rows.csv");
    assert!(init.stdout.starts_with("total-station"), "{init}");
    let study = folder.read("rows.toml");
    assert!(study.contains("kind = \"target\"\nobject = \"prism\"\nstation = \"setup\"\n"), "{study}");
    assert!(!folder.read("rows.chain").contains("distance_scale"));
    assert_eq!(calibrate.code, 0, "{calibrate}");
    let report: Value = serde_json::from_str(&calibrate.stdout).expect("JSON");
    let effect = report["effects"][0]["names"].to_string();
    assert!(effect.contains("encoder eccentricity of horizontal"), "{effect}");
    for (name, planted) in
        [("distance_zero", 1.5e-3), ("collimation", 40.0 * std::f64::consts::PI / 648_000.0)]
    {
        let errors = report["errors"].as_array().expect("errors");
        let own = errors.iter().find(|error| error["name"] == name).expect("it is declared");
        let [value, sigma] =
            ["value", "standard_uncertainty"].map(|key| own[key].as_f64().expect("a number"));
        assert!((value - planted).abs() < 4.0 * sigma, "{own}");
    }
}

/// Targets from one station need no column of stations.
#[test]
fn one_station_needs_no_label() {
    let folder = Folder::new("init-targets-one");
    let table = std::fs::read_to_string(root().join("examples/objects/targets.csv")).expect("it is there");
    let own = table.lines().filter(|line| line.starts_with("station") || line.starts_with("A,"));
    let own: Vec<&str> = own.filter_map(|line| Some(line.split_once(',')?.1)).collect();
    folder.write("rows.csv", own.join("\n") + "\n");
    let [_, calibrate] = begun(&folder, "rows.csv");
    assert!(folder.read("rows.toml").contains("object = \"object\"\n"));
    assert!(!folder.read("rows.toml").contains("station ="));
    assert_eq!(calibrate.code, 0, "{calibrate}");
}
