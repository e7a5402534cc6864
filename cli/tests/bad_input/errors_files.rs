//! Slips in an errors file.

use insta::assert_snapshot;

use crate::{MOUNT, mount, refused};

/// What `eval` says of an errors file.
fn of_errors(name: &str, text: &str) -> String {
    let folder = mount(name);
    folder.write("e.toml", text);
    let arguments = ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv"];
    let said = refused(&folder.trueaxis(&arguments)).to_owned();
    assert!(!folder.names().contains(&"out.csv".to_owned()), "nothing is written");
    said
}

#[test]
fn unknown_name() {
    assert_snapshot!(of_errors("e-unknown", "tilt_x = \"1 arcsec\"\ntilt_z = \"2 arcsec\"\n"));
}

#[test]
fn joint_instead_of_an_error() {
    assert_snapshot!(of_errors("e-joint", "azimuth = \"1 deg\"\n"));
}

#[test]
fn pattern_without_a_match() {
    assert_snapshot!(of_errors("e-pattern", "\"da*\" = \"1 arcsec\"\n"));
}

/// What a pattern says of angles it cannot say of lengths.
#[test]
fn pattern_over_angles_and_lengths() {
    let folder = mount("e-both");
    folder.write("mount.chain", MOUNT.replace("Rx(index)", "Rx(index), Tx(slip)"));
    folder.write("box.toml", "\"*\" = \"10 arcsec\"\n");
    assert_snapshot!(refused(&folder.trueaxis(&["bound", "mount.chain", "--sizes", "box.toml"])));
    // The line that it asks for is enough.
    folder.write("box.toml", "\"*\" = \"10 arcsec\"\nslip = \"0.1 mm\"\n");
    assert_eq!(folder.trueaxis(&["bound", "mount.chain", "--sizes", "box.toml"]).code, 0);
}

#[test]
fn a_file_of_sizes_without_any() {
    let folder = mount("e-none");
    folder.write("box.toml", "# nothing yet\n");
    let run = folder.trueaxis(&["bound", "mount.chain", "--sizes", "box.toml"]);
    assert!(refused(&run).contains("`box.toml` has no size of an error: write lines such as"), "{run}");
}

#[test]
fn errors_under_a_heading() {
    assert_snapshot!(of_errors("e-heading", "[errors]\ntilt_x = \"10 arcsec\"\n"));
}

#[test]
fn two_patterns_for_one_name() {
    assert_snapshot!(of_errors("e-two", "\"tilt*\" = \"1 arcsec\"\n\"*lt_x\" = \"2 arcsec\"\n"));
}

#[test]
fn unknown_unit() {
    assert_snapshot!(of_errors("e-unit", "tilt_x = \"1 arcsecz\"\n"));
}

#[test]
fn length_for_an_angle() {
    assert_snapshot!(of_errors("e-length", "tilt_x = \"1 mm\"\n"));
}

#[test]
fn not_a_quantity() {
    assert_snapshot!(of_errors("e-list", "tilt_x = [1, 2]\n"));
}

#[test]
fn not_finite() {
    assert_snapshot!(of_errors("e-nan", "tilt_x = nan\n"));
}

#[test]
fn not_toml() {
    assert_snapshot!(of_errors("e-toml", "tilt_x = 10 arcsec\n"));
}

#[test]
fn name_given_twice() {
    assert_snapshot!(of_errors("e-twice", "tilt_x = 1e-6\ntilt_x = 2e-6\n"));
}

#[test]
fn degrees_without_a_unit_are_remarked() {
    let folder = mount("e-bare");
    folder.write("e.toml", "tilt_x = 10\n");
    let arguments = ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "-"];
    let run = folder.trueaxis(&arguments);
    assert_eq!(run.code, 0, "{run}");
    assert_snapshot!(run.stderr);
}
