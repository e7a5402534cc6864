//! The example's bar, whose lengths are told from another zero: no axis moves for that.

use std::fmt::Write;

use crate::figures::{calibrated, cautions, number};
use crate::support::{Folder, run_in};

const CHAIN: &str = include_str!("../../../examples/objects/arm.chain");
const STUDY: &str = include_str!("../../../examples/objects/bars.toml");
const ROWS: &str = include_str!("../../../examples/objects/bars.csv");

#[test]
fn lengths_from_another_zero_are_told_and_no_motion_of_an_axis() {
    let folder = Folder::new("bar");
    folder.write("arm.chain", CHAIN).write("study.toml", STUDY);
    for too_long_mm in [0.0, 1.0, -3.0] {
        let mut rows = String::new();
        for line in ROWS.lines() {
            let (readings, length) = line.rsplit_once(',').expect("five columns");
            match length.parse::<f64>() {
                Err(_) => writeln!(rows, "{line}"),
                Ok(length_mm) => writeln!(rows, "{readings},{:.3}", length_mm + too_long_mm),
            }
            .expect("a string");
        }
        folder.write("bars.csv", rows);
        let report = calibrated(&folder, "study.toml");
        let own = cautions(&report, "lengths from another zero");
        assert_eq!(own.len(), usize::from(too_long_mm != 0.0), "{too_long_mm}: {}", report["cautions"]);
        if let [own] = own[..] {
            let by_mm = 1e3 * number(&own["by_m"]);
            assert!((by_mm - too_long_mm).abs() < 0.2 * too_long_mm.abs(), "{by_mm}, not {too_long_mm}");
            let told = run_in(&folder.0, &["calibrate", "study.toml"], "").stdout;
            let (answers, _) = told.split_once("How much better").expect("the answers");
            let causes = answers.split_once("What it is").map_or("", |(_, causes)| causes);
            assert!(told.starts_with("LENGTHS ARE OFF") && !causes.contains("q1"), "{told}");
        }
    }
}
