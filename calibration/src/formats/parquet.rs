//! Parquet: flat tables of numbers and texts, plain, Snappy or Zstandard. Built with the feature `parquet` alone.
//!
//! Names of columns carry units as the headers of separated values do. The format keeps its table of contents at the end, so
//! a file is held in memory whole.

use std::cell;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use ::parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader as _, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::record::Field;
use ::parquet::record::reader::RowIter;
use ::parquet::schema::types::Type;
use bytes::Bytes;

use super::header::{ColumnName, unique};
use super::{Cell, Cells, Chunk, DataError, TableReader, Wanted};

/// A Parquet file.
pub struct Reader {
    source: String,
    header: Vec<ColumnName>,
    rows: RowIter<'static>,
    row: u64,
}

impl Reader {
    /// Reads the file whole, and its schema.
    ///
    /// # Errors
    /// No Parquet file, no columns, a name twice, or a column of lists or groups.
    pub fn new(mut reader: impl Read, source: &str) -> Result<Self, DataError> {
        let mut bytes = Vec::new();
        reader
            .read_to_end(&mut bytes)
            .map_err(|error| DataError::Unreadable { file: source.to_string(), why: error.to_string() })?;
        let file = guarded(source, || SerializedFileReader::new(Bytes::from(bytes)))?;
        let fields = file.metadata().file_metadata().schema().get_fields();
        let flat = |field: &Type| {
            field.is_primitive() && field.get_basic_info().repetition() != Repetition::REPEATED
        };
        if let Some(nested) = fields.iter().find(|field| !flat(field)) {
            let why =
                format!("column `{}` holds lists or groups: write one number or text a row", nested.name());
            return Err(DataError::Unreadable { file: source.to_string(), why });
        }
        let header: Vec<ColumnName> = fields.iter().map(|field| ColumnName::parse(field.name())).collect();
        if header.is_empty() {
            return Err(DataError::Empty { file: source.to_string() });
        }
        unique(&header, source)?;
        let rows = guarded(source, || Ok(RowIter::from_file_into(Box::new(file))))?;
        Ok(Self { source: source.to_string(), header, rows, row: 0 })
    }

    /// The place of a cell of the row that was read last.
    fn cell(&self, column: usize) -> Cell {
        let column = self.header.get(column).map_or_else(String::new, |name| name.full.clone());
        Cell { file: self.source.clone(), line: None, row: self.row, column }
    }

    /// The number in a cell of the row that was read last.
    fn number(&self, column: usize, field: &Field) -> Result<f64, DataError> {
        let number = match field {
            Field::Double(number) => Some(*number),
            Field::Float(number) => Some(f64::from(*number)),
            Field::Null => return Err(DataError::EmptyCell { cell: self.cell(column) }),
            other => text(other).trim().parse().ok(),
        };
        match number {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(DataError::NotFinite { cell: self.cell(column), text: text(field) }),
            None => Err(DataError::NotANumber { cell: self.cell(column), text: text(field) }),
        }
    }
}

/// What a cell says, as separated values would have it.
fn text(field: &Field) -> String {
    match field {
        Field::Null => String::new(),
        Field::Str(text) => text.clone(),
        Field::Double(number) => format!("{number:?}"),
        Field::Float(number) => format!("{number:?}"),
        other => other.to_string(),
    }
}

impl TableReader for Reader {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let mut columns = super::no_cells(wanted);
        let mut rows = Vec::new();
        while rows.len() < at_most {
            let Some(row) = guarded(&self.source, || self.rows.next().transpose())? else { break };
            let fields = row.into_columns();
            self.row += 1;
            for (want, cells) in wanted.iter().zip(&mut columns) {
                let field = fields.get(want.column).map_or(&Field::Null, |(_, field)| field);
                match cells {
                    Cells::Numbers(numbers) => {
                        numbers.push(self.number(want.column, field)? * want.factor.unwrap_or(1.0));
                    }
                    Cells::Labels(labels) => labels.push(text(field)),
                }
            }
            rows.push(self.row);
        }
        Ok(Chunk { columns, rows })
    }
}

thread_local! {
    /// Whether this thread is in a part of the crate's reader.
    static READING: cell::Cell<bool> = const { cell::Cell::new(false) };
}

/// Whether a panic of this thread would be one of the crate's reader: it becomes an error, and a program's panic hook need
/// say nothing of it.
#[must_use]
pub fn is_reading() -> bool {
    READING.get()
}

/// Runs a part of the crate's reader, which panics at some spoiled files instead of saying so.
fn guarded<T>(source: &str, read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, DataError> {
    let unreadable = |why: String| DataError::Unreadable { file: source.to_string(), why };
    READING.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(read));
    READING.set(false);
    match outcome {
        Ok(result) => result.map_err(|error| unreadable(error.to_string())),
        Err(_) => Err(unreadable("the file is spoiled: write it again".to_string())),
    }
}

