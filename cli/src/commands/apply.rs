//! `trueaxis apply`: new data corrected with a calibrated model.

use super::Answer;
use crate::evaluation::{Exactness, Quantity};
use crate::failure::Failure;
use crate::over_table::OverTable;

/// Correct new data with a calibrated model.
///
/// Reads columns named like the chain's joints and inputs and writes every column of the input, with the corrected
/// `<observable>_x`, `_y`, `_z`: where the instrument with its calibrated errors really points, or where its points
/// really are. Columns of these names in the input, computed without the errors, are replaced.
///
/// Example: trueaxis apply result/amended.chain --errors result/errors.toml --data new.csv --out corrected.csv
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    table: OverTable,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    arguments.table.evaluate(Exactness::Exact, Quantity::Value)?;
    Ok(Answer::Done)
}
