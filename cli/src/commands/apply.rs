//! `trueaxis apply`: new data corrected with a calibrated model.

use std::path::PathBuf;

use super::Answer;
use super::eval::{with_readings, write_evaluated};
use crate::errors_file;
use crate::evaluation::{Evaluator, Exactness, Quantity};
use crate::failure::Failure;
use crate::source::Source;
use crate::tables::ReadingsTable;

/// Correct new data with a calibrated model.
///
/// Reads columns named like the chain's joints and inputs and writes every column of the input, with the corrected
/// `<observable>_x`, `_y`, `_z`: where the instrument with its calibrated errors really points, or where its points
/// really are. Columns of these names in the input, computed without the errors, are replaced.
///
/// Example: trueaxis apply result/amended.chain --errors result/errors.toml --data new.csv --out corrected.csv
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration, amended or not
    chain: PathBuf,
    /// Values of the errors, as `calibrate` writes them
    #[arg(long, value_name = "E.toml")]
    errors: PathBuf,
    /// Readings of joints and inputs: a .csv file, or - for standard input
    #[arg(long, value_name = "IN")]
    data: PathBuf,
    /// Only this observable (may be given several times); default: every one that the data has the readings for
    #[arg(long)]
    observable: Vec<String>,
    /// Where to write: a .csv file, or - for standard output
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let chain = Source::read(&arguments.chain)?.chain()?;
    let values = errors_file::values(&Source::read(&arguments.errors)?, &chain)?;
    let table = ReadingsTable::open(&arguments.data)?;
    let chosen = with_readings(&chain, &table, &arguments.observable)?;
    let evaluator = Evaluator::new(&chain, chosen, Exactness::Exact, Quantity::Value, &values);
    write_evaluated(&chain, table, evaluator, &arguments.out)?;
    Ok(Answer::Done)
}
