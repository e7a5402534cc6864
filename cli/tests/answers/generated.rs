//! Generated evaluators as files.

use crate::support::Folder;
use crate::{LIDAR, answered};

#[test]
fn the_file_holds_the_declaration_and_the_bound() {
    let folder = Folder::new("generate-rust");
    let out = folder.0.join("lidar.rs");
    let sizes = "examples/mobile-lidar/box.toml";
    let arguments = ["generate", LIDAR, "--language", "rust", "--observable", "pointing", "--errors", sizes];
    answered(&[arguments.as_slice(), &["--out", out.to_str().expect("UTF-8")]].concat());
    let text = folder.read("lidar.rs");
    assert!(text.contains("chain MobileLidar {"), "the declaration is quoted");
    assert!(
        text.contains("First order, pointing: off by at most 1.065e-7 while errors stay within box.toml")
    );
    assert_eq!(folder.names(), ["lidar.rs"]);
}
