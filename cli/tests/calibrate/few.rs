//! Few rows: what they say of their noise is little, and nothing where the fit runs through them.

use serde_json::Value;

use crate::figures::simulate_pan;
use crate::room::{Room, STUDY, TRACKER};
use crate::support::Folder;
use testkit::Random;

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
    kinds(&report)
}

fn kinds(report: &Value) -> Vec<String> {
    let cautions = report["cautions"].as_array().expect("a list");
    cautions.iter().map(|caution| caution["kind"].as_str().expect("a text").to_owned()).collect()
}

const HARDLY: &str = "hardly more numbers than unknowns";
const BADLY: &str = "held-out data foretold badly";

#[test]
fn one_to_three_rows_say_nothing_against_what_is_stated() {
    let folder = Folder::new("few");
    folder.write("pan.chain", PAN).write("errors.toml", "index = \"30 arcsec\"\nsag = \"20 arcsec\"\n").write(
        "study.toml",
        "chain = \"pan.chain\"\ndata = \"data.csv\"\n[observed]\nkind = \"direction\"\n[noise]\nsigma = \"5 arcsec\"\n",
    );
    for poses in 1..=3 {
        for seed in 1..=8 {
            let mut told = cautions(&folder, poses, "5 arcsec", seed);
            told.retain(|kind| kind != HARDLY);
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

const MOUNT: &str = "chain Mount {
    body azimuth_axis on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
        motion_error: Rz(azimuth_index);
    }
    body elevation_axis on azimuth_axis {
        position_error: Ry(nonperpendicularity);
        motion: Rx(elevation);
        motion_error: Rx(elevation_index);
    }
    body telescope on elevation_axis { position_error: Rz(collimation); }
    observe pointing: direction(0, 1, 0) of telescope;
    observe tip: point(0, 1, 0) of telescope;
}";

/// What somebody measured with a mount that has a collimation error of 30 arcsec, worked out by hand: azimuth, elevation, x, y and z, with
/// noise of 2 arcsec, or 10 µm of a point at 1 m.
fn rows(count: usize, seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut table = "azimuth,elevation,x,y,z\n".to_owned();
    for _ in 0..count {
        let (azimuth, elevation) = (6.0 * random.even() - 3.0, 0.2 + random.even());
        let mut noise = || 1e-5 * random.normal();
        // The line of sight in the telescope is turned about z, lifted by the elevation, and turned by the azimuth.
        let (across, along) = (30.0 * std::f64::consts::PI / 648_000.0_f64).sin_cos();
        let (level, up) = (along * elevation.cos(), along * elevation.sin());
        let x = -across * azimuth.cos() + level * azimuth.sin();
        let y = across * azimuth.sin() + level * azimuth.cos();
        let [x, y, z] = [x + noise(), y + noise(), up + noise()];
        table.push_str(&format!("{azimuth},{elevation},{x},{y},{z}\n"));
    }
    table
}

/// The first screen and the report of so many rows.
fn calibrated(name: &str, kind: &str, count: usize, seed: u64) -> (String, Value) {
    let folder = Folder::new(&format!("few-{name}-{count}-{seed}"));
    let observable = if kind == "point" { "tip" } else { "pointing" };
    let study = format!(
        "chain = \"mount.chain\"\nobservable = \"{observable}\"\ndata = \"data.csv\"\n[observed]\nkind = \"{kind}\"\n\
         x = \"x\"\ny = \"y\"\nz = \"z\"\n"
    );
    folder.write("mount.chain", MOUNT).write("data.csv", rows(count, seed)).write("study.toml", &study);
    let shown = folder.trueaxis(&["calibrate", "study.toml"]);
    let json = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    (shown.stdout, serde_json::from_str(&json.stdout).unwrap_or_else(|_| panic!("{json}")))
}

const CORRECT: &str = "Correct with it now";
const MORE: &str = "1. Measure more before you correct with it.";

#[test]
fn where_hardly_a_number_is_left_over_nobody_is_told_to_correct() {
    for seed in 1..=3 {
        for (kind, count, numbers) in [("point", 3, 9), ("direction", 4, 8)] {
            let (shown, report) = calibrated("hardly", kind, count, seed);
            assert!(!shown.contains(CORRECT) && shown.contains(MORE), "{shown}");
            let why = format!("{numbers} measured numbers for 6 unknowns are too few");
            let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(words.contains(&why) && words.contains("Add at least"), "{shown}");
            assert!(kinds(&report).contains(&HARDLY.to_owned()), "{shown}");
            assert!(!shown.contains("NOTHING MISSING FOUND") && shown.contains("NOT ENOUGH DATA"), "{shown}");
        }
    }
}

#[test]
fn where_single_rows_decide_nobody_is_told_to_correct() {
    let mut told = 0;
    for seed in 1..=6 {
        let (shown, report) = calibrated("decide", "point", 4, seed);
        let rms = |key: &str| report["after"][key].as_f64().expect("a number");
        let is_bad = rms("held_out_rms")
            > 5.0 * rms("rms").max(report["noise"]["expected_rms"].as_f64().expect("a number"));
        told += usize::from(is_bad);
        assert_eq!(kinds(&report).contains(&BADLY.to_owned()), is_bad, "{shown}");
        assert_eq!(shown.contains(MORE), is_bad, "{shown}");
        assert_eq!(shown.contains(CORRECT), !is_bad, "{shown}");
    }
    assert!(told > 0, "no seed has rows that decide alone");
}

#[test]
fn enough_rows_are_corrected_with() {
    for (kind, count) in [("point", 30), ("direction", 30)] {
        let (shown, report) = calibrated("enough", kind, count, 1);
        assert!(shown.contains(CORRECT) && !shown.contains(MORE), "{shown}");
        assert!(kinds(&report).is_empty(), "{shown}");
    }
}

/// How many observations more are asked for, if there are too few.
fn asked_for(shown: &str) -> Option<usize> {
    let words: Vec<&str> = shown.split_whitespace().collect();
    let at = words.windows(2).position(|two| two == ["At", "least"])?;
    shown.starts_with("NOT ENOUGH DATA").then(|| words[at + 2].parse().expect("a number"))
}

/// Who measures as many more as are asked for is not asked again.
#[test]
fn as_many_as_are_asked_for_are_enough() {
    for (kind, count) in [("direction", 1), ("direction", 2), ("direction", 3)] {
        let (shown, _) = calibrated("asked", kind, count, 7);
        let more = asked_for(&shown).unwrap_or_else(|| panic!("{kind} {count}: {shown}"));
        let (shown, report) = calibrated("asked", kind, count + more, 7);
        assert_eq!(asked_for(&shown), None, "{shown}");
        assert!(!kinds(&report).contains(&HARDLY.to_owned()), "{kind} {count} and {more}: {shown}");
    }
}

/// Beside targets and stations that nobody knows, too, whose numbers count.
#[test]
fn as_many_as_are_asked_for_beside_unknown_objects_are_enough() {
    let folder = Folder::new("few-objects");
    let chain = TRACKER.replace("longer*range", "range_zero");
    let circle = "motion: Rz(-azimuth); motion_error: Rz(once_cos*cos(azimuth) + once_sin*sin(azimuth));";
    let chain = chain.replace("motion: Rz(-azimuth);", circle);
    folder.write("tracker.chain", chain).write("study.toml", STUDY);
    let random = &mut Random::new(5);
    let all = Room::new(random).rows(random, 0.0);
    // Three targets in one face; what is asked for is measured of them in the other.
    let rows: Vec<&str> = all.lines().collect();
    let is_few = |row: &&&str| ["T0", "T1", "T2"].iter().any(|target| row.split(',').nth(1) == Some(target));
    let few: Vec<&str> = rows[1..].iter().filter(is_few).copied().collect();
    let table = |more: usize| {
        let one = few.iter().step_by(2).chain(few.iter().skip(1).step_by(2).take(more));
        [rows[0]].into_iter().chain(one.copied()).map(|row| format!("{row}\n")).collect::<String>()
    };
    let mut more = 0;
    let mut asked = 0;
    while asked < 4 {
        folder.write("rows.csv", table(more));
        let shown = folder.trueaxis(&["calibrate", "study.toml"]).stdout;
        match asked_for(&shown) {
            Some(others) => more += others,
            None => {
                assert!(asked > 0, "{shown}");
                break;
            }
        }
        asked += 1;
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("21 numbers of objects and stations"), "{shown}");
        assert!(words.contains("of the same objects and from the same stations"), "{shown}");
    }
    assert_eq!(asked, 1, "{more}");
}
