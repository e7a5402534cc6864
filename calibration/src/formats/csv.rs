//! Separated values: any separator, decimal comma, `#` comments, a byte-order mark, units in headers.

use std::io::{self, Read};

use ::csv::{ByteRecord, ReaderBuilder};

use super::header::{ColumnName, unique};
use super::{Cell, Cells, Chunk, DataError, TableReader, Wanted};

/// What a study may say of its files where seeing it from the header would fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// The separator; seen from the header if `None`.
    pub separator: Option<u8>,
}

/// How much of a file is looked at to see its separator.
const PEEK: u64 = 64 * 1024;

/// A file of separated values with a header.
pub struct Reader<R: Read> {
    source: String,
    header: Vec<ColumnName>,
    inner: ::csv::Reader<Text<R>>,
    record: ByteRecord,
    row: u64,
    separator: u8,
    /// Lines by which the reader is ahead after a row: it has read a line feed, but of `\r\n` only the first half.
    ahead: u64,
}

/// What was peeked at, the rest, and an end of line, so that the last row ends like the others.
type Text<R> = io::Chain<io::Chain<io::Cursor<Vec<u8>>, R>, &'static [u8]>;

impl<R: Read> Reader<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// No header, not UTF-8, or a name twice in it.
    pub fn new(mut reader: R, source: &str, options: &Options) -> Result<Self, DataError> {
        let mut head = Vec::new();
        reader
            .by_ref()
            .take(PEEK)
            .read_to_end(&mut head)
            .map_err(|error| DataError::Unreadable { file: source.to_string(), why: error.to_string() })?;
        if head.starts_with(&[0xFF, 0xFE]) || head.starts_with(&[0xFE, 0xFF]) {
            return Err(DataError::NotUtf8 { file: source.to_string(), line: 1 });
        }
        let byte_order_mark = if head.starts_with(&[0xEF, 0xBB, 0xBF]) { 3 } else { 0 };
        head.drain(..byte_order_mark);
        let separator = options.separator.unwrap_or_else(|| guess_separator(&head));
        let (ahead, line_end): (u64, &[u8]) =
            if head.windows(2).any(|pair| pair == b"\r\n") { (0, b"\r\n") } else { (1, b"\n") };
        let mut inner = ReaderBuilder::new()
            .delimiter(separator)
            .comment(Some(b'#'))
            .flexible(true)
            .trim(::csv::Trim::All)
            .from_reader(io::Cursor::new(head).chain(reader).chain(line_end));
        let cells = inner.byte_headers().map_err(|error| unreadable(source, &error))?.clone();
        if cells.is_empty() || cells.iter().all(<[u8]>::is_empty) {
            return Err(DataError::Empty { file: source.to_string() });
        }
        let line = inner.position().line().saturating_sub(ahead);
        let header = cells
            .iter()
            .map(|cell| std::str::from_utf8(cell).map(ColumnName::parse))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|_| DataError::NotUtf8 { file: source.to_string(), line })?;
        unique(&header, source)?;
        Ok(Self {
            source: source.to_string(),
            header,
            inner,
            record: ByteRecord::new(),
            row: 0,
            separator,
            ahead,
        })
    }

    /// Line of the row that was read last.
    fn line(&self) -> u64 {
        self.inner.position().line().saturating_sub(self.ahead)
    }

    /// The place of a cell of the row that was read last.
    fn cell(&self, column: usize) -> Cell {
        Cell {
            file: self.source.clone(),
            line: Some(self.line()),
            row: self.row,
            column: self.header.get(column).map_or_else(String::new, |name| name.full.clone()),
        }
    }

    /// The text of a cell of the row that was read last.
    fn text(&self, column: usize) -> Result<&str, DataError> {
        std::str::from_utf8(self.record.get(column).unwrap_or_default())
            .map_err(|_| DataError::NotUtf8 { file: self.source.clone(), line: self.line() })
    }

    /// The number in a cell of the row that was read last.
    fn number(&self, column: usize) -> Result<f64, DataError> {
        let text = self.text(column)?;
        let parsed = text.parse::<f64>().ok().or_else(|| {
            let decimal_comma = self.separator != b',' && text.contains(',') && !text.contains('.');
            if decimal_comma { text.replacen(',', ".", 1).parse().ok() } else { None }
        });
        match parsed {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(DataError::NotFinite { cell: self.cell(column), text: text.to_string() }),
            None if text.is_empty() => Err(DataError::EmptyCell { cell: self.cell(column) }),
            None => Err(DataError::NotANumber { cell: self.cell(column), text: text.to_string() }),
        }
    }
}

