//! Tables as Parquet files, with Snappy: numbers as doubles, and what came from elsewhere as it came, of its own type or as texts; texts
//! that are all numbers, written as numbers are, become numbers, and an empty text a null.

use std::sync::Arc;

use ::parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FixedLenByteArrayType, FloatType, Int32Type,
    Int64Type,
};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnPath, Type, TypePtr};

use super::TypedCells;
use super::cells::Values;
use crate::formats::{Column, Kept, Texts};

/// Rows of a group, and bytes from which on it has fewer: what is held of a table whose types are known.
const GROUP: usize = 1 << 17;
const GROUP_BYTES: usize = 64 << 20;

/// Digits of a decimal number that a double holds in any case.
const DOUBLE_DIGITS: usize = 15;

impl Column {
    /// Appends more rows of the same column.
    pub fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Numbers(numbers), Self::Numbers(more)) => numbers.extend(more),
            (Self::Kept(kept), Self::Kept(more)) => kept.append(more),
            _ => unreachable!("the rows of one column are of one kind"),
        }
    }

    /// The memory that it takes, in bytes, about.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len() * size_of::<f64>(),
            Self::Kept(Kept::Texts(texts)) => texts.bytes(),
            Self::Kept(Kept::Typed(cells)) => cells.bytes(),
        }
    }
}

/// What the texts of a column are, as far as they have been seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TextType {
    /// Whether there is any but empty ones.
    is_any: bool,
    are_whole: bool,
    are_double: bool,
}

impl Default for TextType {
    fn default() -> Self {
        Self { is_any: false, are_whole: true, are_double: true }
    }
}

impl TextType {
    /// Sees more texts of the column.
    pub fn see(&mut self, texts: &Texts) {
        for text in texts.iter().filter(|text| !text.is_empty()) {
            self.is_any = true;
            self.are_whole = self.are_whole && whole(text).is_some();
            self.are_double = self.are_double && double(text).is_some();
        }
    }
}

/// A table that is being written: rows go in and the bytes of the file come out, group by group. Texts have no type before the
/// last is known, so that a table with a column of them comes out at the end, unless somebody has [seen](TextType) them before.
pub struct Writer {
    names: Vec<String>,
    /// Per column the type of its texts, where it is known.
    types: Vec<Option<TextType>>,
    /// Rows that have not come out.
    held: Vec<Column>,
    rows: usize,
    /// None before the types of the columns are known.
    file: Option<Box<SerializedFileWriter<Vec<u8>>>>,
}

impl Writer {
    /// A table of columns with these names.
    #[must_use]
    pub fn new(names: Vec<String>) -> Self {
        Self { types: vec![None; names.len()], names, held: Vec::new(), rows: 0, file: None }
    }

    /// The same where all texts of some columns have been seen, one entry a column: it comes out as it is written.
    #[must_use]
    pub fn with_types(names: Vec<String>, types: Vec<Option<TextType>>) -> Self {
        Self { types, ..Self::new(names) }
    }

    /// Takes in so many rows, column by column; returns the bytes of the file that are now known.
    ///
    /// # Errors
    /// What the format says, such as columns of different lengths.
    pub fn rows(&mut self, columns: Vec<Column>, count: usize) -> Result<Vec<u8>> {
        if self.held.is_empty() {
            self.held = columns;
        } else {
            self.held.iter_mut().zip(columns).for_each(|(held, more)| held.append(more));
        }
        self.rows += count;
        let has_type = |(column, of_texts): (&Column, &Option<TextType>)| {
            of_texts.is_some() || !matches!(column, Column::Kept(Kept::Texts(_)))
        };
        let waits = !self.held.iter().zip(&self.types).all(has_type);
        let is_full = self.rows >= GROUP || self.bytes() >= GROUP_BYTES;
        if waits || !is_full { Ok(Vec::new()) } else { self.group() }
    }

