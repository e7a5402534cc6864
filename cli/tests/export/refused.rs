//! What `export` refuses: exit code 2, what is wrong, and what to write instead; never a panic.

use crate::instrument;
use crate::support::{Folder, Run};

/// A scanner: what it observes is a point.
const SCANNER: &str = "chain Scanner {
    body head on ground { motion: Rz(-azimuth); motion_error: Rz(-zero); }
    body beam on head { motion: Rx(elevation); }
    input distance: range;
    observe target: point(0, distance, 0) of beam;
    observe sight: direction(0, 1, 0) of beam;
}
";

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder
        .write("scanner.toml", instrument(SCANNER, "zero = 1e-4", "[found-over]\ndistance = [1.0, 50.0]\n"));
    folder.write("scanner.chain", SCANNER);
    folder
}

/// Exports the scanner's line of sight as terms of TPOINT.
fn sight_as_tpoint(folder: &Folder, out: &str) -> Run {
    let what = ["export", "scanner.toml", "--form", "tpoint", "--observable", "sight", "--out"];
    folder.trueaxis(&[&what[..], &[out]].concat())
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{run}");
    assert_eq!(run.stdout, "", "{run}");
    assert!(run.stderr.contains(why), "{why}: {run}");
    assert!(!run.stderr.contains("panicked"), "{run}");
}

#[test]
fn a_form_that_is_none_comes_with_the_nearest() {
    let folder = folder("export-unknown");
    let run = folder.trueaxis(&["export", "scanner.toml", "--form", "tpont", "--out", "a"]);
    refused(&run, "'tpoint'");
    let run = folder.trueaxis(&["export", "scanner.toml", "--form", "\u{202e}x\u{1b}[2J", "--out", "a"]);
    refused(&run, "tpoint");
    assert!(!run.stderr.contains('\u{1b}') && !run.stderr.contains('\u{202e}'), "{run}");
}

#[test]
fn files_of_another_kind() {
    let folder = folder("export-kinds");
    let export = |file: &str| {
        folder.trueaxis(&["export", file, "--form", "tpoint", "--observable", "sight", "--out", "a"])
    };
    refused(&export("scanner.chain"), "give `instrument.toml`, which `calibrate` writes");
    folder.write("empty.toml", "");
    refused(&export("empty.toml"), "empty.toml");
    folder.write("bytes.toml", [0xff, 0xfe, 0x00]);
    refused(&export("bytes.toml"), "UTF-8");
    refused(&export("none.toml"), "there is no such file");
    assert!(!folder.names().contains(&"a".to_owned()));
}

#[test]
fn what_the_form_cannot_describe() {
    let folder = folder("export-other");
    let export = |more: &[&str]| {
        folder.trueaxis(&[&["export", "scanner.toml", "--form", "tpoint", "--out", "a"], more].concat())
    };
    refused(&export(&[]), "say which of `target`, `sight` is wanted: --observable NAME");
    refused(&export(&["--observable", "target"]), "a point, and TPOINT describes directions");
    refused(&export(&["--observable", "sigt"]), "did you mean `sight`?");
    refused(
        &export(&["--observable", "sight", "--template", "scanner.chain"]),
        "takes no --template: leave it out",
    );
    let run = export(&["--observable", "sight"]);
    assert_eq!(run.code, 0, "{run}");
    let other = SCANNER.replace("Rz(-azimuth)", "Rz(azimuth)");
    folder.write("scanner.toml", instrument(&other, "zero = 1e-4", ""));
    refused(&export(&["--observable", "sight"]), "a line of sight that runs in another way");
}

/// The range of an input that the observable needs.
#[test]
fn a_region_that_the_file_does_not_say() {
    let folder = Folder::new("export-region");
    let chain = SCANNER
        .replace("Rx(elevation)", "Rx(elevation); motion_error: Rx(warm*degrees)")
        .replace("input distance", "input degrees: temperature; input distance");
    folder.write("scanner.toml", instrument(&chain, "warm = 1e-6", ""));
    let run = sight_as_tpoint(&folder, "a");
    refused(&run, "add it to [found-over], as degrees = [1.0, 2.0]");
}

#[test]
fn nothing_is_written_over_what_is_read() {
    let folder = folder("export-over");
    let before = folder.read("scanner.toml");
    let run = sight_as_tpoint(&folder, "scanner.toml");
    refused(&run, "scanner.toml");
    assert_eq!(folder.read("scanner.toml"), before);
    // Another file is replaced, as every command does.
    folder.write("a", "old");
    let run = sight_as_tpoint(&folder, "a");
    assert_eq!(run.code, 0, "{run}");
    assert!(folder.read("a").ends_with("END\n"));
    let run = sight_as_tpoint(&folder, "no/such/a");
    refused(&run, "create it first");
}
