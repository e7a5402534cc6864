//! Parquet: flat tables of numbers and texts, plain, Snappy or Zstandard. Built with the feature `parquet` alone.
//!
//! Names of columns carry units as the headers of separated values do. The format keeps its table of contents at the end, so
//! what comes as a stream is held in memory as it is; of a file, pages are read as they are needed. Cells are unpacked chunk by
//! chunk, the columns of a chunk on all processors.

#[cfg(test)]
#[allow(clippy::expect_used)]
mod attacks;
mod bounded;
mod cells;
mod header;
mod held;
mod open;
mod ranges;
mod room;
mod times;
mod write;

use std::cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use ::parquet::basic::{Compression, Repetition, Type as Physical};
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::FileReader as _;
use ::parquet::record::Field;
use ::parquet::schema::types::{Type, TypePtr};

pub use cells::TypedCells;
pub use write::{TextType, Writer};

use super::header::{ColumnName, unique};
use super::{
    Cell, Cells, Chunk, DataError, Extent, Form, Input, Kept, Options, Ranged, TableReader, Texts, Wanted,
    clipped,
};
use bounded::BoundedFile;
use open::Open;
use ranges::Ranges;
use room::Room;
use times::Time;

/// A Parquet file.
pub struct Reader {
    source: String,
    header: Vec<ColumnName>,
    types: Vec<TypePtr>,
    file: BoundedFile,
    /// Groups of rows that were begun.
    groups: usize,
    /// Rows of the last of them, and those of them that were read.
    in_group: usize,
    taken: usize,
    /// Per column of the file what reads it; none where it is not open.
    open: Vec<Option<Open>>,
    row: u64,
    /// How far the file is read.
    extent: Extent,
}

impl Reader {
    /// Reads the schema.
    ///
    /// # Errors
    /// No Parquet file, a stream larger than the memory budget, no columns, a name twice, or a column of lists or groups.
    pub fn new(input: Input<'_>, source: &str, options: &Options) -> Result<Self, DataError> {
        let memory_bytes = options.memory_bytes;
        let Ranged { source: ranged, extent } = match input {
            Input::Stream(reader) => Ranged::held(super::whole(reader, source, options)?),
            Input::Ranged(ranged) => ranged,
        };
        if extent.length() == 0 {
            let why = "the file is empty".to_owned();
            return Err(DataError::Unreadable { file: source.to_string(), why });
        }
        let ranges = Ranges::of(ranged, extent.length(), memory_bytes);
        let file = guarded(source, || BoundedFile::open(ranges, memory_bytes))?;
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
        if let Some(codec) = unknown_codec(&file) {
            let why =
                format!("is compressed with {codec}, which is not read: write it with Snappy or Zstandard");
            return Err(DataError::Unreadable { file: source.to_string(), why });
        }
        let source = source.to_string();
        let open = Vec::new();
        Ok(Self { source, header, types, file, groups: 0, in_group: 0, taken: 0, open, row: 0, extent })
    }

    /// Begins the next group of rows; `false` behind the last.
    fn next_group(&mut self) -> Result<bool, DataError> {
        let Some(group) = self.file.metadata().row_groups().get(self.groups) else { return Ok(false) };
        let rows = usize::try_from(group.num_rows());
        let why = || "a group of rows has fewer than none: write it again".to_owned();
        self.in_group = rows.map_err(|_| DataError::Unreadable { file: self.source.clone(), why: why() })?;
        self.taken = 0;
        self.groups += 1;
        self.open = self.types.iter().map(|_| None).collect();
        Ok(true)
    }

    /// The next rows of this group in some columns, each once and in order; `is_dear` where they had better stay open.
    fn cells(
        &mut self,
        columns: &[usize],
        count: usize,
        is_dear: bool,
    ) -> Result<Vec<TypedCells>, DataError> {
        for &column in columns {
            let of_type = &self.types[column];
            if of_type.get_physical_type() == Physical::INT96 {
                let why = format!(
                    "column `{}` holds times as INT96, which newer programs no longer write: write it as timestamps",
                    of_type.name()
                );
                return Err(DataError::Unreadable { file: self.source.clone(), why });
            }
        }
        let (source, types, group, taken) = (&self.source, &self.types, self.groups - 1, self.taken);
        let (file, name) = (&self.file, Arc::from(source.as_str()));
        let open = self.open.iter_mut().enumerate();
        let wanted: Vec<_> = open.filter(|(column, _)| columns.binary_search(column).is_ok()).collect();
        let read = parallel::each_of(wanted, |(column, place)| {
            guarded(source, || {
                let open = match place {
                    Some(open) => open,
                    None => place.insert(Open::of(file, group, column)?),
                };
                let cells = open.cells(&types[column], taken, count, &name)?;
                if file.is_crowded(is_dear) {
                    *place = None;
                }
                Ok(cells)
            })
        });
        read.into_iter().collect()
    }

