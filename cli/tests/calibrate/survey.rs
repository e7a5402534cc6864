//! A radio telescope before two total stations: measured directions and distances to targets on its dish.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::support::{Folder, run_in};

/// The cells of the survey's table, and the table that `prepare.py` makes of what one station saw.
fn prepared(text: &str, station: &str, is_second: bool) -> String {
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let ha = |row: &[&str]| number(row[9]);
    let mut rounds: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row[1] == station && ["WAS3", "WAN3"].contains(&row[3])) {
        rounds.entry(row[8]).or_default().push((ha(row) + 180.0).rem_euclid(360.0) - 180.0);
    }
    let mut table =
        "target,ha [deg],zd [deg],range [m],azimuth [deg],elevation [deg],second,aside [m],along [m]\n"
            .to_owned();
    for row in rows.iter().filter(|row| row[1] == station && !row[6].is_empty()) {
        let (arc, label) = (row[6], row[5].parse::<i32>().expect("a label"));
        let turns = ["A", "B"].contains(&arc);
        let azimuth = if turns { 10 * label } else { 450 * i32::from(is_second) };
        let elevation = if turns { 0 } else { label };
        let back = &rounds[row[8]];
        let ha = ha(row) - back.iter().sum::<f64>() / back.len() as f64;
        table.push_str(&format!(
            "{arc}{},{ha:.6},{},{},{azimuth},{elevation},{},{:.7},{}\n",
            row[7],
            row[11],
            row[13],
            u8::from(is_second),
            number(row[12]).to_radians() * number(row[13]),
            row[14],
        ));
    }
    table
}

/// Published for this survey: the axes 2504.3 ± 0.3 mm apart, 0.07 ± 0.06′ off square. Both are found within that.
#[test]
fn the_axes_of_a_telescope_are_found_from_stations_that_nobody_placed() {
    let Some(data) = testkit::measured("total-station-30m.csv") else { return };
    let text = std::fs::read_to_string(data).expect("text");
    let folder = Folder::new("survey");
    folder.copy("examples/total-station/telescope.chain").copy("examples/total-station/survey.toml");
    folder.write("first.csv", prepared(&text, "WAS3", false));
    folder.write("second.csv", prepared(&text, "WAN3", true));
    let run = run_in(&folder.0, &["calibrate", "survey.toml", "--format", "json"], "");
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["observations"]["rows"], 176);
    let errors = report["errors"].as_array().expect("a list");
    let value = |name: &str| {
        let own = errors.iter().find(|error| error["name"] == name).expect("it is estimated");
        ["value", "standard_uncertainty"].map(|key| own[key].as_f64().expect("a number"))
    };
    let arcmin = std::f64::consts::PI / 10_800.0;
    let [square, sigma] = value("not_square").map(|value| value / arcmin);
    assert!((square - 0.07).abs() < 0.06 + sigma, "{square} ± {sigma} arcmin");
    let [apart, sigma] = value("axes_apart").map(|value| value * 1e3);
    assert!((2500.0 + apart - 2504.3).abs() < 0.3 && sigma < 0.3, "{apart} ± {sigma} mm");
}
