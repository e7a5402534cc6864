//! Observables over tables in memory: what `eval` and `apply` compute, for a program that has no command line.

use std::io;

use model_core::Chain;
use tables::formats::memory::{Column, Reader};
use tables::formats::{self, Options};

use crate::apply::{
    As, AsMeasured, Beside, Correction, Counted, Layout, Outside, not_finite, not_finite_warnings,
    write_separated,
};
use crate::errors_file;
use crate::evaluation::{self, Evaluator, Exactness, Quantity};
use crate::instrument::Instrument;
use crate::readings::ReadingsTable;
use crate::refusal::Refusal;
use crate::source::Source;
use crate::warn::Warn;

/// Names of columns, and the columns in SI.
pub type Columns = Vec<(String, Vec<f64>)>;

/// A table in memory.
pub struct Held<'a> {
    reader: Reader<'a>,
    rows: usize,
}

impl<'a> Held<'a> {
    /// One of a name.
    ///
    /// # Errors
    /// No columns, a name twice, or columns of different lengths.
    pub fn new(name: &str, columns: &[(&'a str, Column<'a>)]) -> Result<Self, Refusal> {
        let reader = Reader::new(name, columns.iter().copied()).map_err(Refusal::of)?;
        Ok(Self { reader, rows: columns.first().map_or(0, |(_, column)| column.rows()) })
    }
}

/// Whether the system would give memory for so many numbers, rather than end the process.
#[must_use]
pub fn has_room(numbers: usize) -> bool {
    let mut room: Vec<f64> = Vec::new();
    let is_had = room.try_reserve_exact(numbers).is_ok();
    // What nobody looks at would not be asked for.
    std::hint::black_box(&room);
    is_had
}

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
    table: Held<'_>,
    names: &[String],
    quantity: (Exactness, Quantity),
    warn: Warn<'_>,
) -> Result<Computed, Refusal> {
    over_table(chain, errors, table, names, quantity, &mut Outside::new(Vec::new()), warn)
}

/// The observables with their errors over a table of readings, as `apply` computes them, and how many rows are outside of what the
/// errors were found over.
///
/// # Errors
/// As the command says of `--data` and `--observable`.
pub fn applied(
    chain: &Chain,
    errors: &Source,
    table: Held<'_>,
    names: &[String],
    warn: Warn<'_>,
) -> Result<(Computed, Counted), Refusal> {
    let mut outside = Outside::new(errors_file::found_over(errors, chain)?);
    let quantity = (Exactness::Exact, Quantity::Value);
    let computed = over_table(chain, errors, table, names, quantity, &mut outside, warn)?;
    Ok((computed, outside.counted()))
}

/// What `apply` warns of rows outside of what the errors were found over, which were counted table by table.
///
/// # Errors
/// As the command says of `--errors`.
pub fn outside_of_found(
    chain: &Chain,
    errors: &Source,
    counted: &[Counted],
) -> Result<Option<String>, Refusal> {
    let mut outside = Outside::new(errors_file::found_over(errors, chain)?);
    counted.iter().for_each(|counted| outside.add(counted));
    Ok(outside.warning(chain))
}

/// The text of a table, the bytes of a file of this name, corrected with an instrument as `apply` writes it: separated values with every
/// column of the table.
///
/// # Errors
/// As the command says of `--data`.
pub fn corrected(
    instrument: &Instrument,
    (name, bytes): (&str, &[u8]),
    beside: Beside,
    warn: Warn<'_>,
) -> Result<Vec<u8>, Refusal> {
    let chain = &instrument.chain;
    let headings = instrument.headings.as_ref();
    let options = headings.map_or_else(Options::default, |headings| headings.format);
    let reader = formats::open(bytes.to_vec(), name, &options).map_err(Refusal::of)?;
    let mut table = ReadingsTable::of(reader, chain).keeping_all();
    if let Some(headings) = headings {
        table = table.headed_by(headings, &[]);
    }
    let seen = table.source_of_study().and_then(|source| AsMeasured::of(instrument, source));
    let mut correction = match seen {
        Some(seen) => Correction::as_measured(instrument, seen, &mut table, beside)?,
        None => {
            let asked = (table.with_readings(chain, &[])?, As::Vector, false);
            let of = (instrument.values.as_slice(), instrument.found.clone());
            Correction::of_observables(chain, of, Some(instrument), asked, &mut table, beside)?
        }
    };
    let layout = Layout::of(&table, &correction.added, correction.place);
    let mut out = Vec::new();
    let unwritten = |error: io::Error| Refusal::Input(error.to_string());
    formats::write_row(&mut out, layout.header.iter().map(String::as_str)).map_err(unwritten)?;
    let mut infinite = 0;
    while let Some(rows) = table.next_rows()? {
        let computed = correction.rows(&rows)?;
        infinite += not_finite(&computed, rows.count);
        let columns = layout.rows(rows.kept, computed);
        write_separated(&mut out, &columns, rows.count)?.map_err(unwritten)?;
    }
    table.doubtful().for_each(|doubt| warn(doubt.to_string()));
    table.lost(&layout.is_replaced).into_iter().for_each(warn);
    not_finite_warnings(infinite, table.without_reading()).into_iter().for_each(warn);
    correction.warning().into_iter().for_each(warn);
    Ok(out)
}

fn over_table(
    chain: &Chain,
    errors: &Source,
    table: Held<'_>,
    names: &[String],
    (form, quantity): (Exactness, Quantity),
    outside: &mut Outside,
    warn: Warn<'_>,
) -> Result<Computed, Refusal> {
    let values = errors_file::values(errors, chain, warn)?;
    let Held { reader, rows } = table;
    let mut table = ReadingsTable::of(Box::new(reader), chain);
    let chosen = table.with_readings(chain, names)?;
    let evaluator = Evaluator::new(chain, chosen, form, quantity, &values);
    table.want(chain, &evaluator.readings)?;
    let header = evaluation::column_names(chain, &evaluator.observables)?;
    let numbers = header.len();
    // A column beside them for the rows that are being computed.
    if !rows.checked_mul(numbers + 1).is_some_and(has_room) {
        return Err(Refusal::Input(format!(
            "the table: {numbers} numbers for each of its {rows} rows do not fit into memory: give fewer rows at once"
        )));
    }
    let mut columns: Vec<Vec<f64>> = header.iter().map(|_| Vec::with_capacity(rows)).collect();
    while let Some(rows) = table.next_rows()? {
        let readings: Vec<_> = rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
        outside.see(chain, &readings, &evaluator)?;
        let computed = evaluator.columns(&readings, rows.count)?;
        columns.iter_mut().zip(computed).for_each(|(column, more)| column.extend(more));
    }
    table.doubtful().for_each(|doubt| warn(doubt.to_string()));
    let is_replaced = table.replaced_by(&header);
    table.lost(&is_replaced).into_iter().for_each(warn);
    Ok(Computed { added: header.into_iter().zip(columns).collect(), replaced: table.names_of(&is_replaced) })
}
