//! Readings corrected with calibrated errors, and which rows are outside of what these were found over.

use std::path::PathBuf;

use pyo3::prelude::*;
use trueaxis_cli::library::{self, Computed, Held};

use crate::chain::{Chain, Columns, Text, as_arrays, source};
use crate::errors;
use crate::tables::{Given, Table};

/// Of some rows: how many, how many outside of what the errors were found over, and for each range how many and how far.
type Counted = (usize, usize, Vec<(usize, f64)>);

/// Observables with their errors over a table of readings, `(name, columns)`, the table's own columns that they replace, and how many
/// rows are outside of what the errors were found over.
#[pyfunction]
pub fn apply(
    py: Python<'_>,
    chain: &Chain,
    table: (String, Given<'_>),
    errors: Text,
    observables: Vec<String>,
) -> PyResult<(Columns, Vec<String>, Counted)> {
    let (name, columns) = table;
    let table = Table::of(columns)?;
    let columns = table.columns()?;
    let (computed, counted) = errors::run(py, || {
        let (chain, table) = (chain.with_numbers()?, Held::new(&name, &columns)?);
        library::applied(chain, &source(errors), table, &observables)
    })?;
    let Computed { added, replaced } = computed;
    Ok((as_arrays(py, added), replaced, (counted.rows, counted.outside, counted.ranges)))
}

/// Warns of rows outside of what the errors were found over, counted table by table.
#[pyfunction]
pub fn warn_of_outside(py: Python<'_>, chain: &Chain, errors: Text, counted: Vec<Counted>) -> PyResult<()> {
    let counted = counted.into_iter();
    let counted = counted.map(|(rows, outside, ranges)| library::Counted { rows, outside, ranges });
    let counted: Vec<library::Counted> = counted.collect();
    errors::run(py, || library::warn_of_outside(chain.with_numbers()?, &source(errors), &counted))
}

/// A text that somebody wrote, from its file.
#[pyfunction]
pub fn read_text(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    errors::run(py, || Ok(library::read(&path)?.text))
}
