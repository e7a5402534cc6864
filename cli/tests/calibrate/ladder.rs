//! The ladder of models on an arm, the goal of a study, and the errors that it wants first.

use std::fmt::Write;

use serde_json::Value;
use testkit::{Random, turned};

use crate::figures::{calibrated, cautions, number};
use crate::support::{Folder, run_in};

const CHAIN: &str = "chain Arm {
    const high: length = 0.4;
    const upper: length = 0.5;
    const lower: length = 0.45;
    body base on ground {
        position_error: Tx(base_x), Ty(base_y), Tz(base_z), Rx(base_rx), Ry(base_ry), Rz(base_rz);
    }
    body first on base {
        position: Tz(high);
        motion: Rz(q1);
        motion_error: Tx(longer_1), Rx(lean_1), Ry(slant_1);
    }
    body second on first {
        position_error: Ry(zero_2);
        motion: Ry(q2);
        motion_error: Ty(beside_2), Rx(lean_2), Rz(skew_2);
    }
    body third on second {
        position: Tz(upper);
        position_error: Ry(zero_3), Tz(longer_3);
        motion: Ry(q3);
        motion_error: Rx(lean_3);
    }
    body tool on third {
        position: Tz(lower);
        position_error: Tx(tool_x), Ty(tool_y), Tz(tool_z);
    }
    observe tip: point(0, 0, 0) of tool;
}
";

const STUDY: &str = "chain = \"arm.chain\"\nobservable = \"tip\"\ndata = \"rows.csv\"\n[columns]\nq1 = { column = \"q1\", unit = \"deg\" }\n\
                     q2 = { column = \"q2\", unit = \"deg\" }\nq3 = { column = \"q3\", unit = \"deg\" }\n[observed]\nkind = \"point\"\nx = { column = \"x\", unit = \"mm\" }\n\
                     y = { column = \"y\", unit = \"mm\" }\nz = { column = \"z\", unit = \"mm\" }\n";

/// Rows of an arm that stands elsewhere, whose zeros are off by `zero` rad, and whose axes lean by `lean` rad.
fn rows(count: usize, seed: u64, zero: f64, lean: f64) -> String {
    let random = &mut Random::new(seed);
    let mut text = "q1,q2,q3,x,y,z\n".to_owned();
    for _ in 0..count {
        let [q1, q2, q3] =
            [170.0, 60.0, 90.0].map(|most: f64| (most * (2.0 * random.even() - 1.0)).to_radians());
        let up = |[x, y, z]: [f64; 3], by: f64| [x, y, z + by];
        let mut point = up([0.003, -0.002, 0.0], 0.45);
        point = turned(1, q3 - zero, turned(0, lean, point));
        point = up(point, 0.5);
        point = turned(1, q2 + zero, turned(0, -lean, point));
        point = turned(2, q1, turned(0, lean, point));
        point = turned(2, 0.004, turned(0, 0.006, up(point, 0.4)));
        let [x, y, z] = [point[0] + 0.012, point[1] - 0.008, point[2] + 0.005];
        let [x, y, z] = [x, y, z].map(|own| 1e3 * own + 0.5 * random.normal());
        let [q1, q2, q3] = [q1, q2, q3].map(f64::to_degrees);
        writeln!(text, "{q1:.6},{q2:.6},{q3:.6},{x:.4},{y:.4},{z:.4}").expect("a string");
    }
    text
}

fn rungs(report: &Value) -> Vec<(&str, f64)> {
    let rungs = report["ladder"]["rungs"].as_array().expect("a list");
    rungs.iter().map(|rung| (rung["name"].as_str().expect("a name"), number(&rung["held_out_rms"]))).collect()
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("arm.chain", CHAIN).write("study.toml", STUDY);
    folder
}

/// The report of the study in a folder, and its page.
fn reported(folder: &Folder) -> (Value, String) {
    let run = run_in(&folder.0, &["calibrate", "study.toml", "--format", "json", "--out", "out"], "");
    assert_eq!(run.code, 0, "{run}");
    (serde_json::from_str(&run.stdout).expect("JSON"), folder.read("out/report.html"))
}

fn names(report: &Value) -> Vec<&str> {
    report["errors"].as_array().expect("a list").iter().filter_map(|own| own["name"].as_str()).collect()
}

