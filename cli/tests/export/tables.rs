//! Correction tables over one joint and two, and the compensation of one axis.

use crate::support::Folder;
use crate::{instrument, said};

const SLIDE: &str = "chain Slide {
    input way: direction of x;
    body carriage on ground {
        motion: Tx(x);
        motion_error: Tx(scale*x), Tx(0.5*play*way);
    }
    observe probe: point(0, 0, 0) of carriage;
}
";

const MOUNT: &str = "chain Mount {
    input face: side;
    input warm: temperature;
    body fork on ground { position_error: Rx(tilt); motion: Rz(-azimuth); motion_error: Rz(-a2*cos(2*azimuth)); }
    body tube on fork { motion: Rx(elevation); motion_error: Rz(face*collimation), Rx(drift*warm); }
    observe sight: direction(0, 1, 0) of tube;
}
";

/// The rows of a table without remarks: its header, and its numbers.
fn table(text: &str) -> (String, Vec<Vec<f64>>) {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().expect("a header").to_owned();
    let numbers = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect();
    (header, lines.map(numbers).collect())
}

#[test]
fn one_axis_is_compensated_in_both_directions() {
    let folder = Folder::new("export-iso230");
    let more = "[found-over]\nx = [\"0 m\", \"0.6 m\"]\nway = [-1.0, 1.0]\n";
    folder.write("instrument.toml", instrument(SLIDE, "scale = 20e-6\nplay = \"4 um\"", more));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "iso230", "--out", "x.csv"]);
    let said = said(&run);
    let (header, rows) = table(&folder.read("x.csv"));
    assert_eq!(
        header,
        "target [mm],deviation_up [µm],deviation_down [µm],reversal [µm],compensation_up [µm],compensation_down [µm]"
    );
    assert_eq!(rows.len(), 13);
    for row in &rows {
        // 20 µm/m, and half of the play to either side.
        let mean = 20e-3 * row[0];
        for (own, expected) in row[1..].iter().zip([mean + 2.0, mean - 2.0, 4.0, -mean - 2.0, 2.0 - mean]) {
            assert!((own - expected).abs() < 1e-5, "{row:?}");
        }
    }
    assert!(said.contains("Between the nodes go straight. That leaves nothing but rounding"), "{run}");
    assert!(
        folder
            .read("x.csv")
            .starts_with("# Corrections at 13 nodes of x. A deviation is the actual position")
    );
}

#[test]
fn a_table_says_what_its_straight_lines_leave() {
    let folder = Folder::new("export-straight");
    let chain = SLIDE
        .replace("0.5*play*way", "wave*sin(turn)")
        .replace("input way: direction of x", "input turn: angle");
    // A wave by an input is held at its middle: the table cannot follow it.
    let more = "[found-over]\nx = [\"0 m\", \"1 m\"]\nturn = [\"0 rad\", \"6.283185307179586 rad\"]\n";
    folder.write("instrument.toml", instrument(&chain, "scale = 1e-6\nwave = \"10 um\"", more));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "table", "--out", "x.csv"]);
    let said = said(&run);
    assert!(said.contains("The table holds for turn = 3.14159"), "{run}");
    let (_, left) = said.split_once("That leaves ").expect("what is left");
    let rms: f64 = left.split(' ').next().and_then(|number| number.parse().ok()).expect("a number");
    // Of a sine of 10 µm.
    assert!((rms - 10.0 / 2.0_f64.sqrt()).abs() < 0.1, "{run}");
}

#[test]
fn two_joints_and_a_side_are_one_table() {
    let folder = Folder::new("export-table");
    let more = "[found-over]\nazimuth = [\"-60 deg\", \"60 deg\"]\nelevation = [\"10 deg\", \"70 deg\"]\nface = [-1.0, 1.0]\nwarm = [10.0, 20.0]\n";
    let errors = "tilt = \"40 arcsec\"\na2 = \"20 arcsec\"\ncollimation = \"30 arcsec\"\ndrift = 1e-6";
    folder.write("instrument.toml", instrument(MOUNT, errors, more));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "table", "--out", "mount.csv"]);
    let said = said(&run);
    let (header, rows) = table(&folder.read("mount.csv"));
    assert_eq!(
        header,
        "face,azimuth [deg],elevation [deg],azimuth_correction [arcsec],elevation_correction [arcsec]"
    );
    let sides: Vec<f64> = rows.iter().map(|row| row[0]).filter(|side| *side == 1.0).collect();
    assert_eq!(2 * sides.len(), rows.len());
    for row in &rows {
        // By hand, to first order: tilt about east, a wave of the circle, collimation with the face.
        let [azimuth, elevation] = [row[1].to_radians(), row[2].to_radians()];
        let across = 40.0 * azimuth.sin() * elevation.tan() + 20.0 * (2.0 * azimuth).cos()
            - 30.0 * row[0] / elevation.cos();
        let along = 40.0 * azimuth.cos() + 15.0 * 0.206_264_8;
        assert!((row[3] - across).abs() < 0.1 && (row[4] - along).abs() < 0.1, "{row:?}: {across} {along}");
    }
    assert!(said.contains("The table holds for warm = 15, the middle of its range"), "{run}");
    // What a degree of temperature moves is left: 5/√3 K of it.
    let (_, left) = said.split_once("differs from the instrument by ").expect("a difference");
    let rms: f64 = left.split('″').next().and_then(|number| number.parse().ok()).expect("seconds");
    assert!((rms - 0.206_264_8 * 5.0 / 3.0_f64.sqrt()).abs() < 0.1, "{run}");
}

#[test]
fn more_joints_than_a_table_has_are_refused() {
    let folder = Folder::new("export-table-many");
    let chain = "chain A { body a on ground { motion: Rz(q1); } body b on a { motion: Rx(q2); } body c on b { position: Ty(1); motion: Rx(q3); \
                 motion_error: Rx(e); } observe p: point(0, 1, 0) of c; observe s: direction(1, 0, 0) of a; }\n";
    folder.write("instrument.toml", instrument(chain, "e = 1e-4", ""));
    for (form, observable, why) in [
        ("table", "p", "depends on 3 joints, and the form `table` has one or two joints"),
        ("iso230", "p", "depends on 3 joints, and the form `iso230` has one joint"),
    ] {
        let run = folder.trueaxis(&[
            "export",
            "instrument.toml",
            "--form",
            form,
            "--observable",
            observable,
            "--out",
            "a",
        ]);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(why), "{run}");
    }
    folder.write(
        "instrument.toml",
        instrument(SLIDE, "scale = 1e-6", "[found-over]\nx = [\"1 m\", \"1 m\"]\nway = [-1.0, 1.0]\n"),
    );
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "table", "--out", "a"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("was measured at one place alone"), "{run}");
}
