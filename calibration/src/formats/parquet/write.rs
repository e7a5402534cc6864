//! Tables as Parquet files, with Snappy: numbers as doubles, and what came from elsewhere as it came.

use std::sync::Arc;

use ::parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FixedLenByteArray, FixedLenByteArrayType,
    FloatType, Int32Type, Int64Type,
};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::record::Field;
use ::parquet::schema::types::{Type, TypePtr};

use super::TypedCells;
use crate::formats::Kept;

/// Digits of a decimal number that a double holds in any case.
const DOUBLE_DIGITS: usize = 15;

/// A column of a table to be written.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// Numbers, written as doubles.
    Numbers(Vec<f64>),
    /// A column that came from elsewhere: of its own type, or texts; texts that are all numbers, written as numbers are,
    /// become numbers. An empty text is a null.
    Kept(Kept),
}

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
            Self::Kept(Kept::Texts(texts)) => texts.iter().map(|text| text.len() + size_of::<String>()).sum(),
            Self::Kept(Kept::Typed(cells)) => cells.fields.len() * size_of::<Field>(),
        }
    }
}

/// A table as a Parquet file.
///
/// # Errors
/// What the format says, such as columns of different lengths.
pub fn file_of(names: &[String], columns: Vec<Column>) -> Result<Vec<u8>> {
    let columns = names
        .iter()
        .zip(columns)
        .map(|(name, column)| typed(name, column))
        .collect::<Result<Vec<TypedCells>>>()?;
    let fields = columns.iter().map(|column| column.of_type.clone()).collect();
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let properties = Arc::new(WriterProperties::builder().set_compression(Compression::SNAPPY).build());
    let mut file = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut file, schema, properties)?;
    let mut group = writer.next_row_group()?;
    for cells in &columns {
        let Some(mut column) = group.next_column()? else { break };
        write(&mut column, cells)?;
        column.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(file)
}

/// The column with a type of its own.
fn typed(name: &str, column: Column) -> Result<TypedCells> {
    let texts = match column {
        Column::Kept(Kept::Typed(cells)) => return Ok(cells),
        Column::Numbers(numbers) => {
            let fields = numbers.into_iter().map(Field::Double).collect();
            return Ok(TypedCells { of_type: optional(name, Physical::DOUBLE)?, fields });
        }
        Column::Kept(Kept::Texts(texts)) => texts,
    };
    let present = || texts.iter().filter(|text| !text.is_empty());
    let any = present().next().is_some();
    let field = |of: &dyn Fn(&str) -> Field| -> Vec<Field> {
        let of = |text: &String| if text.is_empty() { Field::Null } else { of(text) };
        texts.iter().map(of).collect()
    };
    let (of_type, fields) = if any && present().all(|text| whole(text).is_some()) {
        (optional(name, Physical::INT64)?, field(&|text| whole(text).map_or(Field::Null, Field::Long)))
    } else if any && present().all(|text| double(text).is_some()) {
        (optional(name, Physical::DOUBLE)?, field(&|text| double(text).map_or(Field::Null, Field::Double)))
    } else {
        let builder = Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(Some(LogicalType::String))
            .with_converted_type(ConvertedType::UTF8);
        (Arc::new(builder.build()?), field(&|text| Field::Str(text.to_owned())))
    };
    Ok(TypedCells { of_type, fields })
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
    let of_type = &cells.of_type;
    match of_type.get_physical_type() {
        Physical::BOOLEAN => batch::<BoolType>(column, cells, &|field| match field {
            Field::Bool(value) => Some(*value),
            _ => None,
        }),
        // The widths are those of the types that the fields were read from: nothing is cut off.
        #[allow(clippy::cast_possible_wrap)]
        Physical::INT32 => batch::<Int32Type>(column, cells, &|field| match field {
            Field::Byte(value) => Some(i32::from(*value)),
            Field::Short(value) => Some(i32::from(*value)),
            Field::Int(value) | Field::Date(value) | Field::TimeMillis(value) => Some(*value),
            Field::UByte(value) => Some(i32::from(*value)),
            Field::UShort(value) => Some(i32::from(*value)),
            Field::UInt(value) => Some(*value as i32),
            Field::Decimal(value) => value.data().try_into().ok().map(i32::from_be_bytes),
            _ => None,
        }),
        #[allow(clippy::cast_possible_wrap)]
        Physical::INT64 => batch::<Int64Type>(column, cells, &|field| match field {
            Field::Long(value)
            | Field::TimeMicros(value)
            | Field::TimestampMillis(value)
            | Field::TimestampMicros(value) => Some(*value),
            Field::ULong(value) => Some(*value as i64),
            Field::Decimal(value) => value.data().try_into().ok().map(i64::from_be_bytes),
            _ => None,
        }),
        Physical::FLOAT => batch::<FloatType>(column, cells, &|field| match field {
            Field::Float(value) => Some(*value),
            _ => None,
        }),
        Physical::DOUBLE => batch::<DoubleType>(column, cells, &|field| match field {
            Field::Double(value) => Some(*value),
            _ => None,
        }),
        Physical::BYTE_ARRAY => batch::<ByteArrayType>(column, cells, &bytes),
        Physical::FIXED_LEN_BYTE_ARRAY => {
            batch::<FixedLenByteArrayType>(column, cells, &|field| bytes(field).map(FixedLenByteArray::from))
        }
        Physical::INT96 => Err(ParquetError::NYI("times as INT96".to_owned())),
    }
}

