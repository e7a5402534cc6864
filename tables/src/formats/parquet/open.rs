//! One column of a group of rows, open at some row: its dictionary and a page of it are held until it is closed.

use std::sync::Arc;

use ::parquet::column::reader::ColumnReader;
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::reader::FileReader as _;
use ::parquet::schema::types::TypePtr;

use super::TypedCells;
use super::bounded::BoundedFile;

/// Chunks of a group up to which columns are closed behind each, where open ones hold much: each time, the dictionary and a page are
/// unpacked anew.
pub(super) const FEW: usize = 16;

/// A column of a group.
pub(super) struct Open {
    reader: ColumnReader,
    /// Rows of the group that it has read.
    read: usize,
}

impl Open {
    /// Opens a column of a file at the beginning of a group.
    ///
    /// # Errors
    /// The file is spoiled.
    pub fn of(file: &BoundedFile, group: usize, column: usize) -> Result<Self> {
        Ok(Self { reader: file.get_row_group(group)?.get_column_reader(column)?, read: 0 })
    }

    /// So many cells from a row of the group on, which it has not read.
    ///
    /// # Errors
    /// The file is spoiled.
    pub fn cells(
        &mut self,
        of_type: &TypePtr,
        from: usize,
        count: usize,
        file: &Arc<str>,
    ) -> Result<TypedCells> {
        self.skip(from - self.read)?;
        self.read = from + count;
        TypedCells::read(&mut self.reader, of_type, count, file)
    }

    fn skip(&mut self, count: usize) -> Result<()> {
        let skipped = match &mut self.reader {
            ColumnReader::BoolColumnReader(reader) => reader.skip_records(count),
            ColumnReader::Int32ColumnReader(reader) => reader.skip_records(count),
            ColumnReader::Int64ColumnReader(reader) => reader.skip_records(count),
            ColumnReader::Int96ColumnReader(reader) => reader.skip_records(count),
            ColumnReader::FloatColumnReader(reader) => reader.skip_records(count),
            ColumnReader::DoubleColumnReader(reader) => reader.skip_records(count),
            ColumnReader::ByteArrayColumnReader(reader) => reader.skip_records(count),
            ColumnReader::FixedLenByteArrayColumnReader(reader) => reader.skip_records(count),
        }?;
        if skipped == count { Ok(()) } else { Err(ParquetError::General(super::cells::FEWER.to_owned())) }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{Reader, Writer};
    use crate::formats::{Cells, Column, Form, Kept, Options, TableReader as _, Texts, Wanted};

    /// Where open columns would hold too much, they are closed, and go on where they were.
    #[test]
    fn columns_that_are_closed_go_on_where_they_were() {
        const ROWS: usize = 30_000;
        const COLUMNS: usize = 40;
        let number = |column: usize, row: usize| (row * COLUMNS + column) as f64 / 7.0;
        // Every third cell of the texts is empty.
        let text = |row: usize| if row.is_multiple_of(3) { String::new() } else { format!("at {row}") };
        let names = (0..=COLUMNS).map(|column| format!("c{column}")).collect();
        let mut columns: Vec<Column> = (0..COLUMNS)
            .map(|column| Column::Numbers((0..ROWS).map(|row| number(column, row)).collect()))
            .collect();
        columns.push(Column::Kept(Kept::Texts((0..ROWS).map(text).collect::<Texts>())));
        let mut writer = Writer::new(names);
        let mut file = writer.rows(columns, ROWS).unwrap();
        file.extend(writer.finish().unwrap());

        let wanted: Vec<Wanted> = (0..=COLUMNS)
            .map(|column| Wanted {
                column,
                form: if column < COLUMNS { Form::Number(1.0) } else { Form::Label },
            })
            .collect();
        // All columns at the same time need more than the smaller one.
        let read = |memory_bytes| {
            let options = Options { memory_bytes, ..Options::default() };
            let mut reader = Reader::new(file.clone().into(), "wide.parquet", &options).unwrap();
            let (mut row, mut most) = (0, 0);
            while row < ROWS {
                let chunk = reader.read(&wanted, 4_001).unwrap();
                most = most.max(reader.open.iter().flatten().count());
                for at in 0..chunk.rows.len() {
                    for (column, cells) in chunk.columns.iter().enumerate() {
                        match cells {
                            Cells::Numbers(numbers) => assert_eq!(numbers[at], number(column, row + at)),
                            Cells::Labels(labels) => assert_eq!(labels[at], text(row + at)),
                            Cells::Kept(_) => panic!("nobody wants these"),
                        }
                    }
                }
                row += chunk.rows.len();
            }
            most
        };
        assert_eq!(read(1 << 30), COLUMNS + 1);
        let few = read(64 << 20);
        assert!(few < COLUMNS / 2, "{few}");
    }
}
