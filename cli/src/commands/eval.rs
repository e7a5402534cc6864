//! `trueaxis eval`: the error, or the value, of observables over a table of readings.

use service::evaluation;

use super::Answer;
use crate::failure::Failure;
use crate::over_table::OverTable;

/// Evaluate the error of each observable over a table of readings.
///
/// Angles that are shown are in radians. Unless the declaration names other axes, an azimuth is 0 along x and a quarter turn
/// along y, an hour angle or a horizontal circle turns the other way, an elevation is above the plane across z, a zenith
/// distance from z.
///
/// Reads columns named like the chain's joints and inputs (`alpha [deg]`, `range [mm]`; without a unit: SI) and
/// writes every column of the input, with three more for each observable: what the errors add to it (the
/// default), or the observable itself.
///
/// Example: trueaxis eval examples/mobile-lidar/mobile-lidar.chain --errors examples/mobile-lidar/errors.toml
/// --data poses.csv --observable pointing --out errors.csv
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    table: OverTable,
    /// Exact, or to first order in the errors
    #[arg(long, value_enum, default_value_t = Exactness::Exact)]
    form: Exactness,
    /// The error of the observable, or the observable with its errors
    #[arg(long, value_enum, default_value_t = Quantity::Error)]
    quantity: Quantity,
}

/// The exact form, or the first-order one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Exactness {
    /// The product of all transforms
    Exact,
    /// Products of two or more errors dropped
    FirstOrder,
}

/// What of an observable is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Quantity {
    /// What the errors add to it
    Error,
    /// The observable itself, with its errors
    Value,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let form = match arguments.form {
        Exactness::Exact => evaluation::Exactness::Exact,
        Exactness::FirstOrder => evaluation::Exactness::FirstOrder,
    };
    let quantity = match arguments.quantity {
        Quantity::Error => evaluation::Quantity::Error,
        Quantity::Value => evaluation::Quantity::Value,
    };
    arguments.table.evaluate(form, quantity)?;
    Ok(Answer::Done)
}
