//! Observables over tables in memory: what `eval` and `apply` compute, for a program that has no command line.

use calibration::formats::TableReader;
use model_core::Chain;

use crate::apply::{Counted, Outside};
use crate::errors_file;
use crate::evaluation::{self, Evaluator, Exactness, Quantity};
use crate::failure::Failure;
use crate::over_table::warn_of_replaced;
use crate::source::Source;
use crate::tables::ReadingsTable;
use crate::terminal;

/// Names of columns, and the columns in SI.
pub type Columns = Vec<(String, Vec<f64>)>;

/// What is computed over a table.
pub struct Computed {
    /// The columns to add.
    pub added: Columns,
    /// The names of the table's own columns that these replace.
    pub replaced: Vec<String>,
}

/// The observables over a table of readings, as `eval` computes them.
///
/// # Errors
/// As the command says of `--data` and `--observable`.
pub fn evaluated(
    chain: &Chain,
    errors: &Source,
    reader: Box<dyn TableReader + '_>,
    names: &[String],
    quantity: (Exactness, Quantity),
) -> Result<Computed, Failure> {
    over_table(chain, errors, reader, names, quantity, &mut Outside::new(Vec::new()))
}

/// The observables with their errors over a table of readings, as `apply` computes them, and how many rows are outside of what the
/// errors were found over.
///
/// # Errors
/// As the command says of `--data` and `--observable`.
pub fn applied(
    chain: &Chain,
    errors: &Source,
    reader: Box<dyn TableReader + '_>,
    names: &[String],
) -> Result<(Computed, Counted), Failure> {
    let mut outside = Outside::new(errors_file::found_over(errors, chain)?);
    let quantity = (Exactness::Exact, Quantity::Value);
    let computed = over_table(chain, errors, reader, names, quantity, &mut outside)?;
    Ok((computed, outside.counted()))
}

/// Warns as `apply` does of rows outside of what the errors were found over, which were counted table by table.
///
/// # Errors
/// As the command says of `--errors`.
pub fn warn_of_outside(chain: &Chain, errors: &Source, counted: &[Counted]) -> Result<(), Failure> {
    let mut outside = Outside::new(errors_file::found_over(errors, chain)?);
    counted.iter().for_each(|counted| outside.add(counted));
    outside.warn(chain);
    Ok(())
}

fn over_table(
    chain: &Chain,
    errors: &Source,
    reader: Box<dyn TableReader + '_>,
    names: &[String],
    (form, quantity): (Exactness, Quantity),
    outside: &mut Outside,
) -> Result<Computed, Failure> {
    let values = errors_file::values(errors, chain)?;
    let mut table = ReadingsTable::of(reader, chain);
    let chosen = table.with_readings(chain, names)?;
    let evaluator = Evaluator::new(chain, chosen, form, quantity, &values);
    table.want(chain, &evaluator.readings)?;
    let header = evaluation::column_names(chain, &evaluator.observables)?;
    let mut columns = vec![Vec::new(); header.len()];
    while let Some(rows) = table.next()? {
        let readings: Vec<_> = rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
        outside.see(chain, &readings, &evaluator)?;
        let computed = evaluator.columns(&readings, rows.count)?;
        columns.iter_mut().zip(computed).for_each(|(column, more)| column.extend(more));
    }
    table.doubtful().for_each(terminal::warn);
    let is_replaced = table.replaced_by(&header);
    warn_of_replaced(&table, &is_replaced);
    Ok(Computed { added: header.into_iter().zip(columns).collect(), replaced: table.names_of(&is_replaced) })
}
