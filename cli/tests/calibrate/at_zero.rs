//! An error beside another one times an input is that at zero of the input, which may be far from all data.

use serde_json::Value;

use crate::figures::simulate_pan;
use crate::support::Folder;

const CHAIN: &str = "chain Pan {
    input air: temperature;
    body base on ground { motion: Rz(pan); motion_error: Rz(index), Rz(drift*air); }
    body tube on base { motion: Rx(tilt); motion_error: Rx(sag); }
    observe sight: direction(0, 1, 0) of tube;
}";

#[test]
fn an_error_that_stands_for_zero_of_a_far_input_is_said_to() {
    for (air, is_told) in [("18..22", true), ("-5..25", false)] {
        let folder = Folder::new(&format!("at_zero_{is_told}"));
        folder.write("pan.chain", CHAIN);
        folder.write("errors.toml", "index = \"30 arcsec\"\ndrift = \"5 arcsec\"\nsag = \"20 arcsec\"\n");
        simulate_pan(&folder, 60, "2 arcsec", 1, &["--range", &format!("air={air}")]);
        folder.write(
            "study.toml",
            "chain = \"pan.chain\"\ndata = \"data.csv\"\n[observed]\nkind = \"direction\"\n[search]\neffects = [\"encoder\"]\n",
        );
        let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "out"]);
        assert_eq!(run.code, 0, "{run}");
        let told = "Index is the value at air = 0. These data have 18.1 to 22.0";
        let report: Value = serde_json::from_str(&folder.read("out/report.json")).expect("JSON");
        if is_told {
            assert!(run.stdout.contains(told), "{run}");
            assert!(folder.read("out/report.html").contains("is the value at air = 0"));
            assert_eq!(report["at_zero"][0]["errors"], serde_json::json!(["index"]));
        } else {
            assert!(!run.stdout.contains("is the value at"), "{run}");
            assert!(report.get("at_zero").is_none());
        }
    }
}
