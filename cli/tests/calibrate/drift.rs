//! A trajectory that drifts: what no study declares is neither an effect nor left out of the ±.

use serde_json::Value;

use crate::drive::{Off, drive, held, report};
use crate::figures::{cautions, first_effect, number};

/// Poses off by something that the next rows share.
fn drifting(remembered: f64) -> Off {
    Off { remembered: Some(remembered), times: |_| 1.0, stated: 1.0 }
}

fn off_alike(report: &Value) -> Option<&Value> {
    cautions(report, "rows that follow each other are off alike").first().copied()
}

/// Where every row counted for itself, seven of ten such drives had effects that are none, and 37 of 51 values lay within twice their ±.
#[test]
fn a_trajectory_that_drifts_is_no_effect_and_is_in_the_uncertainties() {
    let (mut all, mut within) = (0, 0);
    for (seed, remembered) in [(1, 30.0), (2, 30.0), (3, 8.0), (4, 8.0)] {
        let report = report(&format!("drift-{seed}"), &drive(seed, &drifting(remembered), 0.0), "");
        let alike = off_alike(&report).unwrap_or_else(|| panic!("{seed}: {}", report["cautions"]));
        assert!(alike["stretches"].as_u64().is_some_and(|stretches| stretches >= 10), "{alike}");
        assert!(report["effects"].as_array().is_some_and(Vec::is_empty), "{seed}: {}", report["effects"]);
        // Objects are left out one after the other; six numbers explain next to nothing of what they leave.
        let [before, after] = [&report["before"], &report["after"]].map(|own| number(&own["held_out_rms"]));
        assert!(
            (0.95..1.2).contains(&(after / number(&report["after"]["rms"]))),
            "{seed}: {}",
            report["after"]
        );
        assert!((after / before - 1.0).abs() < 1e-9, "{seed}: nothing was added: {before} and {after}");
        let [own, held] = held(&report);
        (all, within) = (all + own, within + held);
    }
    assert!(all >= 16 && within * 10 >= all * 8, "{within} of {all}");
}

#[test]
fn what_the_declaration_lacks_is_found_beside_a_drift() {
    let report = report("drift-planted", &drive(5, &drifting(30.0), 1e-3), "");
    assert!(off_alike(&report).is_some(), "{}", report["cautions"]);
    assert_eq!(report["effects"].as_array().map(Vec::len), Some(1), "{}", report["effects"]);
    assert!(first_effect(&report).contains("encoder eccentricity of angle"), "{}", report["effects"]);
    let [before, after] = [&report["before"], &report["after"]].map(|own| number(&own["held_out_rms"]));
    assert!(after < 0.9 * before, "objects left out: {before} and {after}");
}

/// Each pose off by something of its own is noise like any other.
#[test]
fn poses_that_are_off_one_by_one_make_no_stretches() {
    let report =
        report("drift-none", &drive(6, &Off { remembered: None, times: |_| 1.0, stated: 1.0 }, 0.0), "");
    assert!(off_alike(&report).is_none(), "{}", report["cautions"]);
    assert!(report["effects"].as_array().is_some_and(Vec::is_empty), "{}", report["effects"]);
}

#[test]
fn a_study_may_leave_stretches_out() {
    let report = report("drift-left-out", &drive(1, &drifting(30.0), 0.0), "\n[noise]\nserial = false\n");
    assert!(off_alike(&report).is_none(), "{}", report["cautions"]);
}
