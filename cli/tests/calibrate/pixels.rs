//! Corners of a board in the image of a camera on a pan-tilt head. `examples/pixels/simulate.py`, which shares no code with ours, made them
//! and fitted the same numbers with SciPy.

use crate::figures::{calibrated, cautions, error, first_effect, holds};
use crate::support::{Folder, run_in};

/// What SciPy's least squares finds at the same corners: beside 800, 800, 320 and 240 pixels, and rad.
const BY_SCIPY: [(&str, f64); 9] = [
    ("tilt_index", 0.002_048_57),
    ("dfx", 12.100),
    ("dfy", 8.517),
    ("dcx", 2.402),
    ("dcy", -3.866),
    ("k1", -0.211_31),
    ("k2", 0.065_62),
    ("p1", 0.000_824),
    ("p2", -0.000_512),
];

fn example(name: &str) -> Folder {
    let folder = Folder::new(name);
    for file in ["head.chain", "corners.toml", "corners.csv"] {
        folder.copy(&format!("examples/pixels/{file}"));
    }
    folder
}

/// Rows far off count less here, so the two differ by parts of the ±.
#[test]
fn a_camera_is_calibrated_as_least_squares_does() {
    let report = calibrated(&example("pixels"), "corners.toml");
    assert_eq!(report["unit"], "px");
    assert_eq!(report["effects"].as_array().map(Vec::len), Some(0), "{}", report["effects"]);
    for (name, other) in BY_SCIPY {
        let [value, uncertainty] = error(&report, name);
        assert!((value - other).abs() < 0.5 * uncertainty, "{name}: {value} ± {uncertainty}, {other}");
    }
    // The noise is 0.1 pixels in each direction.
    let held_out = report["after"]["held_out_rms"].as_f64().expect("a number");
    assert!((held_out / (2.0_f64.sqrt() * 0.1) - 1.0).abs() < 0.05, "{held_out}");
}

#[test]
fn a_corner_behind_the_camera_is_told_with_its_row() {
    let folder = example("pixels behind");
    let rows = folder.read("corners.csv").replacen(",1,", ",-1,", 1);
    folder.write("corners.csv", &rows);
    let run = run_in(&folder.0, &["calibrate", "corners.toml", "--out", "report"], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("line 2, row 1") && run.stderr.contains("behind it"), "{run}");
}

/// A sheet that was glued beside the axis, and the degrees that are printed on it: `examples/phone-lab/simulate.py`, which shares no code
/// with ours, planted both by one shift.
#[test]
fn a_phone_finds_the_sheet_and_the_dial_off_centre() {
    let folder = Folder::new("phone lab");
    for file in ["table.chain", "lab.toml", "marks.csv"] {
        folder.copy(&format!("examples/phone-lab/{file}"));
    }
    let report = calibrated(&folder, "lab.toml");
    assert!(cautions(&report, "residual out of place").is_empty(), "{}", report["cautions"]);
    assert!(first_effect(&report).contains("encoder eccentricity of alpha"), "{}", first_effect(&report));
    let planted = [("sheet_x", 1.6e-3), ("sheet_y", -1.4e-3), ("df", 12.0), ("phone_x", 6e-3)];
    holds(&report, &planted);
    // A circle of 90 mm whose centre is aside by that much misreads by their ratio.
    holds(&report, &[("ecc_sin_alpha", -1.6 / 90.0), ("ecc_cos_alpha", 1.4 / 90.0)]);
    // Half a pixel in each direction.
    let held_out = report["after"]["held_out_rms"].as_f64().expect("a number");
    assert!((held_out / (2.0_f64.sqrt() * 0.5) - 1.0).abs() < 0.1, "{held_out}");
}

/// Pixels that belong to other rows leave residuals as large as the picture.
#[test]
fn pixels_of_other_rows_are_out_of_place() {
    let folder = example("pixels elsewhere");
    let text = folder.read("corners.csv");
    let (header, rows) = text.split_once('\n').expect("a header");
    let split = |line: &str| {
        let (rest, v) = line.rsplit_once(',').expect("v");
        let (readings, u) = rest.rsplit_once(',').expect("u");
        (readings.to_owned(), format!("{u},{v}"))
    };
    let rows: Vec<(String, String)> = rows.lines().map(split).collect();
    let mixed: String =
        (0..rows.len()).map(|row| format!("{},{}\n", rows[row].0, rows[row * 101 % rows.len()].1)).collect();
    folder.write("corners.csv", format!("{header}\n{mixed}"));
    let run = run_in(&folder.0, &["calibrate", "corners.toml", "--format", "json"], "");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(cautions(&report, "residual out of place").len(), 1, "{}", report["cautions"]);
}

#[test]
fn pixels_are_not_simulated() {
    let folder = example("pixels simulated");
    folder.write("errors.toml", "dfx = 1.0\n");
    let asked =
        ["--errors", "errors.toml", "--noise", "1 arcsec", "--poses", "3", "--seed", "1", "--out", "-"];
    let run = folder.trueaxis(&[&["simulate", "head.chain"], &asked[..]].concat());
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("shows pixels"), "{run}");
}
