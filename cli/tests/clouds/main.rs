//! `trueaxis apply` on point clouds: coordinates as NumPy has them, every other byte as it came, and clear words for what cannot be
//! corrected. The clouds in `reference/` were written by `reference/write.py`, with LASzip.

#![cfg(feature = "point-clouds")]

#[path = "../support/mod.rs"]
mod support;

mod attacked;
mod by_time;
mod kept;
mod many;
mod spoiled;
mod whole;
mod wrong;

use std::fs;
use std::path::PathBuf;

use support::{Folder, Run};

/// A file beside the tests.
fn reference(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/clouds/reference").join(name)
}

/// The bytes of a file beside the tests.
fn bytes(name: &str) -> Vec<u8> {
    fs::read(reference(name)).expect("a file beside the tests")
}

/// Where points belong, in steps of the file, as NumPy has them.
fn steps(name: &str) -> Vec<[f64; 3]> {
    let text = String::from_utf8(bytes(&format!("{name}.steps"))).expect("numbers");
    let line = |line: &str| -> Vec<f64> {
        line.split(' ').map(|number| number.parse().expect("a number")).collect()
    };
    text.lines().map(|text| line(text).try_into().expect("x, y and z")).collect()
}

/// Points are where they belong: to the nearest step where their readings are as fine as can be, and otherwise as near as a
/// coordinate that was rounded, moved, and rounded again.
fn assert_steps(name: &str, found: &[[i32; 3]], expected: &[[f64; 3]]) {
    let within = if ["v12f3", "v14f0", "v14f6", "v14f8"].contains(&name) { 1.001 } else { 0.5001 };
    assert_eq!(found.len(), expected.len(), "{name}");
    for (row, (found, expected)) in found.iter().zip(expected).enumerate() {
        for axis in 0..3 {
            let apart = (f64::from(found[axis]) - expected[axis]).abs();
            assert!(apart <= within, "{name}, point {}: {found:?} {expected:?}", row + 1);
        }
    }
}

/// A folder with the scanner, its errors, and some of the files beside the tests.
fn folder(name: &str, files: &[&str]) -> Folder {
    let folder = Folder::new(name);
    for file in ["scanner.chain", "errors.toml"].iter().chain(files) {
        folder.write(file, bytes(file));
    }
    folder
}

/// Corrects a file of the folder.
fn apply(folder: &Folder, data: &str, out: &str, more: &[&str]) -> Run {
    let fixed = ["apply", "scanner.chain", "--errors", "errors.toml", "--data", data, "--out", out];
    folder.trueaxis(&[&fixed[..], more].concat())
}

/// What a run that must succeed wrote.
fn applied(folder: &Folder, data: &str, out: &str, more: &[&str]) -> Vec<u8> {
    let run = apply(folder, data, out, more);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""), "{data} {out}");
    fs::read(folder.0.join(out)).expect("the command wrote it")
}

/// What a run that must fail says; it wrote nothing.
fn refused(folder: &Folder, data: &str, out: &str, more: &[&str]) -> String {
    let before = folder.names();
    let run = apply(folder, data, out, more);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{data} {out} {more:?}: {}", run.stderr);
    assert_eq!(folder.names(), before, "{data} {out} {more:?}");
    run.stderr
}
