//! One pose of a calibrated instrument in a control loop: the correction, and the correction with its standard uncertainty,
//! in C, C++ and Rust; and many poses in C and C++.
//!
//! The mobile lidar with every error estimated, pointing alone and all observables, and a dense covariance. Programs take turns, and the
//! least of several rounds counts: `cargo run --release -p trueaxis-benches --bin live_speed`.
#![allow(clippy::print_stdout)]

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

use codegen::{Calibrated, Covariance, Form, Language, Unit, generate};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

const FORMS: [Form; 2] = [Form::ExactError, Form::Uncertainty];
const ROUNDS: usize = 9;
/// What every estimate has for itself, rad or m, and the share of what all have in common.
const SIGMA: f64 = 1e-5;
const COMMON: f64 = 0.3;

fn main() -> Result<(), Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let declaration = fs::read_to_string(here.join("../examples/mobile-lidar/mobile-lidar.chain"))?;
    let chain = Chain::from_text(&declaration)?;
    let all: Vec<ObservableId> =
        ["pointing", "position"].iter().filter_map(|name| chain.find_observable(name)).collect();
    for (name, observables) in [("pointing", &all[..1]), ("pointing and position", &all[..])] {
        println!("{name}");
        measure(here, &chain, &declaration, observables)?;
    }
    Ok(())
}

fn measure(
    here: &Path,
    chain: &Chain,
    declaration: &str,
    observables: &[ObservableId],
) -> Result<(), Box<dyn Error>> {
    let out = here.join("../target/live_speed");
    fs::create_dir_all(&out)?;
    let of: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
    let values: Vec<(SymbolId, f64)> =
        of.iter().zip(1..).map(|(id, at)| (*id, 1e-4 * f64::from(at % 7 - 3))).collect();
    let entry =
        |a: usize, b: usize| SIGMA * SIGMA * if a == b { 1.0 } else { COMMON / (1.0 + a.abs_diff(b) as f64) };
    let rows: Vec<Vec<f64>> = (0..of.len()).map(|a| (0..of.len()).map(|b| entry(a, b)).collect()).collect();
    let covariance = Some(Covariance { of: &of, rows: &rows });
    let unit = Unit {
        values: &values,
        calibrated: Calibrated { covariance, ..Calibrated::default() },
        ..Unit::new(chain, declaration, observables, &FORMS)
    };
    for language in [Language::C, Language::Cpp, Language::Rust] {
        for file in generate(&unit, language, "lidar")? {
            fs::write(out.join(format!("lidar.{}", file.extension)), &file.text)?;
        }
    }
    let speed = here.join("speed");
    let mut programs = Vec::new();
    for (compiler, standard, ending) in [("cc", "-std=gnu11", "c"), ("c++", "-std=c++17", "cpp")] {
        let program = out.join(format!("live_{ending}"));
        let mut build = Command::new(compiler);
        build.args([standard, "-O3", "-I"]).arg(&out).arg(speed.join(format!("live.{ending}")));
        build.arg(out.join(format!("lidar.{ending}"))).arg("-o").arg(&program);
        run(&mut build)?;
        programs.push((ending, program));
    }
    let program = out.join("live_rust");
    let mut build = Command::new("rustc");
    build.args(["--edition", "2024", "-C", "opt-level=3", "-o"]).arg(&program).env("OUT_DIR", &out);
    run(build.arg(speed.join("live.rs")))?;
    programs.push(("rust", program));

    let mut least: BTreeMap<(String, &str), f64> = BTreeMap::new();
    for _ in 0..ROUNDS {
        for (language, program) in &programs {
            let printed = String::from_utf8(Command::new(program).output()?.stdout)?;
            for line in printed.lines() {
                let (what, ns) = line.split_once(": ").ok_or("a line that says nothing")?;
                let own = least.entry((what.to_owned(), *language)).or_insert(f64::INFINITY);
                *own = own.min(ns.parse()?);
            }
        }
    }
    for ((what, language), ns) in &least {
        let of_c = least.get(&(what.clone(), "c")).map_or(f64::NAN, |of_c| ns / of_c);
        println!("  {what:32} {language:5} {ns:8.1} ns a pose, {of_c:.2} of C");
    }
    Ok(())
}

fn run(command: &mut Command) -> Result<(), Box<dyn Error>> {
    let status = command.status()?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}").into()) }
}