    /// The memory that what is held takes, in bytes, about.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.held.iter().map(Column::bytes).sum()
    }

    /// The rest of the file.
    ///
    /// # Errors
    /// As [`Writer::rows`].
    pub fn finish(mut self) -> Result<Vec<u8>> {
        let mut bytes = if self.held.is_empty() && self.file.is_some() { Vec::new() } else { self.group()? };
        if let Some(file) = self.file {
            bytes.extend((*file).into_inner()?);
        }
        Ok(bytes)
    }

    /// Writes what is held as a group of rows.
    fn group(&mut self) -> Result<Vec<u8>> {
        let columns: Vec<_> =
            self.names.iter().zip(std::mem::take(&mut self.held)).zip(&self.types).collect();
        let columns = parallel::each_of(columns, |((name, column), of_texts)| typed(name, column, *of_texts));
        let columns = columns.into_iter().collect::<Result<Vec<TypedCells>>>()?;
        self.rows = 0;
        let mut file = match self.file.take() {
            Some(file) => file,
            None => Box::new(begun(&columns)?),
        };
        let mut group = file.next_row_group()?;
        // What is written goes: the file holds it.
        for cells in columns {
            let Some(mut column) = group.next_column()? else { break };
            write(&mut column, &cells)?;
            column.close()?;
        }
        group.close()?;
        file.flush()?;
        let bytes = std::mem::take(file.inner_mut());
        self.file = Some(file);
        Ok(bytes)
    }
}

fn begun(columns: &[TypedCells]) -> Result<SerializedFileWriter<Vec<u8>>> {
    let fields = columns.iter().map(|column| column.of_type.clone()).collect();
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let doubles = columns.iter().filter(|column| matches!(column.values, Values::Double(_)));
    let properties = doubles.fold(
        WriterProperties::builder().set_compression(Compression::SNAPPY),
        // Numbers that hardly come twice are not worth a dictionary.
        |properties, column| {
            properties.set_column_dictionary_enabled(ColumnPath::from(column.of_type.name()), false)
        },
    );
    SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties.build()))
}

/// The column with a type of its own; what is not known of its texts is seen here.
fn typed(name: &str, column: Column, of_texts: Option<TextType>) -> Result<TypedCells> {
    let texts = match column {
        Column::Kept(Kept::Typed(cells)) => return Ok(cells),
        Column::Numbers(numbers) => {
            let levels = Some(vec![1; numbers.len()]);
            let of_type = optional(name, Physical::DOUBLE)?;
            return Ok(TypedCells { file: Arc::from(""), of_type, levels, values: Values::Double(numbers) });
        }
        Column::Kept(Kept::Texts(texts)) => texts,
    };
    let present = || texts.iter().filter(|text| !text.is_empty());
    let levels = Some(texts.iter().map(|text| i16::from(!text.is_empty())).collect());
    let of = |of_type, values| Ok(TypedCells { file: Arc::from(""), of_type, levels, values });
    let of_texts = of_texts.unwrap_or_else(|| {
        let mut seen = TextType::default();
        seen.see(&texts);
        seen
    });
    let changed = || ParquetError::General(format!("column `{name}` changed while it was read"));
    if of_texts.is_any && of_texts.are_whole {
        let longs: Option<Vec<i64>> = present().map(whole).collect();
        return of(optional(name, Physical::INT64)?, Values::Int64(longs.ok_or_else(changed)?));
    }
    if of_texts.is_any && of_texts.are_double {
        // That a double holds every digit has been seen.
        let finite = |text: &str| text.parse().ok().filter(|number: &f64| number.is_finite());
        let doubles: Option<Vec<f64>> = present().map(finite).collect();
        return of(optional(name, Physical::DOUBLE)?, Values::Double(doubles.ok_or_else(changed)?));
    }
    let builder = Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(Some(LogicalType::String))
        .with_converted_type(ConvertedType::UTF8);
    of(Arc::new(builder.build()?), Values::Bytes(present().map(ByteArray::from).collect()))
}

fn optional(name: &str, physical: Physical) -> Result<TypePtr> {
    let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
    builder.build().map(Arc::new)
}

/// A text as a whole number, if it is written as one: `007` and `+7` are not.
fn whole(text: &str) -> Option<i64> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let plain =
        digits.bytes().all(|byte| byte.is_ascii_digit()) && (digits == "0" || !digits.starts_with('0'));
    if plain && text != "-0" { text.parse().ok() } else { None }
}

