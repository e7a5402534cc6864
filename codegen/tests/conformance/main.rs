//! Generated code, compiled or run, against the interpreter: thirteen chains, all forms, every language that runs.
//!
//! Rust, C and C++ compute one pose as the interpreter does, bit by bit: the same operations, the same sine and cosine. Many
//! poses at once may fuse products and sums inside sine and cosine, and the other languages have their own; these agree
//! within 4 units in the last place of the result's scale.
#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod arrays;
mod branches;
mod calibrated;
mod case;
mod drivers;
mod inverse;
mod latex;
mod single;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use case::Case;
use codegen::{Language, vector};

/// A folder of its own for each language.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("conformance").join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// What a command prints; it must succeed.
fn output(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?} failed:\n{errors}");
    assert!(errors.is_empty(), "{command:?} warns:\n{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Writes the generated files of every chain.
fn write_all(cases: &[Case], language: Language, folder: &Path) {
    for case in cases {
        for file in case.generate(language) {
            fs::write(folder.join(format!("{}.{}", case.name, file.extension)), file.text).unwrap();
        }
    }
}

/// Compares what a driver printed, a number a line, with the interpreter.
fn compare(cases: &[Case], printed: &str, one_pose_is_exact: bool) {
    let mut numbers = printed.lines().map(|line| line.parse::<f64>().unwrap());
    for case in cases {
        case.compare(&mut numbers, one_pose_is_exact);
    }
    assert_eq!(numbers.next(), None, "nothing is printed beyond what was asked");
}

#[test]
fn rust() {
    let cases = Case::all();
    let folder = folder("rust");
    write_all(&cases, Language::Rust, &folder);
    fs::write(folder.join("generated.rs"), drivers::rust_library(&cases)).unwrap();
    fs::write(folder.join("main.rs"), drivers::rust(&cases)).unwrap();
    let rustc = || {
        let mut command = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        command.current_dir(&folder).args(["--edition=2024", "-Dwarnings"]);
        command
    };
    output(rustc().args(["--crate-type=rlib", "generated.rs"]));
    output(rustc().args(["--extern=generated=libgenerated.rlib", "main.rs"]));
    compare(&cases, &output(&mut Command::new(folder.join("main"))), true);
}

#[test]
fn c() {
    let cases = Case::all();
    let folder = folder("c");
    write_all(&cases, Language::C, &folder);
    fs::write(folder.join("main.c"), drivers::c(&cases)).unwrap();
    let sources = cases.iter().map(|case| format!("{}.c", case.name));
    output(
        Command::new(std::env::var_os("CC").unwrap_or_else(|| "cc".into()))
            .current_dir(&folder)
            .args([
                "-std=c99",
                "-O1",
                "-ffp-contract=off",
                "-Wall",
                "-Wextra",
                "-Werror",
                "-pedantic",
                "-o",
                "main",
                "main.c",
            ])
            .args(sources),
    );
    let path = match vector::path() {
        vector::Path::Portable => "portable",
        vector::Path::V3 => "x86-64-v3",
        vector::Path::V4 => "x86-64-v4",
    };
    compare(&cases, &output(Command::new(folder.join("main")).arg(path)), true);
}

/// The header of C++ alone, with the source as C++; it agrees with the header's maps where Eigen is.
#[test]
fn cpp() {
    let Some(compiler) = testkit::tool(testkit::CXX) else { return };
    let cases = Case::all();
    let folder = folder("cpp");
    write_all(&cases, Language::Cpp, &folder);
    fs::write(folder.join("main.cpp"), drivers::cpp(&cases)).unwrap();
    let sources = cases.iter().map(|case| format!("{}.cpp", case.name));
    let strict = ["-std=c++17", "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-pedantic"];
    output(
        Command::new(compiler)
            .current_dir(&folder)
            .args(strict)
            .args(["-isystem", "/usr/include/eigen3", "-o", "main", "main.cpp"])
            .args(sources),
    );
    compare(&cases, &output(&mut Command::new(folder.join("main"))), true);
}

/// Nothing to warn of either where there is little: no joints, no errors.
#[test]
fn c_of_small_chains() {
    let folder = folder("small");
    for (name, text) in [
        (
            "still",
            "chain Still { body post on ground { position_error: Rz(tilt); } observe tip: point(1, 0, 0) of post; }",
        ),
        (
            "perfect",
            "chain Perfect { body arm on ground { motion: Rz(turn); } observe tip: point(1, 0, 0) of arm; }",
        ),
        ("fixed", "chain Fixed { body post on ground { } observe tip: direction(1, 0, 0) of post; }"),
    ] {
        let chain = support::read(name, text);
        let forms = case::FORMS.map(|(form, _)| form);
        let observables = [model_core::ObservableId(0)];
        let unit = codegen::Unit::new(&chain, text, &observables, &forms);
        for file in codegen::generate(&unit, Language::C, name).unwrap() {
            fs::write(folder.join(format!("{name}.{}", file.extension)), file.text).unwrap();
        }
        let source = format!("{name}.c");
        let cc = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
        output(Command::new(cc).current_dir(&folder).args([
            "-std=c99",
            "-O1",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-pedantic",
            "-c",
            "-o",
            "small.o",
            &source,
        ]));
    }
}

/// The header says that no library is needed: at any level of optimisation.
#[test]
fn c_links_without_a_library() {
    let folder = folder("linked");
    let cases = [Case::all().swap_remove(0)];
    write_all(&cases, Language::C, &folder);
    let name = cases[0].name;
    let prefix = codegen::snake_case(&cases[0].chain.name);
    let main = format!(
        "#include \"{name}.h\"\nint main(void) {{ return {prefix}_path_taken()[0] == 0 || sizeof({prefix}_{}_rows) == 0; }}\n",
        "observed"
    );
    fs::write(folder.join("main.c"), main).unwrap();
    for level in ["-O0", "-Og", "-Os"] {
        let cc = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
        let source = format!("{name}.c");
        output(
            Command::new(cc).current_dir(&folder).args(["-std=c99", level, "-o", "main", "main.c", &source]),
        );
    }
}

#[test]
fn javascript() {
    let Some(node) = testkit::tool(testkit::NODE) else { return };
    let cases = Case::all();
    let folder = folder("javascript");
    write_all(&cases, Language::Javascript, &folder);
    fs::write(folder.join("package.json"), "{\"type\": \"module\"}").unwrap();
    fs::write(folder.join("main.js"), drivers::javascript(&cases)).unwrap();
    compare(&cases, &output(Command::new(node).current_dir(&folder).arg("main.js")), false);
}

#[test]
fn numpy() {
    let Some(python) = testkit::tool(testkit::NUMPY) else { return };
    let cases = Case::all();
    let folder = folder("numpy");
    write_all(&cases, Language::Numpy, &folder);
    fs::write(folder.join("main.py"), drivers::numpy(&cases)).unwrap();
    compare(&cases, &output(Command::new(python).current_dir(&folder).arg("main.py")), false);
}

#[test]
fn matlab() {
    let Some(octave) = testkit::tool(testkit::OCTAVE) else { return };
    let cases = Case::all();
    let folder = folder("matlab");
    write_all(&cases, Language::Matlab, &folder);
    fs::write(folder.join("main.m"), arrays::matlab(&cases)).unwrap();
    let quiet = ["--no-history", "--norc", "--quiet", "main.m"];
    compare(&cases, &output(Command::new(octave).current_dir(&folder).args(quiet)), false);
}

#[test]
fn jax() {
    let Some(python) = testkit::tool(testkit::JAX) else { return };
    let cases = Case::all();
    let folder = folder("jax");
    write_all(&cases, Language::Jax, &folder);
    fs::write(folder.join("main.py"), arrays::jax(&cases)).unwrap();
    compare(&cases, &output(Command::new(python).current_dir(&folder).arg("main.py")), false);
}
