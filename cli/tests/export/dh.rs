//! Tables of Denavit and Hartenberg: of an arm that is declared so, and of one that is not.

use std::fmt::Write as _;

use crate::support::Folder;
use crate::{instrument, is_exact, said};

/// The sizes of a UR5, by which the second and third axes are parallel, and the fourth.
const D: [f64; 6] = [0.089_159, 0.0, 0.0, 0.109_15, 0.094_65, 0.0823];
const A: [f64; 6] = [0.0, -0.425, -0.392_25, 0.0, 0.0, 0.0];
const ALPHA: [&str; 6] = ["pi/2", "0", "0", "pi/2", "-pi/2", "0"];

/// An arm as `init` declares one.
fn arm() -> String {
    let mut text = "chain Arm {\n    const reach: length = 0.1;\n".to_owned();
    let mut lower = "ground".to_owned();
    for at in 0..6 {
        let number = at + 1;
        let _ = write!(
            text,
            "    body joint{number} on {lower} {{ motion: Rz(q{number}); motion_error: Rz(dq{number}); }}\n    \
             body link{number} on joint{number} {{\n        position: Tz({:?}), Tx({:?}), Rx({});\n        \
             position_error: Tz(dd{number}), Tx(da{number}), Rx(dalpha{number}), Ry(dbeta{number}), Rz(wave{number}*sin(q{number}));\n    }}\n",
            D[at], A[at], ALPHA[at]
        );
        lower = format!("link{number}");
    }
    text + "    observe tip: point(0, 0, reach) of link6;\n}\n"
}

/// Link, parameter, and nominal, correction and calibrated value of each row.
fn rows(text: &str) -> Vec<(String, String, [f64; 3])> {
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |at: usize| cells[at].parse().expect("a number");
        (cells[0].to_owned(), cells[1].to_owned(), [number(3), number(4), number(5)])
    });
    rows.collect()
}

fn exported(
    folder: &Folder,
    chain: &str,
    errors: &str,
    more: &str,
) -> (String, Vec<(String, String, [f64; 3])>) {
    folder.write("instrument.toml", instrument(chain, errors, more));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "dh", "--out", "arm.csv"]);
    (said(&run), rows(&folder.read("arm.csv")))
}

#[test]
fn an_arm_that_is_declared_so_has_its_own_sizes_and_corrections() {
    let folder = Folder::new("export-dh");
    let errors =
        "dd1 = \"0.2 mm\"\nda2 = \"-0.3 mm\"\ndalpha1 = \"20 arcsec\"\ndq3 = \"40 arcsec\"\nda3 = \"0.1 mm\"";
    let (said, rows) = exported(&folder, &arm(), errors, "");
    let value = |link: &str, parameter: &str| {
        rows.iter()
            .find(|row| row.0 == link && row.1 == parameter)
            .unwrap_or_else(|| panic!("{link} {parameter}: {rows:?}"))
            .2
    };
    for at in 0..5 {
        let link = format!("{}:q{}", at + 1, at + 1);
        assert!((value(&link, "d")[0] - D[at]).abs() < 1e-12, "{rows:?}");
        assert!((value(&link, "a")[0] - A[at]).abs() < 1e-12, "{rows:?}");
    }
    // Behind a turn by alpha a shift along z is one along the next axis. The axes from there on are parallel, and one of them has it.
    assert!((value("4:q4", "d")[1] - 2e-4).abs() < 1e-9, "{rows:?}");
    assert!((value("2:q2", "a")[1] + 3e-4).abs() < 1e-9, "{rows:?}");
    assert!((value("1:q1", "alpha")[1] - 20.0 / 206_264.806).abs() < 1e-9, "{rows:?}");
    assert!((value("3:q3", "theta")[1] - 40.0 / 206_264.806).abs() < 1e-7, "{rows:?}");
    assert!(said.contains("nearly parallel to that of `2:q2`, `3:q3`"), "{said}");
    assert!(said.contains("The form carries every error"), "{said}");
    is_exact(&said);
}

