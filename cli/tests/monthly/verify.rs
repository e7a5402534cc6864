//! `verify`: still valid, recalibrate, or cannot say with these rows.

use serde_json::Value;

use crate::support::Run;
use crate::{ARCSEC, CORNER, Errors, SPREAD, folder, instrument, json, noisier, rows};

const NONE: Errors = [3.0, -2.0, 40.0, 5.0];

fn verify(name: &str, text: &str, data: &str, more: &[&str]) -> Run {
    let folder = folder(name, text);
    folder.write("ten.csv", data);
    folder.trueaxis(&[&["verify", "instrument.toml", "--data", "ten.csv"], more].concat())
}

const GOAL: [&str; 2] = ["--goal", "5 arcsec"];

#[test]
fn an_instrument_that_did_not_change_is_still_valid() {
    let run = verify("valid", &instrument(NONE), &rows(NONE, &SPREAD, 1.0, 7), &GOAL);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("STILL VALID. 10 rows agree with the calibration"), "{run}");
    assert_eq!(run.stderr, "");
}

#[test]
fn an_index_that_moved_is_named_with_its_size() {
    let moved = [NONE[0], NONE[1], NONE[2] + 12.0, NONE[3]];
    let run = verify("moved", &instrument(NONE), &rows(moved, &SPREAD, 1.0, 8), &GOAL);
    assert_eq!(run.code, 1, "{run}");
    assert!(
        run.stdout.starts_with("RECALIBRATE. 10 rows disagree with the calibration (p ≤ 0.001)."),
        "{run}"
    );
    assert!(run.stdout.contains("A change of index by 1"), "{run}");
    let more = [&GOAL[..], &["--format", "json"]].concat();
    let run = verify("moved-json", &instrument(NONE), &rows(moved, &SPREAD, 1.0, 8), &more);
    let found = json(&run);
    assert_eq!([&found["verdict"], &found["explained_by"][0]], ["recalibrate", "index"], "{run}");
    let index = found["errors"].as_array().into_iter().flatten().find(|error| error["name"] == "index");
    let index = index.expect("the index is an error");
    let of = |key: &str| index[key].as_f64().expect("a number") / ARCSEC;
    assert!((of("change") - 12.0).abs() < 3.0 * of("standard_uncertainty"), "{run}");
    // Ten rows of noise 1″ beside a calibration of 0.1″: 1/√10 and 0.1.
    assert!((of("standard_uncertainty") - 0.1_f64.hypot(0.1_f64.sqrt())).abs() < 0.01, "{run}");
}

/// Ten rows in one corner could not have shown everything; with the rows that are proposed they do.
#[test]
fn rows_of_one_corner_say_nothing_and_the_proposed_ones_make_them_enough() {
    let text = noisier(&instrument(NONE), 3.0);
    let run = verify("corner", &text, &rows(NONE, &CORNER, 3.0, 9), &GOAL);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("CANNOT SAY. 10 rows agree with the calibration"), "{run}");
    assert!(run.stdout.contains("They could have missed a change of tilt_y"), "{run}");
    assert!(run.stdout.contains("Rows to add"), "{run}");
    let more = [&GOAL[..], &["--format", "json"]].concat();
    let found = json(&verify("corner-json", &text, &rows(NONE, &CORNER, 3.0, 9), &more));
    assert_eq!(found["rows_to_add"]["enough"], true, "{found}");
    let poses = found["rows_to_add"]["poses"].as_array().expect("poses");
    assert!(!poses.is_empty() && poses.len() <= 5, "{found}");
    let added = poses.iter().map(|pose| {
        ["azimuth", "elevation"].map(|name| pose[name].as_f64().expect("a reading").to_degrees())
    });
    let all: Vec<[f64; 2]> = CORNER.into_iter().chain(added).collect();
    let run = verify("corner-and-more", &text, &rows(NONE, &all, 3.0, 9), &GOAL);
    assert!(run.stdout.starts_with("STILL VALID."), "{run}");
}

#[test]
fn rows_outside_of_the_measured_region_are_told_and_not_judged() {
    let mut poses = SPREAD.to_vec();
    poses.extend([[10.0, 85.0], [20.0, 86.0]]);
    // There the rows are a degree off.
    let mut data = rows(NONE, &poses[..10], 1.0, 7);
    let far = rows([0.0, 0.0, 3600.0, 0.0], &poses[10..], 1.0, 8);
    data.push_str(far.split_once('\n').expect("a header").1);
    let run = verify("outside", &instrument(NONE), &data, &GOAL);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.contains("Not judged: 2 rows outside the measured region (11, 12)."), "{run}");
    let run = verify("all-outside", &instrument(NONE), &far, &GOAL);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("CANNOT SAY. No row lies inside the measured region"), "{run}");
}

