//! `trueaxis eval`: the error, or the value, of observables over a table of readings.

use std::path::PathBuf;

use model_core::{Chain, ObservableId};

use super::Answer;
use crate::errors_file;
use crate::evaluation::{Evaluator, Exactness, Quantity, column_names, readings_of};
use crate::failure::Failure;
use crate::source::{Source, listed, observables};
use crate::tables::{self, ReadingsTable};
use crate::terminal;

/// Evaluate the error of each observable over a table of readings.
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

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let replaced = arguments.table.evaluate(arguments.form, arguments.quantity)?;
    if !replaced.is_empty() {
        let names = listed(replaced.iter().map(String::as_str));
        terminal::warn(format_args!("the input's own columns {names} were replaced"));
    }
    Ok(Answer::Done)
}

/// What is evaluated over which table, and where to: the arguments that `eval` and `apply` share.
#[derive(Debug, clap::Args)]
pub struct OverTable {
    /// The declaration, amended or not
    chain: PathBuf,
    /// Readings of joints and inputs: a .csv or .parquet file, or - for standard input
    #[arg(long, value_name = "IN")]
    data: PathBuf,
    /// Values of the errors, as `calibrate` writes them too
    #[arg(long, value_name = "E.toml")]
    errors: PathBuf,
    /// Only this observable (may be given several times); default: every one that the data has the readings for
    #[arg(long)]
    observable: Vec<String>,
    /// Where to write: a .csv or .parquet file, or - for standard output
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
}

impl OverTable {
    /// Writes the table with a quantity of each observable; returns which columns of the input these replace.
    ///
    /// # Errors
    /// The declaration, the errors or the readings have a mistake, or the place cannot be written.
    pub fn evaluate(&self, form: Exactness, quantity: Quantity) -> Result<Vec<String>, Failure> {
        let chain = Source::read(&self.chain)?.chain()?;
        let values = errors_file::values(&Source::read(&self.errors)?, &chain)?;
        let table = ReadingsTable::open(&self.data)?;
        let chosen = with_readings(&chain, &table, &self.observable)?;
        write_evaluated(&chain, table, Evaluator::new(&chain, chosen, form, quantity, &values), &self.out)
    }
}

/// The observables that were asked for; if none was, all that the table has the readings for.
///
/// # Errors
/// No observable of the chain has its readings in the table.
fn with_readings(
    chain: &Chain,
    table: &ReadingsTable,
    names: &[String],
) -> Result<Vec<ObservableId>, Failure> {
    let mut chosen = observables(chain, names)?;
    if names.is_empty() {
        let all = chosen.clone();
        chosen.retain(|&observable| table.has(chain, &readings_of(chain, observable)));
        // If none can be evaluated, the first one's missing column is what to say.
        chosen.extend(all.first().filter(|_| chosen.is_empty()));
    }
    Ok(chosen)
}

/// Writes the table with the evaluator's columns; returns which columns of the input these replace.
///
/// # Errors
/// A reading is missing or cannot be read, or the place cannot be written.
fn write_evaluated(
    chain: &Chain,
    mut table: ReadingsTable,
    mut evaluator: Evaluator,
    out: &std::path::Path,
) -> Result<Vec<String>, Failure> {
    table.want(chain, &evaluator.readings)?;
    let added: Vec<String> = evaluator.observables.iter().flat_map(|&id| column_names(chain, id)).collect();
    let header: Vec<String> = table.header().map(str::to_owned).collect();
    let kept: Vec<usize> = (0..header.len()).filter(|&column| !added.contains(&header[column])).collect();
    let mut not_finite = 0;
    tables::write(out, |writer| {
        writer.row(kept.iter().map(|&column| &header[column]).chain(&added))?;
        while let Some(rows) = table.next()? {
            let readings: Vec<_> =
                rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
            let columns = evaluator.columns(&readings, rows.count)?;
            for row in 0..rows.count {
                let computed: Vec<f64> = columns.iter().map(|column| column[row]).collect();
                not_finite += usize::from(computed.iter().any(|number| !number.is_finite()));
                let cells = kept.iter().map(|&column| rows.cells[column][row].clone());
                writer.row(cells.chain(computed.iter().copied().map(tables::number)))?;
            }
        }
        Ok(())
    })?;
    if not_finite > 0 {
        terminal::warn(format_args!("{not_finite} rows are not finite: the chain has a pole there"));
    }
    Ok(header.into_iter().filter(|name| added.contains(name)).collect())
}
