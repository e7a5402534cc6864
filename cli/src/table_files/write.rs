//! Tables that commands write, as the ending of their name says.

use std::io::{self, Write};
use std::path::Path;

use service::apply::write_separated;
use service::readings::ReadingsTable;
use tables::formats::{self, Column};
#[cfg(feature = "parquet")]
use tables::formats::{Options, parquet};

use super::known_format;
use crate::failure::Failure;
use crate::output;

/// A table that is being written.
pub enum TableWriter<'a> {
    /// Separated values, row by row.
    Csv {
        /// Where to.
        path: &'a Path,
        /// What takes the rows.
        file: &'a mut dyn Write,
    },
    /// Groups of rows, as they fill.
    #[cfg(feature = "parquet")]
    Parquet {
        /// Where to.
        path: &'a Path,
        /// What takes the bytes.
        file: &'a mut dyn Write,
        /// What makes them.
        writer: parquet::Writer,
    },
}

/// Writes a table file; it appears whole or not at all.
///
/// # Errors
/// The place cannot be written, or `write` failed.
pub fn write<T>(
    path: &Path,
    write: impl FnOnce(&mut TableWriter) -> Result<T, Failure>,
) -> Result<T, Failure> {
    known_format(path)?;
    #[cfg(feature = "parquet")]
    if super::ending(path) == "parquet" {
        return output::write_with(path, |file| {
            let mut table = TableWriter::Parquet { path, file, writer: parquet::Writer::new(Vec::new()) };
            let written = write(&mut table)?;
            let TableWriter::Parquet { file, writer, .. } = table else {
                unreachable!("a writer stays what it is")
            };
            put(file, path, writer.finish())?;
            Ok(written)
        });
    }
    output::write_with(path, |file| write(&mut TableWriter::Csv { path, file }))
}

impl TableWriter<'_> {
    /// Writes the names of the columns; comes first.
    ///
    /// # Errors
    /// The place cannot be written.
    pub fn header(&mut self, header: &[String]) -> Result<(), Failure> {
        match self {
            Self::Csv { path, file } => csv_row(*file, path, header.iter().map(String::as_str)),
            #[cfg(feature = "parquet")]
            Self::Parquet { path, writer, .. } => {
                if header.iter().filter(|name| name.is_empty()).count() > 1 {
                    let message = format!(
                        "`{}`: several columns have no name, and a Parquet file could not tell them apart: name them, or write a \
                         .csv file",
                        path.display()
                    );
                    return Err(Failure::Input(message));
                }
                *writer = parquet::Writer::new(header.to_vec());
                Ok(())
            }
        }
    }

    /// The same of a table whose columns are among them: `kept` says which of these each is. `tell` hears which share of it was read for that.
    ///
    /// # Errors
    /// The place cannot be written, or the table cannot be read.
    #[cfg_attr(not(feature = "parquet"), expect(unused_variables, reason = "separated values have no types"))]
    pub fn header_beside(
        &mut self,
        header: &[String],
        table: &ReadingsTable<'_>,
        kept: &[Option<usize>],
        tell: impl Fn(f64),
    ) -> Result<(), Failure> {
        self.header(header)?;
        #[cfg(feature = "parquet")]
        if let Self::Parquet { writer, .. } = self
            && let Some(known) = table.text_types(tell)?
        {
            let types =
                kept.iter().map(|column| column.and_then(|column| known.get(column).copied())).collect();
            *writer = parquet::Writer::with_types(header.to_vec(), types);
        }
        Ok(())
    }

    /// Writes some rows, column by column in the order of the header.
    ///
    /// # Errors
    /// The place cannot be written, or the rows take more memory than they may.
    pub fn rows(&mut self, rows: Vec<Column>, count: usize) -> Result<(), Failure> {
        match self {
            Self::Csv { path, file } => {
                let written = write_separated(*file, &rows, count)?;
                written.map_err(|error| Failure::write(path, &error))
            }
            #[cfg(feature = "parquet")]
            Self::Parquet { path, file, writer } => {
                put(*file, path, writer.rows(rows, count))?;
                // What is held is what has no type yet.
                Options::default().holds(writer.bytes(), "").map_err(|_| {
                    Failure::Input(format!(
                        "{}: texts have no type before the last is known, and these rows take too much memory to be held until then: \
                         give the data as a file, which is read twice, and not as a pipe; or write a .csv file",
                        path.display()
                    ))
                })
            }
        }
    }
}

/// Writes bytes of a Parquet file.
#[cfg(feature = "parquet")]
fn put<E: std::error::Error + Send + Sync + 'static>(
    file: &mut dyn Write,
    path: &Path,
    bytes: Result<Vec<u8>, E>,
) -> Result<(), Failure> {
    let written = bytes.map_err(io::Error::other).and_then(|bytes| file.write_all(&bytes));
    written.map_err(|error| Failure::write(path, &error))
}

/// Writes one row of separated values into the file of a name.
///
/// # Errors
/// The place cannot be written.
fn csv_row<'c>(
    file: &mut dyn Write,
    path: &Path,
    cells: impl IntoIterator<Item = &'c str>,
) -> Result<(), Failure> {
    formats::write_row(file, cells).map_err(|error: io::Error| Failure::write(path, &error))
}