#[test]
fn a_misread_column_is_told_as_one() {
    // Radians under the heading of degrees.
    let data = rows(NONE, &SPREAD, 1.0, 7);
    let wrong: String = data
        .lines()
        .enumerate()
        .map(|(at, line)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if at > 0 {
                cells[3] = format!("{:.9}", cells[3].parse::<f64>().expect("a number").to_radians());
            }
            cells.join(",") + "\n"
        })
        .collect();
    let run = verify("misread", &instrument(NONE), &wrong, &GOAL);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("CHECK THE COLUMNS. The residuals are "), "{run}");
}

#[test]
fn one_bad_row_is_named() {
    let mut lines: Vec<String> = rows(NONE, &SPREAD, 1.0, 7).lines().map(str::to_owned).collect();
    let mut cells: Vec<f64> = lines[4].split(',').map(|cell| cell.parse().expect("a number")).collect();
    cells[3] += 30.0 / 3600.0;
    lines[4] = cells.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let run = verify("one-row", &instrument(NONE), &(lines.join("\n") + "\n"), &GOAL);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.contains("Row 4 alone explains the difference."), "{run}");
}

/// A change that is certain, and small beside what matters.
#[test]
fn a_change_below_the_goal_leaves_the_calibration_valid() {
    let text = noisier(&instrument(NONE), 0.1);
    let moved = [NONE[0], NONE[1], NONE[2] + 1.0, NONE[3]];
    let run = verify("below", &text, &rows(moved, &SPREAD, 0.1, 8), &GOAL);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("STILL VALID. The instrument changed by 1.0"), "{run}");
    assert!(run.stdout.contains("below the goal of 5.00″"), "{run}");
}

#[test]
fn the_goal_is_the_noise_of_one_observation_where_none_is_given() {
    let run = verify("default", &instrument(NONE), &rows(NONE, &SPREAD, 1.0, 7), &["--format", "json"]);
    let goal = json(&run)["goal"].as_f64().expect("a number");
    assert!((goal / ARCSEC - 2.0_f64.sqrt()).abs() < 1e-9, "{run}");
}

/// What `calibrate` writes can be checked: the noise is in the file.
#[test]
fn a_calibration_of_the_command_is_checked() {
    let folder = crate::support::Folder::new("monthly-whole");
    let text = instrument(NONE);
    let chain = text.split("'''").nth(1).expect("a chain");
    folder.write("mount.chain", chain);
    let study = "chain = \"mount.chain\"\ndata = \"stars.csv\"\n[columns]\nazimuth = { column = \"az\", unit = \"deg\" }\n\
                 elevation = { column = \"el\", unit = \"deg\" }\n[observed]\nkind = \"spherical\"\n\
                 azimuth = { column = \"true_az\", unit = \"deg\" }\nelevation = { column = \"true_el\", unit = \"deg\" }\n\
                 [hold_out]\nfolds = 3\n";
    folder.write("study.toml", study);
    let poses: Vec<[f64; 2]> =
        (0..48).map(|at| [f64::from((at * 47) % 360) - 180.0, 10.0 + f64::from((at * 31) % 70)]).collect();
    folder.write("stars.csv", rows(NONE, &poses, 1.0, 3));
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(folder.read("result/instrument.toml").contains("[[noise]]"));
    folder.write("ten.csv", rows(NONE, &SPREAD, 1.0, 12));
    let run =
        folder.trueaxis(&["verify", "result/instrument.toml", "--data", "ten.csv", "--goal", "5 arcsec"]);
    assert_eq!(run.code, 0, "{run}");
    let moved = [NONE[0], NONE[1], NONE[2] + 12.0, NONE[3]];
    folder.write("ten.csv", rows(moved, &SPREAD, 1.0, 12));
    let run =
        folder.trueaxis(&["verify", "result/instrument.toml", "--data", "ten.csv", "--goal", "5 arcsec"]);
    assert_eq!((run.code, run.stdout.contains("RECALIBRATE")), (1, true), "{run}");
    let run = folder.trueaxis(&["compare", "result/instrument.toml", "result/instrument.toml"]);
    assert_eq!(run.code, 0, "{run}");
}

#[test]
fn numbers_of_the_answer_agree() {
    let more = [&GOAL[..], &["--format", "json"]].concat();
    let found = json(&verify("json", &instrument(NONE), &rows(NONE, &SPREAD, 1.0, 7), &more));
    let freedom = |part: &str| found[part]["degrees_of_freedom"].as_u64().expect("a number");
    // Ten rows of two components, four errors that they separate.
    assert_eq!([freedom("explained"), freedom("rest")], [4, 16], "{found}");
    assert_eq!(found["rows"]["judged"].as_array().map(Vec::len), Some(10));
    assert_eq!(found["rows_to_add"], Value::Null);
}