/// A text as a number, if it is written as one and a double holds all its digits.
fn double(text: &str) -> Option<f64> {
    let number: f64 = text.parse().ok().filter(|number: &f64| number.is_finite())?;
    let size = text.strip_prefix('-').unwrap_or(text);
    let (mantissa, _) = size.split_once(['e', 'E']).unwrap_or((size, ""));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
    let plain = !whole.is_empty() && !fraction.is_empty() && (whole == "0" || !whole.starts_with('0'));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
    // Beyond these digits, only what a double would be written as.
    let held = digits <= DOUBLE_DIGITS || format!("{number:?}") == text;
    (plain && size.starts_with(|first: char| first.is_ascii_digit()) && held).then_some(number)
}

fn write(column: &mut SerializedColumnWriter<'_>, cells: &TypedCells) -> Result<()> {
    match &cells.values {
        Values::Bool(values) => batch::<BoolType>(column, cells, values),
        Values::Int32(values) => batch::<Int32Type>(column, cells, values),
        Values::Int64(values) => batch::<Int64Type>(column, cells, values),
        Values::Float(values) => batch::<FloatType>(column, cells, values),
        Values::Double(values) => batch::<DoubleType>(column, cells, values),
        Values::Bytes(values) => batch::<ByteArrayType>(column, cells, values),
        Values::Fixed(values) => batch::<FixedLenByteArrayType>(column, cells, values),
    }
}