    /// Refuses times where numbers are wanted: those that a file holds as nanoseconds would be whole numbers of a thousand million.
    fn check_times(&self, wanted: &[Wanted]) -> Result<(), DataError> {
        let why = |want: &Wanted| {
            let of_type = &self.types[want.column];
            if Time::of(of_type).is_some() {
                Some("holds times, which are no numbers: write seconds since some instant")
            } else if times::is_interval(of_type) {
                Some("holds intervals of months, days and milliseconds, which are no numbers: write seconds")
            } else {
                None
            }
        };
        let of_numbers = wanted.iter().filter(|want| matches!(want.form, Form::Number(_)));
        match of_numbers.filter_map(|want| Some((want, why(want)?))).next() {
            None => Ok(()),
            Some((want, why)) => Err(DataError::UnusableColumn {
                file: self.source.clone(),
                column: self.header[want.column].full.clone(),
                why: why.to_owned(),
            }),
        }
    }

    /// The place of a cell of this row, counted from 0.
    fn cell(&self, column: usize, row: usize) -> Cell {
        let name = self.header.get(column).map_or_else(String::new, |name| name.full.clone());
        Cell { file: self.source.clone(), line: None, row: self.row + row as u64 + 1, column: name }
    }

    /// The numbers in the cells of a column.
    fn numbers(&self, column: usize, cells: &TypedCells, factor: f64) -> Result<Vec<f64>, DataError> {
        if let Some(mut numbers) = cells.doubles() {
            if let Some(row) = numbers.iter().position(|number| !number.is_finite()) {
                let text = format!("{:?}", numbers[row]);
                return Err(DataError::NotFinite { cell: self.cell(column, row), text });
            }
            numbers.iter_mut().for_each(|number| *number *= factor);
            return Ok(numbers);
        }
        let fields = cells.fields().enumerate();
        fields.map(|(row, field)| Ok(self.number(column, row, field)? * factor)).collect()
    }

    fn number(
        &self,
        column: usize,
        row: usize,
        field: Result<Field, ParquetError>,
    ) -> Result<f64, DataError> {
        let field = guarded(&self.source, || field)?;
        let text = guarded(&self.source, || Ok(text(&field)))?;
        let number = match field {
            Field::Double(number) => Some(number),
            Field::Float(number) => Some(f64::from(number)),
            Field::Float16(number) => Some(number.to_f64()),
            Field::Null => return Err(DataError::EmptyCell { cell: self.cell(column, row) }),
            _ => text.trim().parse().ok(),
        };
        match number {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(DataError::NotFinite { cell: self.cell(column, row), text: clipped(&text) }),
            None => Err(DataError::NotANumber { cell: self.cell(column, row), text: clipped(&text) }),
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
        // Of half precision the shortest digits are those of another number in any other precision.
        Field::Float16(number) => format!("{:?}", number.to_f64()),
        // Without digits behind the point there is none.
        Field::Decimal(_) => field.to_string().trim_end_matches('.').to_owned(),
        other => other.to_string(),
    }
}

impl TypedCells {
    /// What the cells say, as separated values would have it.
    ///
    /// # Errors
    /// Bytes that are called a text and are none.
    pub(super) fn texts(&self) -> Result<Texts, DataError> {
        let said = guarded(&self.file, || {
            if let Some(time) = Time::of(&self.of_type) {
                let texts = self.places().map(|place| {
                    let count = place.and_then(|at| Time::count(&self.values, at));
                    count.map_or_else(String::new, |count| time.text(count))
                });
                return Ok(texts.collect());
            }
            if times::is_interval(&self.of_type) {
                let texts = self
                    .places()
                    .map(|place| place.map_or_else(String::new, |at| times::interval(&self.values, at)));
                return Ok(texts.collect());
            }
            self.fields().map(|field| Ok(text(&field?))).collect()
        });
        said.map_err(|error| DataError::UnusableColumn {
            file: self.file.to_string(),
            column: self.of_type.name().to_owned(),
            why: format!("holds what is no text ({error}): write it as UTF-8"),
        })
    }
}

/// The codec of some part of a file, where it is one that this build does not have.
fn unknown_codec(file: &BoundedFile) -> Option<&'static str> {
    let parts = file.metadata().row_groups().iter().flat_map(|group| group.columns());
    parts.map(|part| part.compression()).find_map(|codec| match codec {
        Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::ZSTD(_) => None,
        Compression::GZIP(_) => Some("gzip"),
        Compression::BROTLI(_) => Some("Brotli"),
        Compression::LZ4 | Compression::LZ4_RAW => Some("LZ4"),
        Compression::LZO => Some("LZO"),
    })
}

