//! Stations that move while they measure: nothing of the instrument is to be named for it.

use crate::figures::{calibrated, cautions, number};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::{Folder, run_in};
use testkit::Random;

#[test]
fn a_tripod_that_sinks_is_told_and_no_cause_in_the_instrument() {
    let folder = Folder::new("moved");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero")).write("study.toml", STUDY);
    for (seed, sinks_m, twists_rad) in [(61, 1e-3, 1e-4), (62, 0.3e-3, 0.0), (63, 0.0, 0.0)] {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        folder.write("rows.csv", room.rows_moving(random, sinks_m, twists_rad));
        let report = calibrated(&folder, "study.toml");
        let own = cautions(&report, "stations moved while measuring");
        if sinks_m == 0.0 {
            assert_eq!(
                (own.len(), &report["effects"]),
                (0, &serde_json::json!([])),
                "{}",
                report["cautions"]
            );
            continue;
        }
        assert_eq!(own.len(), 1, "{}", report["effects"]);
        // All that is found is that.
        let found = report["effects"].as_array().map_or(0, Vec::len);
        assert_eq!(own[0]["instead_of"].as_array().map_or(0, Vec::len), found, "{own:?}");
        let shift_m = number(&own[0]["shift_m"]);
        assert!((shift_m - sinks_m).abs() < 0.3 * sinks_m, "{shift_m}, not {sinks_m}");
        let told = run_in(&folder.0, &["calibrate", "study.toml"], "").stdout;
        assert!(
            told.starts_with("MOVED WHILE MEASURING") && told.contains("Do not correct with it"),
            "{told}"
        );
    }
}
