//! Generates the scanner's evaluators from its declaration, anew whenever the declaration changes.

use std::error::Error;
use std::fs;
use std::path::Path;

use codegen::{Form, Language, Unit, generate};
use model_core::Chain;

const DECLARATION: &str = "../mobile-lidar/mobile-lidar.chain";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={DECLARATION}");
    let text = fs::read_to_string(DECLARATION)?;
    let chain = Chain::from_text(&text).map_err(|mistakes| mistakes.render(DECLARATION, &text))?;
    let pointing = chain.find_observable("pointing").ok_or("the declaration observes no `pointing`")?;
    let (observables, forms) = ([pointing], [Form::FirstOrderError, Form::ExactError]);
    let unit = Unit::new(&chain, &text, &observables, &forms);
    let folder = std::env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    for file in generate(&unit, Language::Rust, "scanner")? {
        fs::write(Path::new(&folder).join(format!("scanner.{}", file.extension)), file.text)?;
    }
    Ok(())
}