fn batch<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    cells: &TypedCells,
    values: &[T::T],
) -> Result<()> {
    let written = column.typed::<T>().write_batch(values, cells.levels.as_deref(), None)?;
    if written != values.len() {
        return Err(ParquetError::General(format!(
            "column `{}` was not written whole",
            cells.of_type.name()
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Reader;
    use super::*;
    use crate::formats::{Cells, DataError, Form, Options, TableReader as _, Wanted};

    /// The columns of a file as they came, and what they say.
    fn read(file: &[u8]) -> std::result::Result<(Vec<Kept>, Vec<Vec<String>>), DataError> {
        let mut reader = Reader::new(file.into(), "f.parquet", &Options::default())?;
        let wanted: Vec<Wanted> =
            (0..reader.header().len()).map(|column| Wanted { column, form: Form::Kept }).collect();
        let mut kept = Vec::new();
        for cells in reader.read(&wanted, usize::MAX)?.columns {
            let Cells::Kept(column) = cells else { unreachable!("what was wanted") };
            kept.push(column);
        }
        let texts = kept
            .iter()
            .map(|column| column.texts().map(|texts| texts.iter().map(str::to_owned).collect()))
            .collect::<std::result::Result<Vec<_>, _>>()?;
        Ok((kept, texts))
    }

    /// A table written at once.
    fn file_of(names: &[String], columns: Vec<Column>) -> Result<Vec<u8>> {
        let mut writer = Writer::new(names.to_vec());
        let mut file = writer.rows(columns, 1)?;
        file.extend(writer.finish()?);
        Ok(file)
    }

    fn texts(cells: &[&str]) -> Column {
        Column::Kept(Kept::Texts(cells.iter().collect()))
    }

    #[test]
    fn texts_that_are_no_numbers_stay_texts() -> std::result::Result<(), Box<dyn std::error::Error>> {
        let columns = [
            ["007", "8", "9"],
            ["1.5", "-4.0", ""],
            ["1763758800123456789", "2", "3"],
            ["12345678901234567890", "2", "3"],
            ["1763758800123456", "-1", ""],
            ["0.1234567890123456789", "1.0", "2.0"],
            ["+1", "1", "1"],
            ["1e5", "1.0", "2.5e-9"],
            ["inf", "1.0", "2.0"],
            [".5", "1.0", "2.0"],
            ["", "", ""],
        ];
        let names: Vec<String> = (0..columns.len()).map(|at| format!("c{at}")).collect();
        let file = file_of(&names, columns.iter().map(|cells| texts(cells)).collect())?;
        let (kept, said) = read(&file)?;
        for (cells, said) in columns.iter().zip(&said) {
            if cells.contains(&"1e5") {
                assert_eq!(said, &["100000.0", "1.0", "2.5e-9"], "the same numbers");
            } else {
                assert_eq!(said, cells);
            }
        }
        let physical: Vec<Physical> = kept
            .iter()
            .map(|kept| match kept {
                Kept::Typed(cells) => cells.of_type.get_physical_type(),
                Kept::Texts(_) => unreachable!("a Parquet file has types"),
            })
            .collect();
        let (long, double, text) = (Physical::INT64, Physical::DOUBLE, Physical::BYTE_ARRAY);
        let expected = [text, double, long, text, long, text, text, double, text, text, text];
        assert_eq!(physical, expected);
        // What came from such a file goes back into one as it came.
        let again = file_of(&names, kept.iter().cloned().map(Column::Kept).collect())?;
        assert_eq!(read(&again)?, (kept, said));
        Ok(())
    }

    #[test]
    fn texts_that_were_seen_before_come_out_as_they_fill()
    -> std::result::Result<(), Box<dyn std::error::Error>> {
        // A whole number with more digits than a double holds, and only in another part a fraction: a text.
        let parts =
            [[["12345678901234567", "1", ""], ["2", "3", "4"]], [["0.5", "6", "7"], ["8", "0.1", ""]]];
        let mut types = vec![TextType::default(); 2];
        for part in &parts {
            types.iter_mut().zip(part).for_each(|(seen, cells)| seen.see(&cells.iter().collect()));
        }
        let names: Vec<String> = ["a".to_owned(), "b".to_owned()].into();
        let mut writer = Writer::with_types(names.clone(), types.into_iter().map(Some).collect());
        let mut file = Vec::new();
        for part in &parts {
            file.extend(writer.rows(part.iter().map(|cells| texts(cells)).collect(), GROUP)?);
            assert_eq!(writer.bytes(), 0);
        }
        file.extend(writer.finish()?);
        let (kept, said) = read(&file)?;
        assert_eq!(said[0], ["12345678901234567", "1", "", "0.5", "6", "7"]);
        assert_eq!(said[1], ["2.0", "3.0", "4.0", "8.0", "0.1", ""]);
        let held = file_of(&names, [0, 1].map(|at| texts(&[parts[0][at], parts[1][at]].concat())).into())?;
        assert_eq!(read(&held)?, (kept, said));
        // A file that changed in between is no reason for a wrong number.
        let mut writer = Writer::with_types(
            vec!["a".to_owned()],
            vec![Some(TextType { is_any: true, ..TextType::default() })],
        );
        assert!(
            writer.rows(vec![texts(&["x"])], GROUP).is_err_and(|error| error.to_string().contains("changed"))
        );
        Ok(())
    }

    #[test]
    fn groups_come_out_as_they_fill() -> std::result::Result<(), Box<dyn std::error::Error>> {
        const ROWS: usize = GROUP * 2 / 5;
        let mut writer = Writer::new(vec!["a".to_owned()]);
        let mut pieces = Vec::new();
        for part in 0..7 {
            let numbers = (0..ROWS).map(|row| (part * ROWS + row) as f64).collect();
            pieces.push(writer.rows(vec![Column::Numbers(numbers)], ROWS)?);
            assert!(writer.bytes() < 8 * (GROUP + ROWS));
        }
        assert!(pieces.iter().filter(|piece| !piece.is_empty()).count() == 2);
        pieces.push(writer.finish()?);
        let mut reader = Reader::new(pieces.concat().as_slice().into(), "f.parquet", &Options::default())?;
        let wanted = [Wanted { column: 0, form: Form::Number(1.0) }];
        let mut next = 0;
        loop {
            // No divisor of a group: chunks reach from one into the next.
            let chunk = reader.read(&wanted, 65_537)?;
            let Some(Cells::Numbers(numbers)) = chunk.columns.first() else {
                unreachable!("what was wanted")
            };
            assert!(numbers.iter().enumerate().all(|(at, number)| *number == (next + at) as f64));
            next += numbers.len();
            assert_eq!(chunk.rows.last().copied().unwrap_or(next as u64), next as u64);
            if numbers.is_empty() {
                break;
            }
        }
        assert_eq!(next, 7 * ROWS);
        Ok(())
    }

    #[test]
    fn every_type_goes_through_as_it_came() -> std::result::Result<(), Box<dyn std::error::Error>> {
        /// Written by `tests/reference/parquet.py`: a column of each type, with nulls.
        const TYPES: &[u8] = include_bytes!("../../../tests/reference/types.parquet");
        let (kept, said) = read(TYPES)?;
        let names: Vec<String> = (0..kept.len()).map(|at| format!("c{at}")).collect();
        let again = file_of(&names, kept.iter().cloned().map(Column::Kept).collect())?;
        assert_eq!(read(&again)?, (kept, said.clone()));
        insta::assert_debug_snapshot!(said);
        Ok(())
    }
}
