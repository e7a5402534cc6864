//! Slips in a data file.

use insta::assert_snapshot;

use crate::{mount, refused};

/// What `eval` says of a data file.
fn of_data(name: &str, text: impl AsRef<[u8]>) -> String {
    let folder = mount(name);
    folder.write("poses.csv", text);
    let arguments = ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv"];
    let said = refused(&folder.trueaxis(&arguments)).to_owned();
    assert!(!folder.names().iter().any(|name| name.contains("out.csv")), "nothing is left behind");
    said
}

#[test]
fn missing_column() {
    assert_snapshot!(of_data("d-missing", "azimuth [deg],elevatoin [deg]\n10,20\n"));
}

#[test]
fn cell_that_is_no_number() {
    assert_snapshot!(of_data("d-number", "azimuth [deg],elevation [deg]\n10,20\n30,4o\n"));
}

#[test]
fn not_a_number() {
    assert_snapshot!(of_data("d-nan", "azimuth [deg],elevation [deg]\n10,20\nNaN,40\n"));
}

#[test]
fn empty_cell() {
    assert_snapshot!(of_data("d-cell", "azimuth [deg],elevation [deg]\n10,20\n,40\n"));
}

#[test]
fn ragged_row() {
    assert_snapshot!(of_data("d-ragged", "azimuth [deg],elevation [deg]\n10,20,30\n"));
}

#[test]
fn empty_file() {
    assert_snapshot!(of_data("d-empty", ""));
}

#[test]
fn header_alone() {
    assert_snapshot!(of_data("d-header", "azimuth [deg],elevation [deg]\n"));
}

#[test]
fn length_for_an_angle() {
    assert_snapshot!(of_data("d-unit", "azimuth [mm],elevation [deg]\n10,20\n"));
}

#[test]
fn no_text_at_all() {
    assert_snapshot!(of_data("d-binary", [0xff, 0xfe, 0x00, 0x01]));
}

#[test]
fn file_that_is_not_there() {
    let folder = mount("d-not-there");
    let arguments = ["eval", "mount.chain", "--errors", "e.toml", "--data", "pose.csv", "--out", "out.csv"];
    assert_snapshot!(refused(&folder.trueaxis(&arguments)));
}

#[test]
fn folder_that_is_not_there() {
    let folder = mount("d-no-folder");
    let arguments =
        ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "results/out.csv"];
    assert_snapshot!(refused(&folder.trueaxis(&arguments)));
}

#[cfg(not(feature = "parquet"))]
#[test]
fn format_that_is_not_built_in() {
    let folder = mount("d-format");
    let arguments =
        ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.parquet", "--out", "out.csv"];
    assert_snapshot!(refused(&folder.trueaxis(&arguments)));
}

#[cfg(not(feature = "point-clouds"))]
#[test]
fn point_clouds_that_are_not_built_in() {
    let folder = mount("d-cloud");
    folder.write("cloud.laz", b"LASF");
    let arguments = ["apply", "mount.chain", "--errors", "e.toml", "--data", "cloud.laz", "--out", "out.laz"];
    assert_snapshot!(refused(&folder.trueaxis(&arguments)));
}

#[test]
fn an_option_of_point_clouds_with_a_table() {
    let folder = mount("d-cloud-option");
    let arguments = [
        "apply",
        "mount.chain",
        "--errors",
        "e.toml",
        "--data",
        "poses.csv",
        "--readings",
        "r.csv",
        "--out",
        "-",
    ];
    assert_snapshot!(refused(&folder.trueaxis(&arguments)));
}
