//! Declarations that would break out of generated files: whatever words, names and numbers they bring, the files compile
//! and do nothing else, or are refused with words.
#![allow(clippy::unwrap_used)]

mod names;
mod refused;
mod words;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use codegen::{Form, LANGUAGES, Language, Unit, generate};

const FORMS: [Form; 5] = [
    Form::ExactValue,
    Form::ExactError,
    Form::FirstOrderError,
    Form::ExactJacobian,
    Form::FirstOrderJacobian,
];

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile").join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A command that must succeed and say nothing.
fn quiet(command: &mut Command) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let said =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(output.status.success() && said.is_empty(), "{command:?}:\n{said}");
}

/// Compiles or loads what is written of a unit in every language.
fn compiles(unit: &Unit<'_>, folder: &Path) {
    for (_, language) in LANGUAGES {
        for file in generate(unit, language, "file").unwrap() {
            fs::write(folder.join(format!("file.{}", file.extension)), file.text).unwrap();
        }
        let command = |program: &Path, arguments: &[&str]| {
            quiet(Command::new(program).current_dir(folder).args(arguments));
        };
        match language {
            // As a private module of which nothing is used.
            Language::Rust => {
                fs::write(folder.join("lib.rs"), "#![no_std]\nmod file;\n").unwrap();
                let rustc = PathBuf::from(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
                command(
                    &rustc,
                    &["--edition=2024", "-Dwarnings", "--crate-type=lib", "--emit=metadata", "lib.rs"],
                );
                // No word of a declaration is a test.
                let rustdoc = PathBuf::from(std::env::var_os("RUSTDOC").unwrap_or_else(|| "rustdoc".into()));
                let arguments = ["--test", "--edition=2024", "--crate-name=words", "lib.rs"];
                let tests = Command::new(rustdoc).current_dir(folder).args(arguments).output().unwrap();
                let said = String::from_utf8_lossy(&tests.stdout).into_owned();
                assert!(tests.status.success() && said.contains("running 0 tests"), "{said}");
            }
            Language::C => {
                let cc = PathBuf::from(std::env::var_os("CC").unwrap_or_else(|| "cc".into()));
                let strict =
                    ["-std=c99", "-trigraphs", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"];
                command(&cc, &[strict.as_slice(), &["file.c"]].concat());
                // Another dialect has other macros.
                command(&cc, &["-std=gnu11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "file.c"]);
            }
            Language::Javascript => {
                let Some(node) = testkit::tool(testkit::NODE) else { continue };
                fs::write(folder.join("package.json"), "{\"type\": \"module\"}").unwrap();
                let load = "await import('./file.js'); if (globalThis.injected) throw new Error('injected');";
                command(&node, &["--input-type=module", "-e", load]);
            }
            Language::Cpp => {
                let Some(compiler) = testkit::tool(testkit::CXX) else { continue };
                let strict = ["-std=c++17", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"];
                fs::write(folder.join("twice.cpp"), "#include \"file.hpp\"\n#include \"file.hpp\"\n")
                    .unwrap();
                command(&compiler, &[strict.as_slice(), &["file.cpp", "twice.cpp"]].concat());
            }
            Language::Matlab => {
                let Some(octave) = testkit::tool(testkit::OCTAVE) else { continue };
                let load = "of = file(); if isempty(of), error('nothing'), end";
                command(&octave, &["--no-history", "--norc", "--quiet", "--eval", load]);
            }
            Language::Jax => {
                let Some(python) = testkit::tool(testkit::PYTHON) else { continue };
                fs::create_dir_all(folder.join("jax")).unwrap();
                fs::write(folder.join("jax/__init__.py"), "").unwrap();
                fs::write(folder.join("jax/numpy.py"), "").unwrap();
                command(&python, &["-B", "-W", "error", "-c", "import file"]);
                fs::remove_dir_all(folder.join("jax")).unwrap();
            }
            Language::Numpy => {
                let Some(python) = testkit::tool(testkit::PYTHON) else { continue };
                fs::write(folder.join("numpy.py"), "ndarray = object\n").unwrap();
                command(&python, &["-B", "-W", "error", "-c", "import file"]);
            }
            Language::Latex => {
                let text = fs::read_to_string(folder.join("file.tex")).unwrap();
                let body: Vec<&str> = text.lines().filter(|line| !line.starts_with('%')).collect();
                assert!(!body.concat().contains("injected"), "{body:?}");
            }
        }
    }
}
