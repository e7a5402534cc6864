//! Objects and stations whose rows scatter more than the others': named, and nothing else is.

use serde_json::Value;

use crate::support::{Folder, run_in};

/// The example of targets with other readings: `change` is given station, object, the number of the row and its range.
fn cautions(name: &str, change: impl Fn(&str, &str, usize, f64) -> f64) -> (Vec<Value>, Value, String) {
    let folder = Folder::new(name);
    for file in ["scanner.chain", "targets.toml", "targets.csv"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    let text = folder.read("targets.csv");
    let (header, rows) = text.split_once('\n').expect("a header");
    let rows = rows.lines().enumerate().map(|(number, line)| {
        let (before, range) = line.rsplit_once(',').expect("cells");
        let mut cells = before.split(',');
        let (station, object) = (cells.next().expect("a station"), cells.next().expect("an object"));
        let range_m: f64 = range.parse().expect("a number");
        format!("{before},{:.6}\n", change(station, object, number, range_m))
    });
    folder.write("targets.csv", format!("{header}\n{}", rows.collect::<String>()));
    let run = run_in(&folder.0, &["calibrate", "targets.toml", "--format", "json"], "");
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let all = report["cautions"].as_array().expect("a list").clone();
    let scatter = all.into_iter().filter(|own| own["kind"] == "rows scatter more").collect();
    let told = run_in(&folder.0, &["calibrate", "targets.toml"], "").stdout;
    (scatter, report, told)
}

#[test]
fn a_target_that_moved_is_named_and_the_rest_is_as_without_it() {
    let moved = |station: &str, object: &str, _, range_m| {
        range_m + if object == "T5" && (station == "C" || station == "D") { 8e-3 } else { 0.0 }
    };
    let (scatter, report, told) = cautions("scatter-moved", moved);
    assert_eq!(scatter.len(), 1, "{scatter:?}");
    assert!(scatter[0]["label"] == "T5" && scatter[0]["what"] == "point", "{scatter:?}");
    assert!(scatter[0]["times"].as_f64().is_some_and(|times| times > 3.0), "{scatter:?}");
    assert!(told.contains("The rows of `T5` scatter") && told.contains("Check whether it moved"), "{told}");
    assert!(report["effects"][0]["names"].to_string().contains("encoder eccentricity of azimuth"));
}

#[test]
fn a_station_whose_rows_scatter_is_named() {
    // What a station's ranges are off by there follows no reading, and no target.
    let shaken = |station: &str, _: &str, number: usize, range_m| {
        let by = ((number * number * 7 + number * 3) % 11) as f64 - 5.0;
        range_m + if station == "B" { by * 0.6e-3 } else { 0.0 }
    };
    let (scatter, _, told) = cautions("scatter-station", shaken);
    assert_eq!(scatter.len(), 1, "{scatter:?}");
    assert!(scatter[0]["label"] == "B" && scatter[0]["what"] == "station", "{scatter:?}");
    assert!(told.contains("The rows from station `B` scatter"), "{told}");
}

/// As it is, and with one row that is wrong by itself.
#[test]
fn neither_noise_nor_a_single_outlier_names_anything() {
    let (scatter, ..) = cautions("scatter-none", |_, _, _, range_m| range_m);
    assert_eq!(scatter.len(), 0, "{scatter:?}");
    let one = |_: &str, _: &str, number, range_m| range_m + if number == 17 { 0.05 } else { 0.0 };
    let (scatter, ..) = cautions("scatter-one", one);
    assert_eq!(scatter.len(), 0, "{scatter:?}");
}

/// One row in eight is wrong, whatever it observes: of no target and no station more than of others.
#[test]
fn outliers_everywhere_name_nothing() {
    let wrong = |_: &str, _: &str, number: usize, range_m| match number * 37 % 101 {
        0..12 => range_m + if number.is_multiple_of(2) { -0.02 } else { 0.02 },
        _ => range_m,
    };
    let (scatter, report, _) = cautions("scatter-outliers", wrong);
    assert_eq!(scatter.len(), 0, "{scatter:?}");
    assert!(report["observations"]["set_aside"].as_array().is_some_and(|aside| aside.len() > 15));
}
