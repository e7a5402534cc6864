//! Ranges, alone and beside directions, and standard deviations that each series states for itself.

use serde_json::Value;

use crate::support::Folder;

const TRACKER: &str = "chain Tracker {
    body base on ground { motion: Rz(-azimuth); motion_error: Rz(-azimuth_index); }
    body head on base { motion: Rx(elevation); motion_error: Rx(elevation_index), Ty(range_zero); }
    input distance: length;
    observe sight: direction(0, 1, 0) of head;
    observe target: point(0, distance, 0) of head;
}
";

const RANGES: &str = "observable = \"target\"
data = \"ranges.csv\"
[COLUMNS]
azimuth = { column = \"az\", unit = \"deg\" }
elevation = { column = \"el\", unit = \"deg\" }
distance = { column = \"nominal\", unit = \"m\" }
[OBSERVED]
kind = \"range\"
range = { column = \"shown\", unit = \"m\" }
";

const SIGHTS: &str = "observable = \"sight\"
data = \"sights.csv\"
[columns]
azimuth = { column = \"az\", unit = \"deg\" }
elevation = { column = \"el\", unit = \"deg\" }
[observed]
kind = \"spherical\"
azimuth = { column = \"true_az\", unit = \"deg\" }
elevation = { column = \"true_el\", unit = \"deg\" }
";

const FIT: &str = "[fit]\nrobust = false\n";

/// By how much each range is too long, mm, and the standard deviation that the file states of it.
const LEFT_MM: [f64; 10] = [2.0, 2.4, 1.7, 2.1, 1.9, 3.5, 2.2, 1.8, 2.05, 2.3];
const STD_MM: [f64; 10] = [0.2, 0.3, 0.25, 0.1, 0.15, 2.0, 0.3, 0.2, 0.1, 0.3];

/// By how much each azimuth is beside its reading, arcsec, and the standard deviation that the file states of it.
const LEFT_ARCSEC: [f64; 10] = [10.0, 12.0, 11.0, 31.0, 9.0, 13.0, 8.0, 11.5, 10.5, 12.5];
const STD_ARCSEC: [f64; 10] = [1.0, 2.0, 1.5, 20.0, 1.0, 2.0, 3.0, 1.0, 1.0, 2.0];

/// The tracker, its ranges, and its sights.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    let (mut ranges, mut sights) =
        (String::from("az,el,nominal,shown,std_mm\n"), String::from("az,el,true_az,true_el,std\n"));
    for at in 0..10 {
        let (azimuth, elevation, distance) = (36.0 * at as f64, 5.0 + 7.0 * at as f64, 2.0 + 3.1 * at as f64);
        ranges +=
            &format!("{azimuth},{elevation},{distance},{},{}\n", distance + LEFT_MM[at] / 1e3, STD_MM[at]);
        let shown = azimuth + LEFT_ARCSEC[at] / 3600.0;
        sights += &format!("{azimuth},{elevation},{shown},{elevation},{}\n", STD_ARCSEC[at]);
    }
    folder.write("tracker.chain", TRACKER).write("ranges.csv", ranges).write("sights.csv", sights);
    folder
}

/// The report of a study of the tracker.
fn report(folder: &Folder, study: &str) -> Value {
    folder.write("study.toml", format!("chain = \"tracker.chain\"\n{study}"));
    let run = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// The ranges as the study's only series, or beside another.
fn ranges(columns: &str, observed: &str) -> String {
    RANGES.replace("COLUMNS", columns).replace("OBSERVED", observed)
}

fn beside(sigma: &str) -> String {
    let ranges = ranges("also.columns", "also.observed");
    let (observable, tables) = ranges.split_once("[also.columns]").expect("a table");
    format!("[[also]]\n{observable}{sigma}[also.columns]{tables}")
}

fn zero(report: &Value) -> f64 {
    let errors = report["errors"].as_array().expect("a list");
    let error = errors.iter().find(|error| error["name"] == "range_zero").expect("it was estimated");
    error["value"].as_f64().expect("a number")
}

fn mean(values: &[f64], weight: impl Fn(usize) -> f64) -> f64 {
    let sum = |of: &dyn Fn(usize) -> f64| (0..values.len()).map(of).sum::<f64>();
    sum(&|at| weight(at) * values[at]) / sum(&weight)
}

/// Of each series the unit of its noise, and whether that is a factor on what the data state.
fn noise(report: &Value) -> Vec<(&str, bool)> {
    let series = report["noise"]["series"].as_array().expect("a list").iter();
    series.map(|one| (one["unit"].as_str().expect("a unit"), one["of_stated"] == true)).collect()
}

/// Ranges know the zero alone: it is their mean, and no direction shows in them.
#[test]
fn ranges_alone_give_the_zero() {
    let folder = folder("ranges-alone");
    let report = report(&folder, &format!("{}{FIT}", ranges("columns", "observed")));
    let expected = mean(&LEFT_MM, |_| 1.0) / 1e3;
    assert!((zero(&report) / expected - 1.0).abs() < 1e-9, "{} is not {expected}", zero(&report));
    let separable: Vec<_> =
        report["errors"].as_array().expect("a list").iter().map(|error| error["separable"] == true).collect();
    assert_eq!(separable, [false, false, true]);
    assert_eq!(report["unit"], "m");
}

/// Each series is weighed by the column that it names itself: arcsec here, mm there.
#[test]
fn each_series_states_its_own_uncertainties() {
    let folder = folder("ranges-beside");
    let stated = "[noise]\nvariance = false\nsigma = { column = \"std\", unit = \"arcsec\" }\n";
    let own = "sigma = { column = \"std_mm\", unit = \"mm\" }\n";
    let report = report(&folder, &format!("{SIGHTS}{stated}{FIT}{}", beside(own)));
    let expected = mean(&LEFT_MM, |at| STD_MM[at].powi(-2)) / 1e3;
    assert!((zero(&report) / expected - 1.0).abs() < 1e-9, "{} is not {expected}", zero(&report));
    assert_eq!(noise(&report), [("1", true), ("1", true)]);
}

/// Standard deviations of angles say nothing of ranges: those count alike, and their noise is one of lengths.
#[test]
fn uncertainties_of_angles_are_not_those_of_ranges() {
    let folder = folder("ranges-unstated");
    let stated = "[noise]\nvariance = false\nsigma = { column = \"std\", unit = \"arcsec\" }\n";
    let report = report(&folder, &format!("{SIGHTS}{stated}{FIT}{}", beside("")));
    let expected = mean(&LEFT_MM, |_| 1.0) / 1e3;
    assert!((zero(&report) / expected - 1.0).abs() < 1e-9, "{} is not {expected}", zero(&report));
    assert_eq!(noise(&report), [("1", true), ("m", false)]);
}

#[test]
fn a_single_value_beside_is_refused() {
    let folder = folder("ranges-refused");
    let study = format!("chain = \"tracker.chain\"\n{SIGHTS}{}", beside("sigma = \"0.1 mm\"\n"));
    folder.write("study.toml", study);
    let run = folder.trueaxis(&["calibrate", "study.toml"]);
    assert_eq!(run.code, 2, "{run}");
    insta::assert_snapshot!(run.stderr);
}
