//! Cells of a Parquet column as the file holds them: values with their type, and which cells have one.

use std::sync::Arc;

use ::parquet::basic::Type as Physical;
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{ByteArray, DataType, FixedLenByteArray};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::record::Field;
use ::parquet::schema::types::{ColumnDescPtr, ColumnDescriptor, ColumnPath, TypePtr};

/// Cells that are unpacked at a time: the crate makes room for as many as a page claims to have.
const STEP: usize = 1 << 13;

/// What is wrong with a column that ends before its rows do.
pub(super) const FEWER: &str = "a column has fewer cells than the file says";

/// Cells with their type.
#[derive(Debug, Clone, PartialEq)]
pub struct TypedCells {
    /// The file that they came from, for messages.
    pub file: Arc<str>,
    pub(super) of_type: TypePtr,
    /// Per cell 1 where it has a value and 0 where it has none; none at all where every cell has one.
    pub(super) levels: Option<Vec<i16>>,
    /// Of the cells that have one.
    pub(super) values: Values,
}

/// Values of one physical type.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    Bool(Vec<bool>),
    Int32(Vec<i32>),
    Int64(Vec<i64>),
    Float(Vec<f32>),
    Double(Vec<f64>),
    Bytes(Vec<ByteArray>),
    Fixed(Vec<FixedLenByteArray>),
}

impl Values {
    fn none(of_type: Physical) -> Result<Self> {
        Ok(match of_type {
            Physical::BOOLEAN => Self::Bool(Vec::new()),
            Physical::INT32 => Self::Int32(Vec::new()),
            Physical::INT64 => Self::Int64(Vec::new()),
            Physical::FLOAT => Self::Float(Vec::new()),
            Physical::DOUBLE => Self::Double(Vec::new()),
            Physical::BYTE_ARRAY => Self::Bytes(Vec::new()),
            Physical::FIXED_LEN_BYTE_ARRAY => Self::Fixed(Vec::new()),
            Physical::INT96 => return Err(ParquetError::NYI("times as INT96".to_owned())),
        })
    }

    fn len(&self) -> usize {
        match self {
            Self::Bool(values) => values.len(),
            Self::Int32(values) => values.len(),
            Self::Int64(values) => values.len(),
            Self::Float(values) => values.len(),
            Self::Double(values) => values.len(),
            Self::Bytes(values) => values.len(),
            Self::Fixed(values) => values.len(),
        }
    }

    /// A value as the type of its column means it.
    fn field(&self, at: usize, column: &ColumnDescPtr) -> Result<Field> {
        Ok(match self {
            Self::Bool(values) => Field::convert_bool(column, values[at]),
            Self::Int32(values) => Field::convert_int32(column, values[at]),
            Self::Int64(values) => Field::convert_int64(column, values[at]),
            Self::Float(values) => Field::convert_float(column, values[at]),
            Self::Double(values) => Field::convert_double(column, values[at]),
            Self::Bytes(values) => Field::convert_byte_array(column, values[at].clone())?,
            Self::Fixed(values) => Field::convert_byte_array(column, values[at].clone().into())?,
        })
    }

    fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Bool(values), Self::Bool(more)) => extend(values, more),
            (Self::Int32(values), Self::Int32(more)) => extend(values, more),
            (Self::Int64(values), Self::Int64(more)) => extend(values, more),
            (Self::Float(values), Self::Float(more)) => extend(values, more),
            (Self::Double(values), Self::Double(more)) => extend(values, more),
            (Self::Bytes(values), Self::Bytes(more)) => extend(values, more),
            (Self::Fixed(values), Self::Fixed(more)) => extend(values, more),
            _ => unreachable!("the cells of one column are of one type"),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Bool(values) => values.len(),
            Self::Int32(values) => size_of_val(values.as_slice()),
            Self::Int64(values) => size_of_val(values.as_slice()),
            Self::Float(values) => size_of_val(values.as_slice()),
            Self::Double(values) => size_of_val(values.as_slice()),
            Self::Bytes(values) => values.iter().map(|value| value.len() + size_of::<ByteArray>()).sum(),
            Self::Fixed(values) => values.iter().map(|value| value.len() + size_of::<ByteArray>()).sum(),
        }
    }
}

