//! `calibration.conf`: an arm of Universal Robots, begun from its own file, calibrated, and written back.

use crate::support::Folder;
use crate::{instrument, is_exact, said};

const FOUND: &str = "[found-over]\nq1 = [\"-2 rad\", \"2 rad\"]\nq2 = [\"-2 rad\", \"2 rad\"]\nq3 = [\"-2 rad\", \"2 rad\"]\n\
                     q4 = [\"-2 rad\", \"2 rad\"]\nq5 = [\"-2 rad\", \"2 rad\"]\nq6 = [\"-2 rad\", \"2 rad\"]\n";

/// A folder with the instrument that a file of an arm and these errors make.
fn folder(name: &str, errors: &str) -> Folder {
    let folder = Folder::new(&format!("export-ur-{name}"));
    folder.copy("cli/tests/forms/samples/ur5e.conf");
    let run = folder.trueaxis(&["init", "ur5e.conf", "--arm", "UR5e", "--out", "arm.toml"]);
    assert_eq!(run.code, 0, "{run}");
    folder.write("instrument.toml", instrument(&folder.read("arm.chain"), errors, FOUND));
    folder
}

fn exported(folder: &Folder) -> String {
    let form = ["export", "instrument.toml", "--form", "calibration.conf", "--out", "new.conf"];
    said(&folder.trueaxis(&form))
}

/// The numbers of a list.
fn list(text: &str, key: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.starts_with(key)).expect("the list");
    let inside = line.split_once('[').and_then(|(_, rest)| rest.split_once(']')).expect("a list").0;
    inside.split(',').map(|word| word.trim().parse().expect("a number")).collect()
}

#[test]
fn what_was_read_is_written_back() {
    let folder = folder("same", "q2_tilt_x = 0\n");
    let told = exported(&folder);
    assert!(told.contains("Added to the nominal sizes of a UR5e"), "{told}");
    is_exact(&told);
    let [read, written] = ["ur5e.conf", "new.conf"].map(|file| folder.read(file));
    for key in ["delta_theta", "delta_a", "delta_d", "delta_alpha"] {
        // Axes 2 to 4 are nearly parallel: where they meet, hundreds of metres away, and so the turns there, follow from rounding. What the
        // file makes of the arm is what was said above to be exact.
        let [read, written] = [&read, &written].map(|text| list(text, key));
        for joint in [0, 4] {
            assert!(
                (read[joint] - written[joint]).abs() < 1e-9,
                "{key} of joint {joint}: {read:?} {written:?}"
            );
        }
    }
}

#[test]
fn errors_of_axes_are_carried() {
    let folder =
        folder("errors", "q3_tilt_x = \"60 arcsec\"\nq4_shift_y = \"0.3 mm\"\nq5_tilt_x = \"-40 arcsec\"\n");
    let told = exported(&folder);
    is_exact(&told);
    // The file makes the same arm again.
    let run = folder.trueaxis(&["init", "new.conf", "--arm", "UR5e", "--out", "again.toml"]);
    assert_eq!(run.code, 0, "{run}");
    folder
        .write("none.toml", "")
        .write("poses.csv", "q1,q2,q3,q4,q5,q6\n0.1,-1.2,0.7,0.4,-0.9,1.3\n1.1,0.2,-0.7,1.4,0.9,-0.3\n");
    let shown = |what: &[&str]| {
        let run =
            folder.trueaxis(&[what, &["--data", "poses.csv", "--quantity", "value", "--out", "-"]].concat());
        assert_eq!(run.code, 0, "{run}");
        let cells =
            run.stdout.lines().skip(1).flat_map(|line| line.split(',').rev().take(3)).map(str::to_owned);
        cells.map(|cell| cell.parse::<f64>().expect("a number")).collect::<Vec<_>>()
    };
    let [one, other] =
        [shown(&["eval", "instrument.toml"]), shown(&["eval", "again.chain", "--errors", "none.toml"])];
    for (one, other) in one.iter().zip(&other) {
        assert!((one - other).abs() < 1e-9, "{one} {other}");
    }
}

#[test]
fn another_robot_is_refused() {
    let folder = Folder::new("export-ur-other");
    folder.copy("cli/tests/forms/samples/puma.dh.csv");
    let run = folder.trueaxis(&["init", "puma.dh.csv", "--out", "arm.toml"]);
    assert_eq!(run.code, 0, "{run}");
    // Three joints: the first lines of the ranges.
    let found: String = FOUND.split_inclusive('\n').take(4).collect();
    let errors = "q3_tilt_x = \"60 arcsec\"\n";
    folder.write("instrument.toml", instrument(&folder.read("arm.chain"), errors, &found));
    let run =
        folder.trueaxis(&["export", "instrument.toml", "--form", "calibration.conf", "--out", "new.conf"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("an arm with 6 joints that turn, and this chain has 3 joints"), "{run}");
}
