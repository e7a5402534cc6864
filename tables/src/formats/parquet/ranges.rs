//! Ranges of a Parquet file, each read as it is needed, so that a file of any size takes the memory of a few pages.

use std::io::{self, BufReader, Read, SeekFrom};
use std::sync::{Arc, Mutex, PoisonError};

use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::reader::{ChunkReader, Length};
use bytes::Bytes;

use crate::formats::input::ReadSeek;

/// Bytes that are read ahead of a page, for its header.
const HEADER: usize = 1 << 10;

/// What ranges are read of; the columns of a table read theirs at the same time.
#[derive(Clone)]
pub(super) struct Ranges {
    /// One place to read at: whoever reads goes there first.
    source: Arc<Mutex<Box<dyn ReadSeek>>>,
    /// Its length when it was opened.
    length: u64,
    /// The longest range that is read at once.
    memory_bytes: u64,
}

/// Bytes from a place on, front to back.
pub(super) struct Onward {
    ranges: Ranges,
    at: u64,
}

impl Ranges {
    /// Of something of a length, none of them longer than the memory that may be taken.
    pub fn of(source: Box<dyn ReadSeek>, length: u64, memory_bytes: u64) -> Self {
        Self { source: Arc::new(Mutex::new(source)), length, memory_bytes }
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> io::Result<usize> {
        // A place where another thread gave up is no worse than any: it is left first.
        let mut source = self.source.lock().unwrap_or_else(PoisonError::into_inner);
        source.seek(SeekFrom::Start(at))?;
        source.read(into)
    }

    fn from(&self, at: u64) -> Onward {
        Onward { ranges: self.clone(), at }
    }
}

impl Read for Onward {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.ranges.read_at(self.at, into)?;
        self.at += count as u64;
        Ok(count)
    }
}

impl Length for Ranges {
    fn len(&self) -> u64 {
        self.length
    }
}

impl ChunkReader for Ranges {
    type T = BufReader<Onward>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        Ok(BufReader::with_capacity(HEADER, self.from(start)))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        // What is claimed is looked at before there is room for it.
        if start.checked_add(length as u64).is_none_or(|end| end > self.len()) {
            return Err(ParquetError::EOF(format!("{length} bytes at {start} are not all in the file")));
        }
        if length as u64 > self.memory_bytes {
            return Err(ParquetError::General("a page takes more memory than it may".to_owned()));
        }
        let mut bytes = vec![0; length];
        self.from(start).read_exact(&mut bytes).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => {
                ParquetError::General("the file became shorter while it was read".to_owned())
            }
            _ => error.into(),
        })?;
        Ok(bytes.into())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::io::Cursor;

    use super::super::{Reader, Writer};
    use super::*;
    use crate::formats::{Cells, Column, DataError, Form, Input, Options, TableReader as _, Wanted};

    const GROUPS: usize = 12;
    const ROWS: usize = 20_000;

    /// Numbers that hardly repeat, so that the file is about as long as they are.
    fn number(row: usize, column: usize) -> f64 {
        (row * 3 + column) as f64 * 0.618_033_988_749_894_9 % 1.0
    }

    fn table() -> Vec<u8> {
        let mut writer = Writer::new(["a", "b", "c"].map(str::to_owned).to_vec());
        let mut file = Vec::new();
        for group in 0..GROUPS {
            let rows = group * ROWS..(group + 1) * ROWS;
            let of = |column| Column::Numbers(rows.clone().map(|row| number(row, column)).collect());
            file.extend(writer.rows((0..3).map(of).collect(), ROWS).unwrap());
        }
        file.extend(writer.finish().unwrap());
        file
    }

    #[test]
    fn a_file_may_be_larger_than_the_memory_that_it_takes() {
        let bytes = table();
        let options = Options { memory_bytes: 3 << 20, ..Options::default() };
        assert!(bytes.len() as u64 > options.memory_bytes, "{}", bytes.len());
        let length = bytes.len() as u64;
        let (input, streamed) = (Input::ranged(Cursor::new(bytes.clone()), length), Input::from(bytes));
        let extent = input.extent().unwrap();
        let mut reader = Reader::new(input, "large.parquet", &options).unwrap();
        // Two of three columns: the share is that of the rows.
        let wanted = [2, 0].map(|column| Wanted { column, form: Form::Number(1.0) });
        let mut row = 0;
        loop {
            let chunk = reader.read(&wanted, 7_001).unwrap();
            let [Cells::Numbers(c), Cells::Numbers(a)] = &chunk.columns[..] else { panic!("{chunk:?}") };
            for (c, a) in c.iter().zip(a) {
                assert_eq!([*a, *c], [number(row, 0), number(row, 2)]);
                row += 1;
            }
            let share = row as f64 / (GROUPS * ROWS) as f64;
            assert!((extent.share() - share).abs() < 1e-5, "{} at {share}", extent.share());
            if chunk.rows.is_empty() {
                break;
            }
        }
        assert_eq!(row, GROUPS * ROWS);

        let refused = Reader::new(streamed, "large.parquet", &options).err();
        assert!(matches!(refused, Some(DataError::TooLarge { .. })), "{refused:?}");
    }

    #[test]
    fn what_lies_beyond_the_file_is_an_error() {
        let open =
            |bytes: &'static [u8], memory_bytes| Ranges::of(Box::new(Cursor::new(bytes)), 10, memory_bytes);
        for ranges in [open(b"0123456789", 10), open(b"0123456789", u64::MAX)] {
            assert_eq!(ranges.get_bytes(3, 7).unwrap().as_ref(), b"3456789");
            for (start, length) in [(3, 8), (10, 1), (11, 0), (u64::MAX, 1), (0, usize::MAX)] {
                assert!(ranges.get_bytes(start, length).is_err(), "{length} at {start}");
            }
            let mut from = Vec::new();
            ranges.get_read(8).unwrap().read_to_end(&mut from).unwrap();
            assert_eq!(from, b"89");
            assert_eq!(ranges.get_read(12).unwrap().read(&mut [0]).unwrap(), 0);
        }
        assert!(open(b"0123456789", 6).get_bytes(3, 7).is_err());
        // Another program made it shorter.
        let shorter = open(b"01", 10).get_bytes(3, 7).map_err(|error| error.to_string());
        assert_eq!(shorter, Err("Parquet error: the file became shorter while it was read".to_owned()));
    }

    /// Every byte of a good file, spoiled: an error or other numbers, no panic.
    #[test]
    fn no_spoiled_byte_of_a_file_panics() {
        let good = include_bytes!("../../../tests/reference/snappy.parquet");
        for at in 0..good.len() {
            let mut bytes = good.to_vec();
            bytes[at] ^= 0x80;
            let input = Input::ranged(Cursor::new(bytes), good.len() as u64);
            if let Ok(mut reader) = Reader::new(input, "spoiled.parquet", &Options::default()) {
                let _ = reader.read(&[Wanted { column: 0, form: Form::Number(1.0) }], usize::MAX);
            }
        }
    }
}
