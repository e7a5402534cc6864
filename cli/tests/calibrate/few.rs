//! Few rows: what they say of their noise is little, and nothing where the fit runs through them.

use serde_json::Value;

use crate::figures::simulate_pan;
use crate::support::Folder;

const PAN: &str = "chain Pan {
    body base on ground { motion: Rz(pan); motion_error: Rz(index); }
    body tube on base { motion: Rx(tilt); motion_error: Rx(sag); }
    observe sight: direction(0, 1, 0) of tube;
}";

/// The kinds of caution on so many poses, with noise of this size beside 5 arcsec that are stated.
fn cautions(folder: &Folder, poses: usize, noise: &str, seed: usize) -> Vec<String> {
    simulate_pan(folder, poses, noise, seed, &[]);
    let run = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let cautions = report["cautions"].as_array().expect("a list");
    cautions.iter().map(|caution| caution["kind"].as_str().expect("a text").to_owned()).collect()
}

#[test]
fn one_to_three_rows_say_nothing_against_what_is_stated() {
    let folder = Folder::new("few");
    folder.write("pan.chain", PAN).write("errors.toml", "index = \"30 arcsec\"\nsag = \"20 arcsec\"\n").write(
        "study.toml",
        "chain = \"pan.chain\"\ndata = \"data.csv\"\n[observed]\nkind = \"direction\"\n[noise]\nsigma = \"5 arcsec\"\n",
    );
    for poses in 1..=3 {
        for seed in 1..=8 {
            let told = cautions(&folder, poses, "5 arcsec", seed);
            assert!(told.is_empty(), "{poses} poses, seed {seed}: {told:?}");
        }
    }
    // Where rows can say it, they do.
    assert_eq!(cautions(&folder, 20, "1 arcsec", 1), ["stated uncertainties too large"]);
    assert_eq!(cautions(&folder, 8, "20 arcsec", 1), ["noise exceeds stated"]);
    assert!(cautions(&folder, 3, "0", 1).contains(&"residual is rounding".to_owned()));
}

#[test]
fn a_dry_run_says_where_nothing_would_change() {
    let folder = Folder::new("few-dry-run");
    folder.write("pan.chain", PAN).write("errors.toml", "index = \"30 arcsec\"\nsag = \"20 arcsec\"\n");
    folder.write(
        "study.toml",
        "chain = \"pan.chain\"\ndata = \"data.csv\"\n[observed]\nkind = \"direction\"\n",
    );
    assert!(cautions(&folder, 40, "5 arcsec", 1).is_empty());
    let run = folder.trueaxis(&["calibrate", "study.toml", "--dry-run"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{run}");
    assert!(run.stderr.contains("the declaration would not change"), "{run}");
}