fn bytes(field: &Field) -> Option<ByteArray> {
    match field {
        Field::Str(text) => Some(text.as_str().into()),
        Field::Bytes(bytes) => Some(bytes.clone()),
        Field::Decimal(value) => Some(ByteArray::from(value.data().to_vec())),
        Field::Float16(value) => Some(ByteArray::from(value.to_le_bytes().to_vec())),
        _ => None,
    }
}

/// Writes the cells that are there, and which of them are.
fn batch<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    cells: &TypedCells,
    value: &dyn Fn(&Field) -> Option<T::T>,
) -> Result<()> {
    let mut present = Vec::with_capacity(cells.fields.len());
    let mut values = Vec::with_capacity(cells.fields.len());
    for field in &cells.fields {
        present.push(i16::from(*field != Field::Null));
        if *field == Field::Null {
            continue;
        }
        let other = || ParquetError::General(format!("column `{}` holds {field}", cells.of_type.name()));
        values.push(value(field).ok_or_else(other)?);
    }
    let optional = cells.of_type.get_basic_info().repetition() == Repetition::OPTIONAL;
    column.typed::<T>().write_batch(&values, optional.then_some(present.as_slice()), None)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Reader;
    use super::*;
    use crate::formats::{Cells, DataError, Form, Options, TableReader as _, Wanted};

    /// The columns of a file as they came, and what they say.
    fn read(file: &[u8]) -> std::result::Result<(Vec<Kept>, Vec<Vec<String>>), DataError> {
        let mut reader = Reader::new(file, "f.parquet", &Options::default())?;
        let wanted: Vec<Wanted> =
            (0..reader.header().len()).map(|column| Wanted { column, form: Form::Kept }).collect();
        let mut kept = Vec::new();
        for cells in reader.read(&wanted, usize::MAX)?.columns {
            let Cells::Kept(column) = cells else { unreachable!("what was wanted") };
            kept.push(column);
        }
        let texts = kept
            .iter()
            .map(|column| column.texts().map(std::borrow::Cow::into_owned))
            .collect::<std::result::Result<Vec<_>, _>>()?;
        Ok((kept, texts))
    }

    fn texts(cells: &[&str]) -> Column {
        Column::Kept(Kept::Texts(cells.iter().map(|cell| (*cell).to_owned()).collect()))
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
