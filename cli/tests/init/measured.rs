//! Measured data, the project's own and others' that lie outside of it: `init` begins, and `calibrate` ends with a verdict.

use std::fs;

use serde_json::Value;

use crate::begun;
use crate::support::{Folder, root};

/// Rows of each file that are tried: enough for a verdict.
const ROWS: usize = 120;

/// A table with its header and some rows all over it.
fn thinned(text: &str) -> String {
    let (header, rows) = text.split_once('\n').expect("a header");
    let rows: Vec<&str> = rows.lines().collect();
    let every = rows.len().div_ceil(ROWS);
    let kept = rows.into_iter().step_by(every).collect::<Vec<_>>();
    format!("{header}\n{}\n", kept.join("\n"))
}

fn ends_with_a_verdict(name: &str, text: &str, template: &str) {
    let folder = Folder::new(&format!("init-measured-{name}"));
    folder.write("data.csv", thinned(text));
    let [init, calibrate] = begun(&folder, "data.csv");
    assert!(init.stdout.starts_with(template), "{name}: {init}");
    assert!(calibrate.code < 2, "{name}: {calibrate}");
    let report: Value = serde_json::from_str(&calibrate.stdout).expect("JSON");
    assert!(report["verdict"].is_string(), "{name}");
    assert_ne!(report["verdict"], "fit failed", "{name}");
}

#[test]
fn the_projects_own_data() {
    for (file, template) in [
        ("course/secret.csv", "alt-azimuth"),
        ("mobile-lidar/measured.csv", "scanner"),
        ("turntable/measured.csv", "turntable"),
    ] {
        let text = fs::read_to_string(root().join("examples").join(file)).expect("an example");
        ends_with_a_verdict(&file.replace(['/', '.'], "-"), &text, template);
    }
}

/// A file of others' data; `None` where it is missing.
fn of_others(file: &str) -> Option<String> {
    Some(fs::read_to_string(testkit::measured(file)?).expect("text"))
}

#[test]
fn others_data() {
    for (file, template) in [
        ("auxtel-2020-03.csv", "alt-azimuth"),
        ("auxtel-2022-04.csv", "alt-azimuth"),
        ("iram30m-2013-04.csv", "alt-azimuth"),
        ("iram30m-2013-10.csv", "alt-azimuth"),
        ("equatorial-a.csv", "equatorial"),
        ("equatorial-b.csv", "equatorial"),
        ("encoder-a.csv", "encoder"),
        ("encoder-b.csv", "encoder"),
        ("ur10-joint-configurations.csv", "arm"),
    ] {
        if let Some(text) = of_others(file) {
            ends_with_a_verdict(&file.replace('.', "-"), &text, template);
        }
    }
}

#[test]
fn data_without_a_truth_are_refused_with_what_is_missing() {
    for (file, said) in [
        ("total-station-30m.csv", "has a cell that is no number in row 1"),
        ("ball-sockets.csv", "7 columns of joints"),
    ] {
        let Some(text) = of_others(file) else { continue };
        let folder = Folder::new(&format!("init-without-{file}"));
        folder.write("data.csv", text);
        let run = folder.trueaxis(&["init", "data.csv"]);
        assert_eq!(run.code, 2, "{file}: {run}");
        assert!(run.stderr.contains(said), "{file}: {run}");
        assert_eq!(folder.names(), ["data.csv"]);
    }
}