impl TableReader for Reader {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let mut chunk = Chunk::default();
        let mut columns: Vec<usize> = wanted.iter().map(|want| want.column).collect();
        columns.sort_unstable();
        columns.dedup();
        self.check_times(wanted)?;
        let mut room = Room::of(columns.iter().map(|&column| self.types[column].get_physical_type()));
        loop {
            let left = self.in_group - self.taken;
            let count = room.rows().min(left).min(at_most - chunk.rows.len());
            if left == 0 && chunk.rows.len() < at_most && self.next_group()? {
                continue;
            }
            if count == 0 {
                break;
            }
            let is_dear = self.in_group > open::FEW.saturating_mul(room.usual().min(at_most));
            let cells = self.cells(&columns, count, is_dear)?;
            room.take(&cells, count);
            let of = |column: usize| match columns.binary_search(&column) {
                Ok(at) => &cells[at],
                Err(_) => unreachable!("every wanted column was read"),
            };
            let part = wanted.iter().map(|want| {
                let cells = of(want.column);
                Ok(match want.form {
                    Form::Number(factor) => Cells::Numbers(self.numbers(want.column, cells, factor)?),
                    Form::Label => Cells::Labels(cells.texts()?.iter().map(str::to_owned).collect()),
                    Form::Kept => Cells::Kept(Kept::Typed(cells.clone())),
                })
            });
            let columns = part.collect::<Result<Vec<_>, DataError>>()?;
            if chunk.columns.is_empty() {
                chunk.columns = columns;
            } else {
                chunk.append_part(Chunk { columns, ..Chunk::default() }, 0, 0);
            }
            chunk.rows.extend((1..=count as u64).map(|row| self.row + row));
            self.row += count as u64;
            self.taken += count;
        }
        // A spoiled file may say that it has less than no rows.
        if let Ok(all) = u64::try_from(self.file.metadata().file_metadata().num_rows()) {
            self.extent.rows(self.row, all);
        }
        if chunk.columns.is_empty() {
            chunk.columns = super::no_cells(wanted);
        }
        Ok(chunk)
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
        Ok(result) => result.map_err(|error| {
            unreadable(match error {
                // What it says is said without the crate's own words before it.
                ParquetError::General(why) => why,
                other => other.to_string(),
            })
        }),
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
        Reader::new(bytes.into(), "run.parquet", &Options::default())
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
            assert_eq!(header.map(|header| header[0].unit().map(|unit| unit.name())), Ok(Some("deg")));
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

    #[test]
    fn half_precision_is_exact_and_intervals_are_no_numbers() {
        let (half, interval): (&[u8], &[u8]) = (
            include_bytes!("../../tests/reference/half.parquet"),
            include_bytes!("../../tests/reference/interval.parquet"),
        );
        let read = |bytes: &[u8], form, rows| {
            let chunk = open(bytes).and_then(|mut reader| reader.read(&[Wanted { column: 0, form }], rows));
            chunk.map(|chunk| chunk.columns).map_err(|error| error.to_string())
        };
        let labels = |of: [&str; 3]| Ok(vec![Cells::Labels(of.map(str::to_owned).to_vec())]);
        assert_eq!(read(half, Form::Number(1.0), 1), Ok(vec![Cells::Numbers(vec![0.099_975_585_937_5])]));
        assert_eq!(read(half, Form::Label, 3), labels(["0.0999755859375", "", "-5.960464477539063e-8"]));
        assert_eq!(read(interval, Form::Label, 3), labels(["P2M3DT1.500S", "", "P0M0DT0.000S"]));
        let why = "run.parquet: column `interval` holds intervals of months, days and milliseconds, which are no numbers: write seconds";
        assert_eq!(read(interval, Form::Number(1.0), 3), Err(why.to_owned()));
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
