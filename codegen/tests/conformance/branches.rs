//! The first-order form for real-time use has no conditional jump, calls nothing, so that it neither allocates nor recurses,
//! and takes a stack of one small, fixed size: read in the assembly of the compilers at hand.
#![cfg(target_arch = "x86_64")]

use std::fs;
use std::process::Command;

use codegen::{Form, Language, Unit, generate};
use model_core::ObservableId;

use crate::support::{CHAINS, read};
use crate::{folder, output};

/// Writes the first-order form of the mobile lidar.
fn write(language: Language, folder: &std::path::Path) {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let observables = [ObservableId(0), ObservableId(1)];
    let forms = [Form::FirstOrderError];
    let unit = Unit::new(&chain, text, &observables, &forms);
    for file in generate(&unit, language, name).unwrap() {
        fs::write(folder.join(format!("{name}.{}", file.extension)), file.text).unwrap();
    }
}

/// The instructions of the functions whose names contain `name`.
fn instructions<'a>(assembly: &'a str, name: &str) -> Vec<&'a str> {
    let mut inside = false;
    let mut found = Vec::new();
    for line in assembly.lines() {
        if let Some(label) = line.strip_suffix(':').filter(|label| !label.starts_with('.')) {
            inside = label.contains(name);
        } else if inside && line.starts_with('\t') && !line.trim_start().starts_with('.') {
            found.push(line.trim_start());
        }
    }
    found
}

fn check(assembly: &str) {
    let instructions = instructions(assembly, "without_branch");
    assert!(instructions.len() > 100, "the functions are there");
    let is_conditional = |line: &&&str| line.starts_with('j') && !line.starts_with("jmp");
    let jumps: Vec<_> = instructions.iter().filter(is_conditional).collect();
    assert!(jumps.is_empty(), "{jumps:?}");
    let calls: Vec<_> = instructions.iter().filter(|line| line.starts_with("call")).collect();
    assert!(calls.is_empty(), "{calls:?}");
    // What moves the stack pointer, registers saved apart: once down and once up, by a number.
    let moves_stack = |line: &&&str| line.ends_with(", %rsp") && !line.starts_with("mov");
    for line in instructions.iter().filter(moves_stack) {
        let bytes = line.split_once('$').and_then(|(_, rest)| rest.split(',').next()?.parse::<i64>().ok());
        assert!(bytes.is_some_and(|bytes| bytes.abs() <= 1024), "{line}");
    }
}

#[test]
fn rust_without_branches() {
    let folder = folder("branches");
    write(Language::Rust, &folder);
    fs::write(folder.join("lib.rs"), "#![no_std]\npub mod mobile_lidar;\n").unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    output(Command::new(rustc).current_dir(&folder).args([
        "--edition=2024",
        "-Copt-level=2",
        "--crate-type=lib",
        "--emit=asm=rust.s",
        "lib.rs",
    ]));
    check(&fs::read_to_string(folder.join("rust.s")).unwrap());
}

#[test]
fn c_without_branches() {
    let folder = folder("branches");
    write(Language::C, &folder);
    let cc = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    output(Command::new(cc).current_dir(&folder).args([
        "-std=c99",
        "-O2",
        "-S",
        "-o",
        "c.s",
        "mobile_lidar.c",
    ]));
    check(&fs::read_to_string(folder.join("c.s")).unwrap());
}