#[test]
fn the_simplest_model_that_none_beats_is_written_where_it_predicts_better() {
    let folder = folder("ladder");
    // An arm that is as drawn, but stands elsewhere.
    folder.write("rows.csv", rows(23, 41, 0.0, 0.0));
    let (report, page) = reported(&folder);
    let own = rungs(&report);
    let models: Vec<&str> = own.iter().map(|rung| rung.0).collect();
    assert_eq!(models, ["as delivered", "placed", "zeros", "geometry"], "{}", report["ladder"]);
    assert_eq!(report["ladder"]["simplest"], "placed", "{}", report["ladder"]);
    assert!(own[0].1 > 5.0 * own[1].1 && own[1].1 < own[3].1, "{own:?}");
    let told = cautions(&report, "simpler model predicts better");
    assert_eq!(told.len(), 1, "{}", report["cautions"]);
    assert_eq!(told[0]["spared"].as_array().map(Vec::len), Some(7), "{}", told[0]);
    assert!(report["ladder"]["written"] == "placed" && told[0]["written"] == true, "{}", report["ladder"]);
    assert!(
        names(&report).contains(&"base_x") && !names(&report).contains(&"slant_1"),
        "{:?}",
        names(&report)
    );
    assert!(!folder.read("out/errors.toml").contains("slant_1"));
    // One number for one thing.
    assert!((number(&report["before"]["held_out_rms"]) - own[1].1).abs() < 1e-12, "{own:?}");
    assert!(page.contains("placing the instrument alone") && page.contains("were not estimated"));

    // Somebody wants one of the others: then all are estimated, and the report shows how not to.
    let wanted = "[goal]\nrms = \"2 mm\"\n[report]\nwanted = [\"slant_1\", \"tool_*\"]\n";
    folder.write("study.toml", format!("{STUDY}{wanted}"));
    let (report, page) = reported(&folder);
    assert_eq!(report["ladder"]["written"], "geometry", "{}", report["ladder"]);
    assert_eq!(names(&report)[..4], ["slant_1", "tool_x", "tool_y", "tool_z"]);
    // The others as they are declared.
    assert_eq!(names(&report)[4..7], ["base_x", "base_y", "base_z"]);
    assert!(
        report["goal"]["met"] == true && page.contains("The goal of 2.0 mm is met"),
        "{}",
        report["goal"]
    );
    assert!(page.contains("To use the simpler model"));
}

#[test]
fn enough_rows_of_an_arm_whose_axes_lean_keep_all_its_errors() {
    let folder = folder("leaning");
    folder.write("rows.csv", rows(200, 42, 0.004, 0.003));
    let report = calibrated(&folder, "study.toml");
    let own = rungs(&report);
    assert!(cautions(&report, "simpler model predicts better").is_empty(), "{}", report["cautions"]);
    assert_eq!(report["ladder"]["simplest"], "geometry", "{}", report["ladder"]);
    assert!(own.windows(2).all(|two| two[1].1 < 0.9 * two[0].1), "{own:?}");
    // The figure of the declaration is the one before and after, where nothing was found.
    assert!(report["effects"].as_array().is_some_and(Vec::is_empty), "{}", report["effects"]);
    assert!((number(&report["before"]["held_out_rms"]) - own[3].1).abs() < 1e-12, "{own:?}");
}

#[test]
fn a_goal_or_a_wanted_error_that_cannot_be_is_refused() {
    let folder = folder("asked");
    folder.write("rows.csv", rows(23, 43, 0.0, 0.0));
    for (lines, says) in [
        ("[goal]\nrms = \"5 arcsec\"\n", "length"),
        ("[goal]\nrms = 5\n", "without a unit"),
        ("[goal]\nrms = \"0 mm\"\n", "larger than zero"),
        ("[report]\nwanted = [\"tool_w*\"]\n", "nearest name is `tool_"),
        ("[report]\nwanted = [\"x*\"]\n", "there are `high`"),
        ("[report]\nwanted = [\"tool_w\"]\n", "did you mean `tool_"),
        ("[fit]\nfix = { tool_x = 0 }\n[report]\nwanted = [\"tool_x\"]\n", "is not estimated"),
    ] {
        folder.write("study.toml", format!("{STUDY}{lines}"));
        let run = run_in(&folder.0, &["calibrate", "study.toml"], "");
        assert!(run.code == 2 && run.stderr.contains(says), "{lines}: {run}");
    }
}
