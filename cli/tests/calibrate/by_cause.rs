//! Values of declared errors that hang on which of several causes is the true one.

use serde_json::Value;

use crate::figures::{calibrated, error};
use crate::support::{Folder, root};

/// The example's study in a folder of its own, with a line more under `[search]`.
fn folder(name: &str, only: &str) -> Folder {
    let folder = Folder::new(name);
    let text = std::fs::read_to_string(root().join("examples/mobile-lidar/study.toml")).expect("the study");
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").copy("examples/mobile-lidar/measured.csv");
    folder.write("study.toml", text.replacen("[search]", &format!("[search]\n{only}"), 1));
    folder
}

/// How far an error or a combination would move by cause, from its value.
fn range(told: &Value) -> Option<[f64; 2]> {
    let moves = told["moves_by_cause"].as_array()?;
    let value = told["value"].as_f64().expect("a value");
    Some([0, 1].map(|at| value + moves[at].as_f64().expect("a number")))
}

/// Each cause that fits is taken for the true one, by a search that knows no other: what the declared errors come out at lies
/// within the ranges told, whose ends are reached, and what is told without a range stays.
#[test]
fn a_range_by_cause_is_what_the_causes_make_of_a_value() {
    let all = calibrated(&folder("range-by-cause", ""), "study.toml");
    let causes = all["effects"][0]["causes"].as_array().expect("a list");
    assert!(causes.len() > 2, "{causes:?}");
    let alone: Vec<Value> = causes
        .iter()
        .map(|cause| {
            let only = format!("effects = [{}]", cause["name"]);
            let report = calibrated(&folder("one-cause-alone", &only), "study.toml");
            assert_eq!(report["effects"][0]["names"][0], cause["name"], "{}", report["effects"]);
            report
        })
        .collect();
    let mut ranges = 0;
    for told in all["errors"].as_array().expect("a list") {
        let (Some(name), Some(sigma)) = (told["name"].as_str(), told["standard_uncertainty"].as_f64()) else {
            continue;
        };
        if all["effects"][0]["coefficients"].get(name).is_some() {
            continue;
        }
        let values: Vec<f64> = alone.iter().map(|report| error(report, name)[0]).collect();
        let (least, most) = (
            values.iter().copied().fold(f64::INFINITY, f64::min),
            values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        );
        match range(told) {
            Some([low, high]) => {
                ranges += 1;
                assert!((low - least).abs() < 0.5 * sigma, "{name}: {low}, reached {least}, ± {sigma}");
                assert!((high - most).abs() < 0.5 * sigma, "{name}: {high}, reached {most}, ± {sigma}");
            }
            None => assert!(most - least < 1.5 * sigma, "{name}: {least} to {most}, and no range"),
        }
    }
    assert!(ranges > 0, "{}", all["errors"]);
}

/// What is told of one cause alone has no range.
#[test]
fn one_cause_makes_no_range() {
    let only = "effects = [\"encoder eccentricity of beta\"]";
    let report = calibrated(&folder("one-cause", only), "study.toml");
    assert_eq!(report["effects"][0]["causes"].as_array().map(Vec::len), Some(1), "{}", report["effects"]);
    let listed = ["errors", "estimable"].map(|key| report[key].as_array().expect("a list").clone()).concat();
    assert!(listed.iter().all(|told| range(told).is_none()), "{listed:?}");
}
