//! What the commands answer when nothing is wrong.

#[path = "../support/mod.rs"]
mod support;

mod formulas;
mod formulas_only;
mod generated;
mod tables;

use support::{Run, trueaxis};

/// The declaration of the examples.
const LIDAR: &str = "examples/mobile-lidar/mobile-lidar.chain";
/// The richer one, which its data were measured with.
const OFF_CENTRE: &str = "examples/mobile-lidar/off-centre.chain";

/// Runs a command that must do its work without a word on standard error.
fn answered(arguments: &[&str]) -> String {
    let run: Run = trueaxis(arguments);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
    run.stdout
}