impl TypedCells {
    /// No cells of a type.
    pub(super) fn none(of_type: &TypePtr, file: &Arc<str>) -> Result<Self> {
        let levels = of_type.is_optional().then(Vec::new);
        let values = Values::none(of_type.get_physical_type())?;
        Ok(Self { file: Arc::clone(file), of_type: of_type.clone(), levels, values })
    }

    /// So many cells, in one column of a file, that come next; fewer at the end.
    pub(super) fn read(
        reader: &mut ColumnReader,
        of_type: &TypePtr,
        count: usize,
        file: &Arc<str>,
    ) -> Result<Self> {
        let mut cells = Self::none(of_type, file)?;
        let levels = cells.levels.as_mut();
        match (reader, &mut cells.values) {
            (ColumnReader::BoolColumnReader(reader), Values::Bool(to)) => records(reader, count, levels, to),
            (ColumnReader::Int32ColumnReader(reader), Values::Int32(to)) => {
                records(reader, count, levels, to)
            }
            (ColumnReader::Int64ColumnReader(reader), Values::Int64(to)) => {
                records(reader, count, levels, to)
            }
            (ColumnReader::FloatColumnReader(reader), Values::Float(to)) => {
                records(reader, count, levels, to)
            }
            (ColumnReader::DoubleColumnReader(reader), Values::Double(to)) => {
                records(reader, count, levels, to)
            }
            (ColumnReader::ByteArrayColumnReader(reader), Values::Bytes(to)) => {
                records(reader, count, levels, to)
            }
            (ColumnReader::FixedLenByteArrayColumnReader(reader), Values::Fixed(to)) => {
                records(reader, count, levels, to)
            }
            _ => Err(ParquetError::General("a column is of another type than the file says".to_owned())),
        }?;
        let held = cells.levels.as_ref().map_or(count, |levels| levels.iter().filter(|is| **is > 0).count());
        if cells.len() != count || cells.values.len() != held {
            return Err(ParquetError::General(FEWER.to_owned()));
        }
        Ok(cells)
    }

    /// How many cells there are, with a value or without.
    pub(super) fn len(&self) -> usize {
        self.levels.as_ref().map_or_else(|| self.values.len(), Vec::len)
    }

    /// The numbers of the cells, where they are floating-point numbers and every cell has one.
    pub(super) fn doubles(&self) -> Option<Vec<f64>> {
        match &self.values {
            Values::Double(values) if values.len() == self.len() => Some(values.clone()),
            Values::Float(values) if values.len() == self.len() => {
                Some(values.iter().map(|&value| f64::from(value)).collect())
            }
            _ => None,
        }
    }

    /// Of each cell where its value stands among the values, if it has one.
    pub(super) fn places(&self) -> impl Iterator<Item = Option<usize>> {
        let mut next = 0;
        (0..self.len()).map(move |at| {
            if self.levels.as_ref().is_some_and(|levels| levels[at] == 0) {
                return None;
            }
            next += 1;
            Some(next - 1)
        })
    }

    /// Each cell as the type of the column means it.
    pub(super) fn fields(&self) -> impl Iterator<Item = Result<Field>> {
        let path = ColumnPath::from(self.of_type.name());
        let column = Arc::new(ColumnDescriptor::new(self.of_type.clone(), 0, 0, path));
        self.places().map(move |place| match place {
            None => Ok(Field::Null),
            Some(at) => self.values.field(at, &column),
        })
    }

    /// Appends cells of the same column.
    pub(in crate::formats) fn append(&mut self, more: Self) {
        if let (Some(levels), Some(more)) = (&mut self.levels, more.levels) {
            extend(levels, more);
        }
        self.values.append(more.values);
    }

    /// The memory that they take, in bytes, about.
    pub(super) fn bytes(&self) -> usize {
        self.values.bytes() + self.levels.as_ref().map_or(0, |levels| size_of_val(levels.as_slice()))
    }
}

/// Appends without room for as many again: a group of rows has few parts and many columns.
fn extend<T>(values: &mut Vec<T>, more: Vec<T>) {
    values.reserve_exact(more.len());
    values.extend(more);
}

fn records<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    count: usize,
    mut levels: Option<&mut Vec<i16>>,
    to: &mut Vec<T::T>,
) -> Result<()> {
    let mut left = count;
    while left > 0 {
        let (read, ..) = reader.read_records(left.min(STEP), levels.as_deref_mut(), None, to)?;
        if read == 0 {
            break;
        }
        left -= read;
    }
    Ok(())
}
