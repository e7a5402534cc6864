//! Slips in a declaration.

use insta::assert_snapshot;

use crate::support::{Folder, trueaxis};
use crate::{MOUNT, refused};

/// What `derive` says of the mount with one place changed.
fn changed(name: &str, from: &str, to: &str) -> String {
    assert_ne!(from, to);
    assert!(MOUNT.contains(from), "{from}");
    of_text(name, &MOUNT.replacen(from, to, 1))
}

fn of_text(name: &str, text: &str) -> String {
    let folder = Folder::new(name);
    folder.write("mount.chain", text);
    refused(&folder.trueaxis(&["derive", "mount.chain"])).to_owned()
}

#[test]
fn unknown_body() {
    assert_snapshot!(changed("unknown-body", "on fork", "on frok"));
}

#[test]
fn unknown_axis() {
    assert_snapshot!(changed("unknown-axis", "Rz(-azimuth)", "Rw(-azimuth)"));
}

#[test]
fn name_declared_twice() {
    assert_snapshot!(changed("declared-twice", "body tube on", "body fork on"));
}

#[test]
fn body_on_itself() {
    assert_snapshot!(changed("on-itself", "body tube on fork", "body tube on tube"));
}

#[test]
fn all_mistakes_at_once() {
    let text = MOUNT
        .replace("Rz(-azimuth)", "Rw(-azimuth)")
        .replace("on fork", "on frok")
        .replace("of tube", "of tub")
        .replace("motion_error", "motion_eror");
    assert_snapshot!(of_text("all-at-once", &text));
}

#[test]
fn unbalanced_bracket() {
    assert_snapshot!(changed("unbalanced", "Rx(tilt_x)", "Rx(tilt_x"));
}

#[test]
fn missing_comma() {
    assert_snapshot!(changed("comma", "Rx(tilt_x), Ry", "Rx(tilt_x) Ry"));
}

#[test]
fn empty_file() {
    assert_snapshot!(of_text("empty-chain", ""));
}

#[test]
fn only_comments() {
    assert_snapshot!(of_text("only-comments", "// nothing yet\n"));
}

#[test]
fn no_text_at_all() {
    let folder = Folder::new("binary-chain");
    folder.write("mount.chain", [0xff, 0xfe, 0x00, 0x01]);
    assert_snapshot!(refused(&folder.trueaxis(&["derive", "mount.chain"])));
}

#[test]
fn a_table_instead_of_a_declaration() {
    let run = trueaxis(&["derive", "examples/mobile-lidar/study.toml"]);
    assert_snapshot!(refused(&run));
}

#[test]
fn file_that_is_not_there() {
    let run = trueaxis(&["derive", "examples/mobile-lidar/mobile-lida.chain"]);
    assert_snapshot!(refused(&run));
}

#[test]
fn folder_instead_of_a_file() {
    assert_snapshot!(refused(&trueaxis(&["derive", "examples/mobile-lidar"])));
}

#[test]
fn unknown_observable() {
    let run = trueaxis(&["derive", "examples/mobile-lidar/mobile-lidar.chain", "--observable", "pointng"]);
    assert_snapshot!(refused(&run));
}
