//! Generated evaluators as files.

use std::path::Path;
use std::process::Command;

use crate::support::{Folder, Run, root, trueaxis};
use crate::{LIDAR, answered};

/// Writes the lidar's evaluators with some options; what the file says.
fn generated(name: &str, language: &str, file: &str, options: &[&str]) -> (Folder, String) {
    let folder = Folder::new(name);
    let out = folder.0.join(file);
    let arguments = ["generate", LIDAR, "--language", language, "--out", out.to_str().expect("UTF-8")];
    answered(&[arguments.as_slice(), options].concat());
    let text = folder.read(file);
    (folder, text)
}

fn refused(arguments: &[&str], words: &str) {
    let run: Run = trueaxis(&[["generate", LIDAR].as_slice(), arguments].concat());
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
    assert!(run.stderr.contains(words), "{run}");
}

#[test]
fn the_file_holds_the_declaration_the_box_and_the_bound() {
    let sizes = "examples/mobile-lidar/box.toml";
    let options = ["--observable", "pointing", "--sizes", sizes];
    let (folder, text) = generated("generate-rust", "rust", "lidar.rs", &options);
    assert!(text.contains("chain MobileLidar {"), "the declaration is quoted");
    assert!(text.contains(
        "First order, pointing: off by at most 1.007e-7 while errors stay within box.toml, proven."
    ));
    // 10 seconds of arc.
    assert!(text.contains("//     dtheta_y1 4.848136811095"), "the box is stated");
    assert!(!text.contains("pub struct Inputs"), "pointing needs none");
    assert_eq!(folder.names(), ["lidar.rs"]);
}

#[test]
fn the_former_name_of_sizes_is_heard_and_named() {
    let folder = Folder::new("generate-former-name");
    let out = folder.0.join("lidar.tex");
    let run = trueaxis(&[
        "generate",
        LIDAR,
        "--language",
        "latex",
        "--errors",
        "examples/mobile-lidar/box.toml",
        "--out",
        out.to_str().expect("UTF-8"),
    ]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("--errors is called --sizes here"), "{run}");
}

#[test]
fn one_form_without_rows_is_small() {
    let (_, whole) = generated("generate-whole", "c", "lidar.c", &[]);
    let options = ["--observable", "pointing", "--only", "first-order-error", "--no-rows"];
    let (folder, small) = generated("generate-small", "c", "lidar.c", &options);
    assert!(small.contains("mobile_lidar_first_order_error(") && !small.contains("error_rows("));
    assert!(!small.contains("exact_error") && small.len() * 4 < whole.len());
    assert!(folder.read("lidar.h").contains("-lm neither"));
    assert_eq!(folder.names(), ["lidar.c", "lidar.h"]);
}

#[test]
fn single_precision_has_no_double() {
    let options = ["--precision", "f32", "--observable", "pointing"];
    let (folder, text) = generated("generate-single", "c", "lidar.c", &options);
    for text in [text, folder.read("lidar.h")] {
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        assert!(
            code.clone().any(|line| line.contains("float"))
                && !code.clone().any(|line| line.contains("double"))
        );
    }
    let out = folder.0.join("lidar.py");
    let out = out.to_str().expect("UTF-8");
    refused(
        &["--language", "numpy", "--precision", "f32", "--out", out],
        "single precision is written in Rust, C and C++ only",
    );
}