/// A table as a Parquet file, with Snappy: a column whose cells are all numbers or empty as doubles, any other as text; an
/// empty cell as a null.
///
/// # Errors
/// What the format says, such as columns of different lengths.
pub fn file_of(names: &[String], columns: &[Vec<String>]) -> Result<Vec<u8>, ParquetError> {
    let numbers: Vec<Option<Vec<f64>>> = columns.iter().map(|cells| numbers(cells)).collect();
    let fields = names
        .iter()
        .zip(&numbers)
        .map(|(name, numbers)| {
            let physical = if numbers.is_some() { Physical::DOUBLE } else { Physical::BYTE_ARRAY };
            let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
            let builder = match numbers {
                Some(_) => builder,
                None => builder
                    .with_logical_type(Some(LogicalType::String))
                    .with_converted_type(ConvertedType::UTF8),
            };
            builder.build().map(Arc::new)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let properties = Arc::new(WriterProperties::builder().set_compression(Compression::SNAPPY).build());
    let mut file = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut file, schema, properties)?;
    let mut group = writer.next_row_group()?;
    for (cells, numbers) in columns.iter().zip(numbers) {
        let Some(mut column) = group.next_column()? else { break };
        let present: Vec<i16> = cells.iter().map(|cell| i16::from(!cell.is_empty())).collect();
        match numbers {
            Some(numbers) => column.typed::<DoubleType>().write_batch(&numbers, Some(&present), None)?,
            None => {
                let texts: Vec<ByteArray> =
                    cells.iter().filter(|cell| !cell.is_empty()).map(|cell| cell.as_str().into()).collect();
                column.typed::<ByteArrayType>().write_batch(&texts, Some(&present), None)?
            }
        };
        column.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(file)
}

/// The cells that are not empty as numbers, if there are any and all of them are.
fn numbers(cells: &[String]) -> Option<Vec<f64>> {
    let numbers: Option<Vec<f64>> =
        cells.iter().filter(|cell| !cell.is_empty()).map(|cell| cell.parse().ok()).collect();
    numbers.filter(|numbers| !numbers.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Written by `tests/reference/parquet.py`: az_deg and note, three rows.
    const SNAPPY: &[u8] = include_bytes!("../../tests/reference/snappy.parquet");
    const ZSTD: &[u8] = include_bytes!("../../tests/reference/zstd.parquet");
    const SPOILED: &[u8] = include_bytes!("../../tests/reference/spoiled.parquet");

    const WANTED: [Wanted; 2] = [Wanted { column: 0, factor: Some(2.0) }, Wanted { column: 1, factor: None }];

    fn read(bytes: &[u8]) -> Result<Chunk, DataError> {
        Reader::new(bytes, "run.parquet")?.read(&WANTED, usize::MAX)
    }

    #[test]
    fn files_of_another_program_are_read() {
        let labels = ["Mars", "Moon", ""].map(str::to_string).to_vec();
        let expected = Chunk {
            columns: vec![Cells::Numbers(vec![3.0, -8.0, 0.25]), Cells::Labels(labels)],
            rows: vec![1, 2, 3],
        };
        for bytes in [SNAPPY, ZSTD] {
            assert_eq!(read(bytes).as_ref(), Ok(&expected));
            let header = Reader::new(bytes, "run.parquet").map(|reader| reader.header().to_vec());
            assert_eq!(header.map(|header| header[0].unit.map(|unit| unit.name)), Ok(Some("deg")));
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let names = ["az_deg".to_string(), "note".to_string()];
        let columns = [vec!["1.5", "-4.0", "0.125"], vec!["Mars", "Moon", ""]];
        let columns = columns.map(|cells| cells.into_iter().map(str::to_string).collect::<Vec<_>>());
        let file = file_of(&names, &columns).unwrap_or_default();
        assert_eq!(read(&file), read(SNAPPY));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let of_column = |column| {
            Reader::new(SPOILED, "run.parquet")
                .and_then(|mut reader| reader.read(&[Wanted { column, factor: Some(1.0) }], usize::MAX))
                .map_err(|error| error.to_string())
        };
        let message = |bytes: &[u8]| read(bytes).map_err(|error| error.to_string());
        insta::assert_debug_snapshot!([
            of_column(0),
            of_column(1),
            of_column(2),
            of_column(3),
            message(b""),
            message(b"az_deg,note\n1,Mars\n"),
            message(&SNAPPY[..SNAPPY.len() - 20]),
        ]);
    }

    /// Every byte of a good file, spoiled: an error or other numbers, no panic.
    #[test]
    fn no_spoiled_byte_panics() {
        for at in 0..SNAPPY.len() {
            for mask in [0x01, 0x80, 0xFF] {
                let mut bytes = SNAPPY.to_vec();
                bytes[at] ^= mask;
                let _ = read(&bytes);
            }
        }
    }
}
