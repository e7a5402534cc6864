//! Whatever is wrong with what a user gives, the message says what, where, and what to write instead; exit code 2.
//!
//! Each test is one slip of a careful person; the snapshots are the messages that he reads.

#[path = "../support/mod.rs"]
mod support;

mod arguments;
mod data;
mod declarations;
mod errors_files;
mod wrong_file;

use support::{Folder, Run};

/// Asserts a refusal, and gives what the user reads.
fn refused(run: &Run) -> &str {
    assert_eq!(run.code, 2, "{run}");
    assert_eq!(run.stdout, "", "nothing goes to standard output before a refusal");
    &run.stderr
}

/// A mount whose declaration is right.
const MOUNT: &str = "chain Mount {
    body fork on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
    }
    body tube on fork {
        motion: Rx(elevation);
        motion_error: Rx(index);
    }
    observe pointing: direction(0, 1, 0) of tube;
}
";

/// A folder with the mount, its errors and two poses.
fn mount(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("mount.chain", MOUNT);
    folder.write("e.toml", "tilt_x = \"10 arcsec\"\n\"*\" = \"2 arcsec\"\n");
    folder.write("poses.csv", "azimuth [deg],elevation [deg]\n10,20\n30,40\n");
    folder
}
