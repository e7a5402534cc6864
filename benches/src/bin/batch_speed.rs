//! Batch speed of the generated code, Rust and C, against floors written by hand, in one run.
//!
//! Generates the mobile lidar's evaluators once for each path, compiles them with the program in `benches/speed`, and runs
//! that; it prints the table. Run it with nothing else at work:
//! `cargo run --release -p trueaxis-benches --bin batch_speed`. With `--lint` it only has clippy read that program and the
//! one of `benches/peers`, which no package holds.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use codegen::{Form, Language, Unit, generate};
use model_core::Chain;

const FORMS: [Form; 4] =
    [Form::FirstOrderError, Form::ExactError, Form::ExactJacobian, Form::FirstOrderJacobian];

fn main() -> Result<(), Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = here.join("../target/batch_speed");
    fs::create_dir_all(&out)?;
    write_evaluators(&here.join("../examples/mobile-lidar/mobile-lidar.chain"), &out)?;

    if std::env::args().any(|argument| argument == "--lint") {
        for (program, kind) in [("speed/main.rs", "bin"), ("peers/ours.rs", "lib")] {
            let mut clippy = Command::new("clippy-driver");
            clippy.args(["--edition", "2024", "--emit", "metadata", "-D", "warnings", "--crate-type", kind]);
            clippy.arg("-o").arg(out.join("lint")).env("OUT_DIR", &out).env("LIDAR", &out);
            run(clippy.arg(here.join(program)))?;
        }
        return Ok(());
    }

    let program = out.join("speed");
    let mut rustc = Command::new("rustc");
    rustc.args(["--edition", "2024", "-C", "opt-level=3", "-o"]).arg(&program).env("OUT_DIR", &out);
    for path in ["Portable", "V3", "V4"] {
        let object = compile_c(here, &out, path)?;
        rustc.arg(format!("-Clink-arg={}", object.display()));
    }
    run(rustc.arg(here.join("speed/main.rs")))?;
    run(&mut Command::new(&program))
}

/// Generated files whose functions do not ask the processor, but take one path.
fn write_evaluators(chain: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
    let declaration = fs::read_to_string(chain)?;
    let chain = Chain::from_text(&declaration)?;
    let observables: Vec<_> =
        ["pointing", "position"].iter().filter_map(|name| chain.find_observable(name)).collect();
    let unit = Unit::new(&chain, &declaration, &observables, &FORMS);
    for file in generate(&unit, Language::Rust, "lidar")? {
        fs::write(out.join("lidar.rs"), &file.text)?;
        for path in ["Portable", "V3", "V4"] {
            let text = file.text.replace("sine_cosine::path(),", &format!("sine_cosine::Path::{path},"));
            fs::write(out.join(format!("lidar_{}.rs", path.to_lowercase())), text)?;
        }
    }
    for file in generate(&unit, Language::C, "lidar")? {
        let text = file.text.replace("switch (trueaxis_path())", "switch (SPEED_PATH)");
        fs::write(out.join(format!("lidar.{}", file.extension)), text)?;
    }
    Ok(())
}

fn compile_c(here: &Path, out: &Path, path: &str) -> Result<PathBuf, Box<dyn Error>> {
    let name = path.to_lowercase();
    let object = out.join(format!("{name}.o"));
    let mut cc = Command::new("cc");
    cc.args(["-std=c99", "-O3", "-c"])
        .arg(format!("-DSPEED_PATH=TRUEAXIS_{}", path.to_uppercase()))
        .arg(format!("-DSPEED(name)=speed_{name}_##name"))
        .arg("-I")
        .arg(out)
        .arg("-o")
        .arg(&object)
        .arg(here.join("speed/shim.c"));
    run(&mut cc)?;
    Ok(object)
}

fn run(command: &mut Command) -> Result<(), Box<dyn Error>> {
    let status = command.status()?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}").into()) }
}