/// The second axis out of parallel to the third by a second: a common normal would lie hundreds of metres away.
#[test]
fn no_frame_goes_far_away() {
    let folder = Folder::new("export-dh-parallel");
    let (said, rows) = exported(
        &folder,
        &arm(),
        "dbeta2 = \"60 arcsec\"\ndalpha2 = \"-5 arcsec\"\ndalpha3 = \"30 arcsec\"",
        "",
    );
    for (link, parameter, [_, correction, _]) in &rows {
        assert!(correction.abs() < 1e-3, "{link} {parameter}: {correction}");
    }
    let beta = rows.iter().find(|row| row.0 == "2:q2" && row.1 == "beta").expect("a turn about y");
    assert!((beta.2[1] - 60.0 / 206_264.806).abs() < 1e-8, "{rows:?}");
    is_exact(&said);
}

#[test]
fn what_follows_a_reading_is_not_carried() {
    let folder = Folder::new("export-dh-lost");
    let (said, _) = exported(&folder, &arm(), "wave2 = \"100 arcsec\"\ndq1 = \"10 arcsec\"", "");
    assert!(said.contains("cannot carry these errors") && said.contains("wave2"), "{said}");
}

/// Axes about x and y, and readings that count the other way.
#[test]
fn a_chain_that_is_declared_otherwise_is_a_table_too() {
    let folder = Folder::new("export-dh-other");
    let chain = "chain Gantry {
    body column on ground { position: Tx(0.3); position_error: Ty(foot); motion: Rz(-turn + pi/3); motion_error: Tz(lift); }
    body shoulder on column { position: Tz(0.5), Ty(0.1); position_error: Ry(skew), Rz(yaw); motion: Rx(raise); }
    body slide on shoulder { position: Tx(0.05); position_error: Rx(droop); motion: Ty(reach); }
    body hand on slide { position: Ty(0.2), Tx(0.06); position_error: Rx(hang), Tx(beside); motion: Ry(roll); }
    observe tip: point(0.01, 0.02, 0.03) of hand;
}
";
    let errors = "foot = \"1 mm\"\nlift = \"-2 mm\"\nskew = \"30 arcsec\"\nyaw = \"-50 arcsec\"\ndroop = \"100 arcsec\"\nhang = \"20 arcsec\"\nbeside = \"0.4 mm\"";
    let (said, rows) = exported(
        &folder,
        chain,
        errors,
        "[found-over]\nreach = [\"0 m\", \"0.6 m\"]\nraise = [\"-30 deg\", \"70 deg\"]\n",
    );
    assert!(rows.iter().all(|row| row.2[1].abs() < 1e-2), "{rows:?}");
    is_exact(&said);
    // ± of the shift of the foot, which is that of the base.
    let more = "[found-over]\nreach = [\"0 m\", \"0.6 m\"]\n[covariance]\nof = [\"foot\"]\nrows = [[4e-8]]\n";
    exported(&folder, chain, errors, more);
    let text = folder.read("arm.csv");
    let line = text.lines().find(|line| line.starts_with("base,y,")).expect("a row");
    let uncertainty: f64 = line.rsplit(',').next().and_then(|cell| cell.parse().ok()).expect("a number");
    assert!((uncertainty - 2e-4).abs() < 1e-9, "{line}");
}

#[test]
fn what_is_no_such_chain_is_refused() {
    let folder = Folder::new("export-dh-refused");
    for (chain, why) in [
        (
            "chain A { body a on ground { motion: Rz(q1); } body b on a { position: Tz(1); motion: Rz(q2); motion_error: Rx(e); } observe p: point(1, 0, 0) of b; }\n",
            "the axes of `q1` and `q2` lie in one line",
        ),
        (
            "chain A { body a on ground { motion: Rz(2*q1); motion_error: Rx(e); } observe p: point(1, 0, 0) of a; }\n",
            "moves by another amount than its reading",
        ),
        (
            "chain A { body a on ground { motion: Rz(q1 + q2); motion_error: Rx(e); } observe p: point(1, 0, 0) of a; }\n",
            "a move by several readings is no joint",
        ),
        (
            "chain A { body a on ground { position_error: Rx(e); } observe p: point(1, 0, 0) of a; }\n",
            "no joint on the way",
        ),
    ] {
        folder.write("instrument.toml", instrument(chain, "e = 1e-4", ""));
        let run = folder.trueaxis(&["export", "instrument.toml", "--form", "dh", "--out", "arm.csv"]);
        assert_eq!(run.code, 2, "{why}: {run}");
        assert!(run.stderr.contains(why), "{why}: {run}");
    }
}
