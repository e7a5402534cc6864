//! Words of a declaration that is right, in all that follows from it.

use std::process::Command;

use super::seen::{is_seen, run};
use crate::support::Folder;
use testkit::hostile;

/// A text as documentation.
fn documented(text: &str) -> String {
    text.split(['\n', '\r', '\0']).map(|line| format!("/// {line}\n")).collect()
}

/// A chain whose errors are documented by some hostile strings each, and its bodies, inputs and observables by all.
fn chain() -> String {
    let all = hostile();
    let errors: String = all
        .chunks(8)
        .enumerate()
        .map(|(at, texts)| format!("{}Rx(e{at}),\n", documented(&texts.join("\n"))))
        .collect();
    let every = documented(&all.join("\n"));
    format!(
        "{every}chain Words {{\n{every}input far: length;\n{every}const size: length = 0.5;\n{every}body table on ground {{\n\
         position_error: {};\n motion: Rz(turn);\n}}\n{every}observe mark: point(size, 0, far) of table;\n\
         {every}symbol e0 = \"\\\\epsilon\";\n}}\n",
        errors.trim_end_matches(",\n")
    )
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("w.chain", chain());
    folder
}

#[test]
fn answers() {
    let folder = folder("hostile-answers");
    folder.write("e.toml", "\"e*\" = \"3 arcsec\"\n");
    for arguments in [
        "derive w.chain",
        "derive w.chain --format latex",
        "derive w.chain --format markdown",
        "derive w.chain --format json",
        "derive w.chain --certificate w.v",
        "budget w.chain --sizes e.toml --range far=1m..2m --out budget",
        "budget w.chain --sizes e.toml --range far=1m..2m --format json",
        "bound w.chain --sizes e.toml --range far=1m..2m",
        "identify w.chain",
    ] {
        let said = run(&folder, &arguments.split(' ').collect::<Vec<_>>());
        assert_eq!(said.code, 0, "{arguments}: {}", said.stderr);
        assert!(!said.stdout.contains("injected"), "{arguments}: {}", said.stdout);
    }
    is_seen(&folder.read("budget/budget.html"), "budget.html");
    let certificate = folder.read("w.v");
    is_seen(&certificate, "w.v");
    assert!(!outside_of_comments(&certificate).contains("injected"), "{certificate}");
}

/// What Coq executes.
pub fn outside_of_comments(text: &str) -> String {
    let (mut depth, mut rest, mut outside) = (0_usize, text, String::new());
    while let Some(letter) = rest.chars().next() {
        match rest.get(..2) {
            Some("(*") => {
                (depth, rest) = (depth + 1, &rest[2..]);
                continue;
            }
            Some("*)") => {
                (depth, rest) = (depth.saturating_sub(1), &rest[2..]);
                continue;
            }
            _ => {}
        }
        if depth == 0 {
            outside.push(letter);
        }
        rest = &rest[letter.len_utf8()..];
    }
    assert_eq!(depth, 0, "every comment ends");
    outside
}

#[test]
fn generated_files() {
    let folder = folder("hostile-generated");
    for (language, file) in [
        ("rust", "w.rs"),
        ("c", "w.c"),
        ("cpp", "w.cpp"),
        ("latex", "w.tex"),
        ("jax", "w_jax.py"),
        ("numpy", "w.py"),
        ("javascript", "w.js"),
        ("matlab", "w.m"),
    ] {
        let arguments =
            ["generate", "w.chain", "--language", language, "--only", "exact-error", "--out", file];
        let said = run(&folder, &arguments);
        assert_eq!(said.code, 0, "{language}: {}", said.stderr);
        is_seen(&folder.read(file), file);
    }
    is_seen(&folder.read("w.h"), "w.h");
    is_seen(&folder.read("w.hpp"), "w.hpp");
    let quiet = |program: &std::path::Path, arguments: &[&str]| {
        let output =
            Command::new(program).args(arguments).current_dir(&folder.0).output().expect("it starts");
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(output.status.success() && said.is_empty(), "{program:?} {arguments:?}:\n{said}");
    };
    let or = |variable: &str, program: &str| {
        std::path::PathBuf::from(std::env::var(variable).unwrap_or_else(|_| program.to_owned()))
    };
    quiet(
        &or("CC", "cc"),
        &["-std=c99", "-trigraphs", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "w.c"],
    );
    folder.write("lib.rs", "#![no_std]\npub mod w;\n");
    quiet(
        &or("RUSTC", "rustc"),
        &["--edition=2024", "-Dwarnings", "--crate-type=lib", "--emit=metadata", "lib.rs"],
    );
    let rustdoc = or("RUSTDOC", "rustdoc");
    quiet(&rustdoc, &["--edition=2024", "-Dwarnings", "--crate-name=words", "lib.rs"]);
    // No word of a declaration is a test of the file.
    let tests = Command::new(&rustdoc)
        .args(["--test", "--edition=2024", "--crate-name=words", "lib.rs"])
        .current_dir(&folder.0)
        .output()
        .expect("rustdoc starts");
    let said = String::from_utf8_lossy(&tests.stdout).into_owned();
    assert!(tests.status.success() && said.contains("running 0 tests"), "{said}");
    let page = folder.read("doc/words/w/struct.Errors.html");
    assert!(
        page.contains("panic!") && !page.contains("<injected") && !page.contains("<img src=\"x\""),
        "rustdoc shows words"
    );
    if let Some(python) = testkit::tool(testkit::PYTHON) {
        folder.write("numpy.py", "ndarray = object\n");
        quiet(&python, &["-B", "-W", "error", "-c", "import w"]);
    }
    if let Some(node) = testkit::tool(testkit::NODE) {
        folder.write("package.json", "{\"type\": \"module\"}");
        let load = "await import('./w.js'); if (globalThis.injected) throw new Error('injected');";
        quiet(&node, &["--input-type=module", "-e", load]);
    }
    let latex = folder.read("w.tex");
    assert!(
        latex.lines().filter(|line| !line.starts_with('%')).all(|line| !line.contains("injected")),
        "{latex}"
    );
}