impl<R: Read> TableReader for Reader<R> {
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
            let more = self
                .inner
                .read_byte_record(&mut self.record)
                .map_err(|error| unreadable(&self.source, &error))?;
            if !more {
                break;
            }
            self.row += 1;
            if self.record.len() != self.header.len() {
                return Err(DataError::RaggedRow {
                    file: self.source.clone(),
                    line: self.line(),
                    row: self.row,
                    expected: self.header.len(),
                    found: self.record.len(),
                });
            }
            for (want, cells) in wanted.iter().zip(&mut columns) {
                match cells {
                    Cells::Numbers(numbers) => {
                        numbers.push(self.number(want.column)? * want.factor.unwrap_or(1.0));
                    }
                    Cells::Labels(labels) => labels.push(self.text(want.column)?.to_string()),
                }
            }
            rows.push(self.row);
        }
        Ok(Chunk { columns, rows })
    }
}

/// The separator that splits the header into most names; a comma if nothing does.
fn guess_separator(head: &[u8]) -> u8 {
    let header = head
        .split(|&byte| byte == b'\n')
        .find(|line| !line.starts_with(b"#") && line.iter().any(|byte| !byte.is_ascii_whitespace()))
        .unwrap_or_default();
    let count = |separator: u8| {
        let mut quoted = false;
        header
            .iter()
            .filter(|&&byte| {
                quoted ^= byte == b'"';
                byte == separator && !quoted
            })
            .count()
    };
    let most = [b',', b';', b'\t', b'|'].into_iter().max_by_key(|&separator| count(separator));
    match most {
        Some(separator) if count(separator) > 0 => separator,
        // A space also sets off a unit, so that it separates only where nothing else does.
        _ if count(b' ') > 0 && !header.contains(&b'[') && !header.contains(&b'(') => b' ',
        _ => b',',
    }
}

fn unreadable(source: &str, error: &::csv::Error) -> DataError {
    DataError::Unreadable { file: source.to_string(), why: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the first column as numbers and the second as labels.
    fn read(text: &[u8]) -> Result<Chunk, DataError> {
        let mut reader = Reader::new(text, "data.csv", &Options::default())?;
        let wanted = [Wanted { column: 0, factor: Some(2.0) }, Wanted { column: 1, factor: None }];
        reader.read(&wanted, usize::MAX)
    }

    #[test]
    fn dialects_read_alike() {
        let expected = Ok(Chunk {
            columns: vec![
                Cells::Numbers(vec![3.0, -8.0]),
                Cells::Labels(vec!["Mars".to_string(), "Moon".to_string()]),
            ],
            rows: vec![1, 2],
        });
        for text in [
            "az,name\n1.5,Mars\n-4,Moon\n",
            "az;name\r\n1,5;Mars\r\n-4;Moon",
            "\u{feff}# made by hand\naz\tname\n1.5\tMars\n# a comment\n-4\tMoon\n",
            "az | name\n 1.5 | Mars \n -4e0 | Moon\n",
            "az name\n1.5 Mars\n-4 Moon\n",
            "\"az, to the east\",name\n1.5,Mars\n-4,\"Moon\"\n",
        ] {
            assert_eq!(read(text.as_bytes()), expected, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let message = |text: &[u8]| read(text).map_err(|error| error.to_string());
        insta::assert_debug_snapshot!([
            message(b""),
            message(b"\n  \n"),
            message(b"az,az\n"),
            message(b"az,name\n1,Mars\nx,Moon\n"),
            message(b"# c\naz,name\n1,Mars\n\nNaN,Moon\n"),
            message(b"az;name\r\n\r\n1;Mars\r\n-;Moon"),
            message(b"az,name\n1,Mars\n2,"),
            message(b"az,name\n,Mars\n"),
            message(b"az,name\n1,Mars,3\n"),
            message(b"az,name\n1,\xffMars\n"),
            message(b"\xff\xfea\0z\0"),
        ]);
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
            let _ = read(&bytes);
        }
    }
}
