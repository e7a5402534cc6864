//! Tables that commands write, as the ending of their name says.

use std::io::{self, Write};
use std::path::Path;

use calibration::formats::{self, Kept};
#[cfg(feature = "parquet")]
use calibration::formats::{Options, parquet};

use super::{failure, known_format};
use crate::failure::Failure;
use crate::output;

/// Some rows of one column.
#[derive(Clone, Copy)]
pub enum Column<'a> {
    /// Cells that came from elsewhere, and leave as they came.
    Kept(&'a Kept),
    /// Numbers.
    Numbers(&'a [f64]),
}

/// A table that is being written.
pub enum TableWriter<'a> {
    /// Separated values, row by row.
    Csv {
        /// Where to.
        path: &'a Path,
        /// What takes the rows.
        file: &'a mut dyn Write,
    },
    /// Columns that are written when all rows are known.
    #[cfg(feature = "parquet")]
    Parquet {
        /// Where to.
        path: &'a Path,
        /// Names of the columns.
        names: Vec<String>,
        /// Their cells.
        columns: Vec<parquet::Column>,
        /// Memory that the cells take, about.
        bytes: usize,
    },
}

/// Writes a table file; it appears whole or not at all.
///
/// # Errors
/// The place cannot be written, or `write` failed.
pub fn write(
    path: &Path,
    write: impl FnOnce(&mut TableWriter) -> Result<(), Failure>,
) -> Result<(), Failure> {
    known_format(path)?;
    #[cfg(feature = "parquet")]
    if super::ending(path) == "parquet" {
        let (names, columns) = (Vec::new(), Vec::new());
        let mut writer = TableWriter::Parquet { path, names, columns, bytes: 0 };
        write(&mut writer)?;
        let TableWriter::Parquet { names, columns, .. } = writer else {
            unreachable!("a writer stays what it is")
        };
        let bytes = parquet::file_of(&names, columns)
            .map_err(|error| Failure::write(path, &io::Error::other(error)))?;
        return output::write_with(path, |file| {
            file.write_all(&bytes).map_err(|error| Failure::write(path, &error))
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
            Self::Parquet { path, names, .. } => {
                if header.iter().filter(|name| name.is_empty()).count() > 1 {
                    let message = format!(
                        "`{}`: several columns have no name, and a Parquet file could not tell them apart: name them, or write a \
                         .csv file",
                        path.display()
                    );
                    return Err(Failure::Input(message));
                }
                *names = header.to_vec();
                Ok(())
            }
        }
    }

    /// Writes some rows, column by column in the order of the header.
    ///
    /// # Errors
    /// The place cannot be written, or the rows take more memory than they may.
    pub fn rows(&mut self, rows: &[Column<'_>], count: usize) -> Result<(), Failure> {
        match self {
            Self::Csv { path, file } => {
                let texts = rows
                    .iter()
                    .map(|column| match column {
                        Column::Kept(kept) => kept.texts().map_err(failure),
                        Column::Numbers(numbers) => {
                            Ok(numbers.iter().copied().map(number).collect::<Vec<_>>().into())
                        }
                    })
                    .collect::<Result<Vec<_>, _>>()?;
                (0..count)
                    .try_for_each(|row| csv_row(*file, path, texts.iter().map(|column| column[row].as_str())))
            }
            #[cfg(feature = "parquet")]
            Self::Parquet { path, columns, bytes, .. } => {
                let is_first = columns.is_empty();
                for (at, column) in rows.iter().enumerate() {
                    let more = match *column {
                        Column::Kept(kept) => parquet::Column::Kept(kept.clone()),
                        Column::Numbers(numbers) => parquet::Column::Numbers(numbers.to_vec()),
                    };
                    *bytes += more.bytes();
                    if is_first {
                        columns.push(more);
                    } else {
                        columns[at].append(more);
                    }
                }
                Options::default().holds(*bytes, &path.display().to_string()).map_err(failure)
            }
        }
    }
}

/// Writes one row of separated values into the file of a name.
///
/// # Errors
/// The place cannot be written.
pub fn csv_row<'c>(
    file: &mut dyn Write,
    path: &Path,
    cells: impl IntoIterator<Item = &'c str>,
) -> Result<(), Failure> {
    formats::write_row(file, cells).map_err(|error: io::Error| Failure::write(path, &error))
}

/// A number as tables hold it: as short as reads back to the same number.
pub fn number(number: f64) -> String {
    format!("{number:?}")
}
