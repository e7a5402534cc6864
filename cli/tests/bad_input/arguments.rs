//! Slips on the command line.

use insta::assert_snapshot;

use crate::{mount, refused};

/// What `simulate` says when these are added to what it needs.
fn simulate(name: &str, more: &[&str]) -> String {
    let folder = mount(name);
    let mut arguments = vec!["simulate", "mount.chain", "--errors", "e.toml", "--seed", "1", "--out", "-"];
    if !more.contains(&"--poses") {
        arguments.extend(["--poses", "3"]);
    }
    arguments.extend(more);
    refused(&folder.trueaxis(&arguments)).to_owned()
}

#[test]
fn no_command() {
    let run = crate::support::trueaxis(&[]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("calibrate"), "the commands are listed: {run}");
}

#[test]
fn misspelt_command() {
    assert_snapshot!(refused(&crate::support::trueaxis(&["derve", "x.chain"])));
}

#[test]
fn order_out_of_range() {
    let run = crate::support::trueaxis(&["derive", "x.chain", "--order", "4"]);
    assert_snapshot!(refused(&run));
}

#[test]
fn unknown_joint_in_a_range() {
    assert_snapshot!(simulate("a-joint", &["--noise", "1 arcsec", "--range", "elevaton=0 deg..80 deg"]));
}

#[test]
fn range_the_wrong_way_round() {
    assert_snapshot!(simulate("a-swapped", &["--noise", "1 arcsec", "--range", "elevation=80..10 deg"]));
}

#[test]
fn range_that_is_none() {
    assert_snapshot!(simulate("a-range", &["--noise", "1 arcsec", "--range", "elevation=80 deg"]));
}

#[test]
fn range_with_a_length() {
    assert_snapshot!(simulate("a-length", &["--noise", "1 arcsec", "--range", "elevation=10 mm..20 mm"]));
}

#[test]
fn noise_of_the_wrong_kind() {
    assert_snapshot!(simulate("a-noise", &["--noise", "1 mm"]));
}

#[test]
fn negative_noise() {
    assert_snapshot!(simulate("a-negative", &["--noise", "-1 arcsec"]));
}

#[test]
fn no_poses() {
    assert_snapshot!(simulate("a-poses", &["--noise", "1 arcsec", "--poses", "0"]));
}
