//! Single precision: Rust and C, in every chain and form, near the interpreter and bit for bit the same.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

use codegen::{Interpreter, Language, Precision, Unit, build, generate};
use model_core::SymbolId;

use crate::case::{Case, FORMS, SINGLE};
use crate::{folder, output};

/// Results may be off by this many units in the last place of their scale: some tens of operations, each rounded.
const ULPS: f64 = 64.0;

fn write_single(case: &Case, language: Language, folder: &Path) {
    let forms = FORMS.map(|(form, _)| form);
    let unit =
        Unit { precision: Precision::Single, ..Unit::new(&case.chain, case.text, &case.observables, &forms) };
    for file in generate(&unit, language, case.name).unwrap() {
        fs::write(folder.join(format!("{}.{}", case.name, file.extension)), file.text).unwrap();
    }
}

fn values(case: &Case, symbols: &[SymbolId], row: usize, end: &str) -> String {
    let value = |&id: &SymbolId| format!("{:?}{end}", case.poses[row][id.index()] as f32);
    symbols.iter().map(value).collect::<Vec<_>>().join(", ")
}

/// What Rust prints: the bits of every number.
fn rust(cases: &[Case]) -> String {
    let folder = folder("single-rust");
    let (mut library, mut text) = (String::from("#![no_std]\n"), String::from("fn main() {\n"));
    for case in cases {
        write_single(case, Language::Rust, &folder);
        let name = case.name;
        writeln!(library, "#[path = \"{name}.rs\"]\npub mod {name};").unwrap();
        let errors = values(case, &case.errors(), 0, "");
        writeln!(text, "{{ use generated::{name}::*; let errors = Errors::from([{errors}]);").unwrap();
        for row in 0..SINGLE {
            let pose = case.of_pose(&|argument, symbols| {
                let kind = if argument == "joints" { "Joints" } else { "Inputs" };
                format!("&{kind}::from([{}])", values(case, symbols, row, ""))
            });
            for (form, form_name) in FORMS {
                let flat = if form.is_jacobian() { ".into_iter().flatten()" } else { "" };
                writeln!(text, "let out = {form_name}(&errors, {pose});").unwrap();
                for observable in &case.chain.observables {
                    let name = &observable.name;
                    writeln!(text, "for x in out.{name}{flat} {{ println!(\"{{}}\", x.to_bits()); }}")
                        .unwrap();
                }
            }
        }
        text.push_str("}\n");
    }
    fs::write(folder.join("generated.rs"), library).unwrap();
    fs::write(folder.join("main.rs"), text + "}\n").unwrap();
    let rustc = || {
        let mut command = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        command.current_dir(&folder).args(["--edition=2024", "-Dwarnings"]);
        command
    };
    output(rustc().args(["--crate-type=rlib", "generated.rs"]));
    output(rustc().args(["--extern=generated=libgenerated.rlib", "main.rs"]));
    output(&mut Command::new(folder.join("main")))
}

/// What C prints: the bits of every number.
fn c(cases: &[Case]) -> String {
    let folder = folder("single-c");
    let (mut includes, mut text) = (String::new(), String::new());
    for case in cases {
        write_single(case, Language::C, &folder);
        let (name, prefix) = (case.name, codegen::snake_case(&case.chain.name));
        writeln!(includes, "#include \"{name}.h\"").unwrap();
        writeln!(text, "    {{\n    {prefix}_errors errors = {{{}}};", values(case, &case.errors(), 0, "f"))
            .unwrap();
        for row in 0..SINGLE {
            text.push_str("    {\n");
            for (argument, symbols) in &case.pose {
                let values = values(case, symbols, row, "f");
                writeln!(text, "    {prefix}_{argument} {argument} = {{{values}}};").unwrap();
            }
            let pose = case.of_pose(&|argument, _| format!("&{argument}"));
            for (form, form_name) in FORMS {
                let result = if form.is_jacobian() { "jacobian" } else { "observed" };
                writeln!(
                    text,
                    "    {{ {prefix}_{form_name}_prepared prepared; {prefix}_{result} out;
    {prefix}_{form_name}_prepare(&errors, &prepared);
    {prefix}_{form_name}(&prepared, {pose}, &out);
    show((const float *)&out, sizeof out / sizeof(float)); }}"
                )
                .unwrap();
            }
            text.push_str("    }\n");
        }
        text.push_str("    }\n");
    }
    let main = format!(
        "#include <stdio.h>\n#include <string.h>\n{includes}
static void show(const float *values, size_t count)
{{
    unsigned bits;
    for (; count > 0; count--, values++) {{
        memcpy(&bits, values, sizeof bits);
        printf(\"%u\\n\", bits);
    }}
}}
int main(void)
{{
{text}    return 0;
}}
"
    );
    fs::write(folder.join("main.c"), main).unwrap();
    let sources = cases.iter().map(|case| format!("{}.c", case.name));
    let strict = [
        "-std=c99",
        "-O1",
        "-ffp-contract=off",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-pedantic",
        "-Wdouble-promotion",
    ];
    let cc = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    output(Command::new(cc).current_dir(&folder).args(strict).args(["-o", "main", "main.c"]).args(sources));
    output(&mut Command::new(folder.join("main")))
}

#[test]
fn single_precision() {
    // Angles, ranges and lines of sight have no code in single precision: `generate` refuses them with words.
    let cases: Vec<Case> =
        Case::all().into_iter().filter(|case| !["readings", "sight"].contains(&case.name)).collect();
    let printed = rust(&cases);
    assert_eq!(printed, c(&cases), "Rust and C give the same bits");
    let mut numbers = printed.lines().map(|line| f64::from(f32::from_bits(line.parse().unwrap())));
    for case in &cases {
        for pose in &case.poses[..SINGLE] {
            let pose: Vec<f64> = pose.iter().map(|&value| f64::from(value as f32)).collect();
            for (form, form_name) in FORMS {
                let program = build(&case.chain, &case.observables, form, &case.errors());
                let mut expected = vec![0.0; program.outputs().len()];
                Interpreter::new(&program).eval(&pose, &mut expected).unwrap();
                let per_observable = (expected.len() / case.observables.len()).max(1);
                for of_observable in expected.chunks(per_observable) {
                    let scale = of_observable.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                    for &expected in of_observable {
                        let found = numbers.next().unwrap();
                        let ulps = (found - expected).abs() / (scale * f64::from(f32::EPSILON));
                        assert!(
                            found == expected || ulps <= ULPS,
                            "{}, {form_name}: {found} is not {expected}: {ulps} ulp",
                            case.name
                        );
                    }
                }
            }
        }
    }
    assert_eq!(numbers.next(), None);
}
