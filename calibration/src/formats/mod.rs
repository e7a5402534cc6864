//! Formats of measured data: one file a format, all read as tables of named columns, chunk by chunk.
//!
//! | format | file | ending |
//! |---|---|---|
//! | separated values | [`csv`] | anything else |
//! | TPOINT observations | [`tpoint`] | `.dat` |
//! | Parquet, with the feature of that name | `parquet` | `.parquet` |
//!
//! Formats are parsed from readers; opening files is the command's part.

pub mod csv;
mod error;
mod header;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod tpoint;

use std::io::Read;

pub use error::{Cell, DataError};
pub use header::{ColumnName, find_column};

/// One column of a chunk.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Finite numbers, times the factor that was asked for.
    Numbers(Vec<f64>),
    /// The text of the cells, without space around it.
    Labels(Vec<String>),
}

/// A column that is to be read, and as what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Index in the header.
    pub column: usize,
    /// As numbers times this factor (to SI), or as labels.
    pub factor: Option<f64>,
}

/// Consecutive rows of a file, column by column in the order wanted.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chunk {
    /// The columns that were wanted.
    pub columns: Vec<Cells>,
    /// Number of each row, counted from 1 without the header.
    pub rows: Vec<u64>,
}

/// A table that is read front to back.
pub trait TableReader {
    /// Name of the file or stream, for messages.
    fn source(&self) -> &str;

    /// The columns there are.
    fn header(&self) -> &[ColumnName];

    /// The next rows, at most so many; no rows at the end.
    ///
    /// # Errors
    /// A cell that cannot be read as what was wanted, with its place.
    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError>;
}

/// A column without cells for each that is wanted: numbers where there is a factor, labels else.
fn no_cells(wanted: &[Wanted]) -> Vec<Cells> {
    let empty = |want: &Wanted| match want.factor {
        Some(_) => Cells::Numbers(Vec::new()),
        None => Cells::Labels(Vec::new()),
    };
    wanted.iter().map(empty).collect()
}

/// Opens a table by the ending of its name.
///
/// # Errors
/// The header cannot be read, or there is none.
pub fn open<'r>(
    reader: impl Read + 'r,
    source: &str,
    options: &csv::Options,
) -> Result<Box<dyn TableReader + 'r>, DataError> {
    let ending = source.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    match ending.as_deref() {
        Some("dat") => Ok(Box::new(tpoint::Reader::new(reader, source)?)),
        #[cfg(feature = "parquet")]
        Some("parquet") => Ok(Box::new(parquet::Reader::new(reader, source)?)),
        #[cfg(not(feature = "parquet"))]
        Some("parquet") => Err(DataError::NoParquet { file: source.to_string() }),
        _ => Ok(Box::new(csv::Reader::new(reader, source, options)?)),
    }
}
