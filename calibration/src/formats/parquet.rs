//! Parquet: flat tables of numbers and texts, plain, Snappy or Zstandard. Built with the feature `parquet` alone.
//!
//! Names of columns carry units as the headers of separated values do. The format keeps its table of contents at the end, so
//! a file is held in memory whole.

mod bounded;
mod write;

use std::cell;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};

use ::parquet::basic::{Repetition, Type as Physical};
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader as _, SerializedFileReader};
use ::parquet::record::Field;
use ::parquet::record::reader::RowIter;
use ::parquet::schema::types::{Type, TypePtr};
use bytes::Bytes;

pub use write::{Column, file_of};

use super::header::{ColumnName, unique};
use super::{Cell, Cells, Chunk, DataError, Form, Kept, Options, TableReader, Wanted};
use bounded::BoundedFile;

/// A Parquet file.
pub struct Reader {
    source: String,
    header: Vec<ColumnName>,
    types: Vec<TypePtr>,
    rows: RowIter<'static>,
    row: u64,
}

/// Cells as a file holds them, with their type.
#[derive(Debug, Clone, PartialEq)]
pub struct TypedCells {
    of_type: TypePtr,
    fields: Vec<Field>,
}

impl Reader {
    /// Reads the file whole, and its schema.
    ///
    /// # Errors
    /// No Parquet file, larger than the memory budget, no columns, a name twice, or a column of lists or groups.
    pub fn new(reader: impl Read, source: &str, options: &Options) -> Result<Self, DataError> {
        let bytes = super::whole(reader, source, options)?;
        let file = guarded(source, || SerializedFileReader::new(Bytes::from(bytes)))?;
        let types = file.metadata().file_metadata().schema().get_fields().to_vec();
        let flat = |field: &Type| {
            field.is_primitive() && field.get_basic_info().repetition() != Repetition::REPEATED
        };
        if let Some(nested) = types.iter().find(|field| !flat(field)) {
            let why =
                format!("column `{}` holds lists or groups: write one number or text a row", nested.name());
            return Err(DataError::Unreadable { file: source.to_string(), why });
        }
        let header: Vec<ColumnName> = types.iter().map(|field| ColumnName::parse(field.name())).collect();
        if header.is_empty() {
            return Err(DataError::Empty { file: source.to_string() });
        }
        unique(&header, source)?;
        let file = BoundedFile { inner: file, memory_bytes: options.memory_bytes };
        let rows = guarded(source, || Ok(RowIter::from_file_into(Box::new(file))))?;
        Ok(Self { source: source.to_string(), header, types, rows, row: 0 })
    }

    /// The place of a cell of the row that was read last.
    fn cell(&self, column: usize) -> Cell {
        let column = self.header.get(column).map_or_else(String::new, |name| name.full.clone());
        Cell { file: self.source.clone(), line: None, row: self.row, column }
    }

    /// The number in a cell of the row that was read last.
    fn number(&self, column: usize, field: &Field) -> Result<f64, DataError> {
        let text = guarded(&self.source, || Ok(text(field)))?;
        let number = match field {
            Field::Double(number) => Some(*number),
            Field::Float(number) => Some(f64::from(*number)),
            Field::Null => return Err(DataError::EmptyCell { cell: self.cell(column) }),
            _ => text.trim().parse().ok(),
        };
        match number {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(DataError::NotFinite { cell: self.cell(column), text }),
            None => Err(DataError::NotANumber { cell: self.cell(column), text }),
        }
    }

    /// A column without cells for each that is wanted, of its type where it is to be kept.
    fn no_cells(&self, wanted: &[Wanted]) -> Result<Vec<Cells>, DataError> {
        let mut columns = super::no_cells(wanted);
        for (want, cells) in wanted.iter().zip(&mut columns) {
            let (Cells::Kept(kept), Some(of_type)) = (cells, self.types.get(want.column)) else { continue };
            if of_type.get_physical_type() == Physical::INT96 {
                let why = format!(
                    "column `{}` holds times as INT96, which newer programs no longer write: write it as timestamps",
                    of_type.name()
                );
                return Err(DataError::Unreadable { file: self.source.clone(), why });
            }
            *kept = Kept::Typed(TypedCells { of_type: of_type.clone(), fields: Vec::new() });
        }
        Ok(columns)
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

impl TypedCells {
    /// What the cells say, as separated values would have it.
    ///
    /// # Errors
    /// A time that no calendar has.
    pub(super) fn texts(&self) -> Result<Vec<String>, DataError> {
        guarded(self.of_type.name(), || Ok(self.fields.iter().map(text).collect()))
    }

    /// Appends cells of the same column.
    pub(super) fn append(&mut self, more: Self) {
        self.fields.extend(more.fields);
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
        let mut columns = self.no_cells(wanted)?;
        let mut rows = Vec::new();
        while rows.len() < at_most {
            let Some(row) = guarded(&self.source, || self.rows.next().transpose())? else { break };
            let fields = row.into_columns();
            self.row += 1;
            for (want, cells) in wanted.iter().zip(&mut columns) {
                let field = fields.get(want.column).map_or(&Field::Null, |(_, field)| field);
                match (want.form, cells) {
                    (Form::Number(factor), Cells::Numbers(numbers)) => {
                        numbers.push(self.number(want.column, field)? * factor);
                    }
                    (Form::Label, Cells::Labels(labels)) => {
                        labels.push(guarded(&self.source, || Ok(text(field)))?);
                    }
                    (Form::Kept, Cells::Kept(Kept::Typed(kept))) => kept.fields.push(field.clone()),
                    _ => unreachable!("`no_cells` made a column of each form that is wanted"),
                }
            }
            rows.push(self.row);
        }
        Ok(Chunk { columns, rows, lines: Vec::new() })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Written by `tests/reference/parquet.py`: az_deg and note, three rows.
    const SNAPPY: &[u8] = include_bytes!("../../tests/reference/snappy.parquet");
    const ZSTD: &[u8] = include_bytes!("../../tests/reference/zstd.parquet");
    const SPOILED: &[u8] = include_bytes!("../../tests/reference/spoiled.parquet");

    const WANTED: [Wanted; 2] =
        [Wanted { column: 0, form: Form::Number(2.0) }, Wanted { column: 1, form: Form::Label }];

    fn open(bytes: &[u8]) -> Result<Reader, DataError> {
        Reader::new(bytes, "run.parquet", &Options::default())
    }

    fn read(bytes: &[u8]) -> Result<Chunk, DataError> {
        open(bytes)?.read(&WANTED, usize::MAX)
    }

    #[test]
    fn files_of_another_program_are_read() {
        let labels = ["Mars", "Moon", ""].map(str::to_string).to_vec();
        let expected = Chunk {
            columns: vec![Cells::Numbers(vec![3.0, -8.0, 0.25]), Cells::Labels(labels)],
            rows: vec![1, 2, 3],
            lines: Vec::new(),
        };
        for bytes in [SNAPPY, ZSTD] {
            assert_eq!(read(bytes).as_ref(), Ok(&expected));
            let header = open(bytes).map(|reader| reader.header().to_vec());
            assert_eq!(header.map(|header| header[0].unit().map(|unit| unit.name)), Ok(Some("deg")));
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let of_column = |column| {
            open(SPOILED)
                .and_then(|mut reader| reader.read(&[Wanted { column, form: Form::Number(1.0) }], usize::MAX))
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