/// With values written in, the file asks for no errors, and computes what `eval` computes with them.
#[test]
fn values_are_written_in() {
    let Some(node) = testkit::tool(testkit::NODE) else { return };
    let folder = Folder::new("generate-values");
    let declaration = "chain Mount {
        const arm: length = -0.25;
        body fork on ground { position_error: Rx(lean); motion: Rz(azimuth); }
        body tube on fork { position: Tx(-arm); position_error: Ry(skew), Tz(drop); motion: Ry(-elevation); }
        observe tip: point(arm, 0, 0.1) of tube;
    }";
    folder
        .write("mount.chain", declaration)
        .write("errors.toml", "lean = \"20 arcsec\"\nskew = \"-3 arcmin\"\narm = \"0.3 m\"\n")
        .write("all.toml", "lean = \"20 arcsec\"\nskew = \"-3 arcmin\"\narm = \"0.3 m\"\ndrop = \"1 mm\"\n")
        .write("poses.csv", "azimuth [deg],elevation [deg]\n40,25\n")
        .write("package.json", "{\"type\": \"module\"}");
    for (errors, pass) in [("errors.toml", "{ drop: 1e-3 }"), ("all.toml", "")] {
        let run = folder.trueaxis(&[
            "generate",
            "mount.chain",
            "--language",
            "javascript",
            "--values",
            errors,
            "--out",
            "mount.js",
        ]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
        let text = folder.read("mount.js");
        assert!(text.contains("//     arm = 0.3 m\n"), "what is written in is told");
        assert!(!text.contains("errors.lean") && !text.contains("errors.skew"));
        let script = format!(
            "import {{ prepareExactError, exactError }} from './mount.js';
             const joints = {{ azimuth: 40 * Math.PI / 180, elevation: 25 * Math.PI / 180 }};
             console.log(exactError(prepareExactError({pass}), joints).tip.join(','));"
        );
        let found = run_node(&node, &folder, &script).expect("it runs");
        let eval = folder.trueaxis(&[
            "eval",
            "mount.chain",
            "--data",
            "poses.csv",
            "--errors",
            "all.toml",
            "--out",
            "-",
        ]);
        let row = eval.stdout.lines().nth(1).expect("a row");
        for (found, expected) in found.trim().split(',').zip(row.split(',').skip(2)) {
            let (found, expected): (f64, f64) = (found.parse().expect("f64"), expected.parse().expect("f64"));
            // Errors of 1e-3, sums of some tens of terms.
            assert!((found - expected).abs() < 1e-17, "{found} {expected}");
        }
    }
}

/// What node prints, or what it complains of.
fn run_node(node: &Path, folder: &Folder, script: &str) -> Result<String, String> {
    let output = Command::new(node)
        .args(["--input-type=module", "-e", script])
        .current_dir(&folder.0)
        .output()
        .expect("node runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    if output.status.success() { Ok(text(output.stdout)) } else { Err(text(output.stderr)) }
}

#[test]
fn javascript_refuses_fields_that_are_unknown_or_missing() {
    let Some(node) = testkit::tool(testkit::NODE) else { return };
    let options = ["--observable", "pointing", "--only", "exact-error"];
    let (folder, _) = generated("generate-javascript", "javascript", "lidar.js", &options);
    folder.write("package.json", "{\"type\": \"module\"}");
    let told = |call: &str| {
        let script = format!(
            "import {{ prepareExactError as prepare, exactError, exactErrorRows, noErrors }} from './lidar.js';
             const p = prepare(noErrors), one = {{ alpha: 0, beta: 0, gamma: 0 }}; {call}"
        );
        run_node(&node, &folder, &script).expect_err("it is refused")
    };
    assert!(told("prepare({ ...noErrors, dthetay1: 1 })").contains("errors have no field dthetay1"));
    assert!(told("prepare({})").contains("errors lack the field dtheta_y1"));
    assert!(told("exactError(p, { alpha: 0, beta: 0 })").contains("joints lack the field gamma"));
    assert!(told("exactError(p, { ...one, delta: 0 })").contains("joints have no field delta"));
    assert!(told("exactError(p)").contains("joints must be an object"));
    let rows = "exactErrorRows(p, { alpha: [0], beta: [0, 1], gamma: [0] }, {})";
    assert!(told(rows).contains("beta has not as many rows as alpha"));
}

#[test]
fn what_cannot_be_written_is_refused() {
    let folder = Folder::new("generate-refused");
    let out = |name: &str| folder.0.join(name).to_str().expect("UTF-8").to_owned();
    let files = [out("lidar.h"), out("lidar.c"), out("li\"dar.c")];
    let [header, source, strange] = files.each_ref().map(String::as_str);
    refused(&["--language", "c", "--out", header], "is where the header goes");
    let twice = ["--language", "c", "--out", source, "--observable", "pointing", "--observable", "pointing"];
    refused(&twice, "the observable `pointing` is asked for twice");
    refused(&["--language", "c", "--out", strange], "cannot stand in an `#include`");
    let twice = ["--language", "c", "--out", source, "--only", "exact-error", "--only", "exact-error"];
    refused(&twice, "the form `exact_error` is asked for twice");
    assert!(folder.names().is_empty(), "nothing is written");
    assert!(root().join(LIDAR).exists());
}
