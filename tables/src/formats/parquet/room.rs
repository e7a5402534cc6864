//! How many rows of a Parquet file make a chunk: as many as are asked for, and fewer where they are long.

use ::parquet::basic::Type as Physical;

use super::TypedCells;

/// Memory that the cells of a chunk take at most, in bytes, about: rows may be of any length.
const CHUNK_BYTES: usize = 16 << 20;

/// Rows that are read at a time where texts are among them, whose length nobody knows before.
const TEXTS: usize = 1 << 12;

/// How much room is left in a chunk.
pub(super) struct Room {
    bytes: usize,
    /// What a row takes, about; none before one with texts was read.
    of_row: Option<usize>,
    has_texts: bool,
    /// Rows of a chunk whose texts are as long as numbers.
    usual: usize,
}

impl Room {
    /// Of columns of these types.
    pub fn of(types: impl Iterator<Item = Physical> + Clone) -> Self {
        let is_text = |of_type| matches!(of_type, Physical::BYTE_ARRAY | Physical::FIXED_LEN_BYTE_ARRAY);
        let has_texts = types.clone().any(is_text);
        let of_numbers = types.count() * size_of::<f64>();
        let usual = (CHUNK_BYTES / of_numbers.max(1)).max(1);
        let of_row = (!has_texts).then_some(of_numbers);
        Self {
            bytes: CHUNK_BYTES,
            of_row,
            has_texts,
            usual: if has_texts { usual.min(TEXTS) } else { usual },
        }
    }

    /// How many rows go in at a time, but for the first, where no texts are long.
    pub fn usual(&self) -> usize {
        self.usual
    }

    /// How many rows go in at a time.
    pub fn rows(&self) -> usize {
        let rows = self.of_row.map_or(TEXTS / 16, |of_row| self.bytes / of_row.max(1));
        // However long a row is, a chunk has one.
        let rows = if self.bytes == CHUNK_BYTES { rows.max(1) } else { rows };
        if self.has_texts { rows.min(TEXTS) } else { rows }
    }

    /// Takes in so many rows.
    pub fn take(&mut self, cells: &[TypedCells], rows: usize) {
        let bytes: usize = cells.iter().map(TypedCells::bytes).sum();
        self.bytes = self.bytes.saturating_sub(bytes.max(1));
        self.of_row = self.of_row.max(bytes.checked_div(rows));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{Reader, Writer};
    use crate::formats::{Cells, Column, Form, Kept, Options, TableReader as _, Texts, Wanted};

    /// However many rows are asked for, a chunk of long ones has few.
    #[test]
    fn long_rows_come_in_small_chunks() {
        const ROWS: usize = 6000;
        let long = |row: usize| format!("{row} {}", "x".repeat(50_000));
        let mut writer = Writer::new(vec!["note".to_owned()]);
        let texts: Texts = (0..ROWS).map(long).collect();
        let mut file = writer.rows(vec![Column::Kept(Kept::Texts(texts))], ROWS).unwrap();
        file.extend(writer.finish().unwrap());
        let mut reader = Reader::new(file.as_slice().into(), "long.parquet", &Options::default()).unwrap();
        let mut row = 0;
        loop {
            let chunk = reader.read(&[Wanted { column: 0, form: Form::Label }], 1 << 16).unwrap();
            let Cells::Labels(texts) = &chunk.columns[0] else { panic!("labels") };
            if texts.is_empty() {
                break;
            }
            assert!(texts.len() < ROWS / 3, "{}", texts.len());
            for text in texts {
                assert_eq!(*text, long(row));
                row += 1;
            }
        }
        assert_eq!(row, ROWS);
    }
}
