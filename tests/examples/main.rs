//! The example programs run, and print what their reader should see.

use std::path::PathBuf;
use std::process::Command;

/// What an example prints. `cargo test` builds the examples before it runs any test; with a suite chosen by
/// `--test` they must have been built before.
#[track_caller]
fn printed(example: &str) -> String {
    let own = std::env::current_exe().expect("a test has a path");
    let folder: PathBuf = own.ancestors().nth(2).expect("a test lies in deps").join("examples");
    let program = folder.join(format!("{example}{}", std::env::consts::EXE_SUFFIX));
    assert!(program.exists(), "{} is not there: run `cargo build --examples` first", program.display());
    let output = Command::new(program).output().expect("the example starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn mobile_lidar() {
    insta::assert_snapshot!(printed("mobile-lidar"));
}

#[test]
fn alt_azimuth() {
    insta::assert_snapshot!(printed("alt-azimuth"));
}

#[test]
fn six_joint_arm() {
    insta::assert_snapshot!(printed("six-joint-arm"));
}
