//! Tables of data as files: opened by the ending of their name, read in chunks, written whole.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;

use calibration::formats::{self, Cells, DataError, TableReader, Wanted, csv::Options, find_column};
use model_core::{Chain, SymbolId};

use crate::failure::Failure;
use crate::{output, source};

/// Rows that are read, computed and written at a time.
const CHUNK: usize = 4096;

/// A data file whose columns of readings are found by the names of joints and inputs.
pub struct ReadingsTable {
    reader: Box<dyn TableReader>,
    readings: Vec<SymbolId>,
    /// Every column as text, then the readings as numbers.
    wanted: Vec<Wanted>,
    /// Whether a row has been read.
    started: bool,
}

/// Some rows of a [`ReadingsTable`].
pub struct Rows {
    /// Every column of the file as text.
    pub cells: Vec<Vec<String>>,
    /// The readings, in SI.
    pub readings: Vec<(SymbolId, Vec<f64>)>,
    /// How many rows these are.
    pub count: usize,
}

impl ReadingsTable {
    /// Opens a file; `-` is standard input.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        known_format(path)?;
        let options = Options::default();
        let reader = if path == Path::new("-") {
            formats::open(io::stdin().lock(), "standard input", &options)
        } else {
            let file = File::open(path).map_err(|error| source::not_readable(path, &error))?;
            if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
                return Err(Failure::read(path, &io::ErrorKind::IsADirectory.into()));
            }
            formats::open(BufReader::new(file), &path.display().to_string(), &options)
        };
        let reader = reader.map_err(failure)?;
        let wanted = (0..reader.header().len()).map(|column| Wanted { column, factor: None }).collect();
        Ok(Self { reader, readings: Vec::new(), wanted, started: false })
    }

    /// Names of the columns, as they stand in the header.
    pub fn header(&self) -> impl Iterator<Item = &str> {
        self.reader.header().iter().map(|column| column.full.as_str())
    }

    /// Whether there is a column for each of these joints and inputs.
    #[must_use]
    pub fn has(&self, chain: &Chain, readings: &[SymbolId]) -> bool {
        let header = self.reader.header();
        readings.iter().all(|&id| find_column(header, &chain.symbol(id).name, "").is_ok())
    }

    /// Finds the columns of joints and inputs by their declared names; an angle or length without a unit in the
    /// header is in SI, as the command itself writes it.
    ///
    /// # Errors
    /// A column that is not there, or whose unit measures something else.
    pub fn want(&mut self, chain: &Chain, readings: &[SymbolId]) -> Result<(), Failure> {
        for &id in readings {
            let symbol = chain.symbol(id);
            let header = self.reader.header();
            let column = find_column(header, &symbol.name, self.reader.source()).map_err(failure)?;
            let factor =
                header[column].factor(symbol.quantity, None, true, self.reader.source()).map_err(failure)?;
            self.readings.push(id);
            self.wanted.push(Wanted { column, factor: Some(factor) });
        }
        Ok(())
    }

    /// The next rows; `None` at the end.
    ///
    /// # Errors
    /// A cell that cannot be read, with its place; no rows at all.
    pub fn next(&mut self) -> Result<Option<Rows>, Failure> {
        let chunk = self.reader.read(&self.wanted, CHUNK).map_err(failure)?;
        if chunk.rows.is_empty() {
            let file = self.reader.source().to_owned();
            return if self.started { Ok(None) } else { Err(failure(DataError::NoRows { file })) };
        }
        self.started = true;
        let mut rows = Rows { cells: Vec::new(), readings: Vec::new(), count: chunk.rows.len() };
        let mut ids = self.readings.iter();
        for column in chunk.columns {
            match column {
                Cells::Labels(labels) => rows.cells.push(labels),
                Cells::Numbers(numbers) => {
                    if let Some(&id) = ids.next() {
                        rows.readings.push((id, numbers));
                    }
                }
            }
        }
        Ok(Some(rows))
    }
}

/// A table that is being written, as its ending says.
pub enum TableWriter<'a> {
    /// Separated values, row by row.
    Csv {
        /// Where to.
        path: &'a Path,
        /// What writes the rows.
        inner: Box<::csv::Writer<&'a mut dyn Write>>,
    },
    /// Columns that are written when all rows are known.
    #[cfg(feature = "parquet")]
    Parquet {
        /// Names of the columns, once the first row has told them.
        names: Vec<String>,
        /// Their cells.
        columns: Vec<Vec<String>>,
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
    if ending(path) == "parquet" {
        return write_parquet(path, write);
    }
    output::write_with(path, |file| {
        let mut writer = TableWriter::Csv { path, inner: Box::new(::csv::Writer::from_writer(file)) };
        write(&mut writer)?;
        match writer {
            TableWriter::Csv { mut inner, .. } => inner.flush().map_err(|error| Failure::write(path, &error)),
            #[cfg(feature = "parquet")]
            TableWriter::Parquet { .. } => Ok(()),
        }
    })
}

#[cfg(feature = "parquet")]
fn write_parquet(
    path: &Path,
    write: impl FnOnce(&mut TableWriter) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (names, columns) = (Vec::new(), Vec::new());
    let mut writer = TableWriter::Parquet { names, columns };
    write(&mut writer)?;
    let TableWriter::Parquet { names, columns } = writer else { return Ok(()) };
    let bytes = formats::parquet::file_of(&names, &columns)
        .map_err(|error| Failure::write(path, &io::Error::other(error)))?;
    output::write_with(path, |file| file.write_all(&bytes).map_err(|error| Failure::write(path, &error)))
}

impl TableWriter<'_> {
    /// Writes one row of cells; the first is the header.
    ///
    /// # Errors
    /// The place cannot be written.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl AsRef<[u8]>>) -> Result<(), Failure> {
        match self {
            Self::Csv { path, inner } => inner.write_record(cells).map_err(|error| match error.into_kind() {
                ::csv::ErrorKind::Io(error) => Failure::write(path, &error),
                other => Failure::write(path, &io::Error::other(format!("{other:?}"))),
            }),
            #[cfg(feature = "parquet")]
            Self::Parquet { names, columns } => {
                let cells = cells.into_iter().map(|cell| String::from_utf8_lossy(cell.as_ref()).into_owned());
                if names.is_empty() {
                    names.extend(cells);
                    columns.resize(names.len(), Vec::new());
                } else {
                    columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
                }
                Ok(())
            }
        }
    }
}

/// A number as tables hold it: as short as reads back to the same number.
pub fn number(number: f64) -> String {
    format!("{number:?}")
}

fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Refuses a name that promises a format that this build neither reads nor writes.
fn known_format(path: &Path) -> Result<(), Failure> {
    if cfg!(not(feature = "parquet")) && ending(path) == "parquet" {
        return Err(failure(DataError::NoParquet { file: path.display().to_string() }));
    }
    if ["xlsx", "xls", "ods", "arrow", "feather"].contains(&ending(path).as_str()) {
        let message = format!(
            "`{}`: tables are read and written as .csv or .parquet; convert it first",
            path.display()
        );
        return Err(Failure::Input(message));
    }
    Ok(())
}

/// A mistake in a data file; its text names the file and the place.
pub fn failure(error: DataError) -> Failure {
    Failure::Input(error.to_string())
}
