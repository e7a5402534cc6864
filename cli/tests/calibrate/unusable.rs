//! A calibration that nobody can correct with says so first, and leaves nothing that could be mistaken for a result.

use serde_json::Value;

use crate::observations::{ENCODER, ENCODER_STUDY};
use crate::support::Folder;

/// One reading determines one error, and nothing is left to judge it by.
#[test]
fn too_few_observations_end_with_one_and_amend_nothing() {
    let folder = Folder::new("too-few");
    folder.write("encoder.chain", ENCODER).write("study.toml", ENCODER_STUDY);
    folder.write("measured.csv", "reading,true\n30,30.01\n");
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("NOT ENOUGH DATA\n"), "{run}");
    assert!(!run.stdout.contains('±'), "no uncertainty is made up: {run}");
    let names = std::fs::read_dir(folder.0.join("result")).expect("the folder is there");
    let mut names: Vec<String> =
        names.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert_eq!(names, ["report.html", "report.json", "residuals.csv"]);
    let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    assert_eq!(report["verdict"], "too few observations");
    for absent in ["search", "remaining"] {
        assert_eq!(report[absent], Value::Null, "no search was made");
    }
    assert!(folder.read("result/report.html").contains("Not enough data"));
}

/// What an earlier run left there is pointed out.
#[test]
fn what_an_earlier_run_left_is_pointed_out() {
    let folder = Folder::new("too-few-again");
    folder.write("encoder.chain", ENCODER).write("study.toml", ENCODER_STUDY);
    folder.write("amended.chain", ENCODER).write("measured.csv", "reading,true\n30,30.01\n");
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "."]);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stderr.contains("amended.chain in . is from an earlier run"), "{run}");
    assert_eq!(folder.read("amended.chain"), ENCODER, "it is left as it was");
}
