//! Separated values: any separator, decimal comma, a byte-order mark, units in headers, `#` comments above the header (below
//! it where [`Options`] say so).

use std::io::{self, Read};

use memchr::memchr;

use super::decimal::{Marks, parse};
use super::error::clipped;
use super::header::{ColumnName, unique};
use super::packed::no_text;
use super::records::{Dialect, Line, Record, RecordError, Records, Row};
use super::separator::guess_separator;
use super::sexagesimal::sexagesimal;
use super::{Cell, Cells, Chunk, DataError, Form, Kept, Options, TableReader, Wanted};

/// How much of a file is looked at to see its separator.
const PEEK: u64 = 64 * 1024;

/// Bytes of text after which a chunk is not made longer, however few rows it has.
const CHUNK_BYTES: usize = 64 << 20;

/// Bytes of lines that are taken from a file at a time, and of those that one processor reads at a time.
const BLOCK: usize = 8 << 20;
const PART: usize = 256 << 10;

/// A file of separated values with a header. Lines without quotes are read on all processors.
pub struct Reader<R: Read> {
    table: Table,
    rows: Rows<io::Chain<io::Cursor<Vec<u8>>, R>>,
}

/// What all rows have in common.
struct Table {
    source: String,
    header: Vec<ColumnName>,
    separator: u8,
}

/// Rows that follow each other, and how many were read of them.
struct Rows<R> {
    records: Records<R>,
    record: Record,
    row: u64,
    marks: Marks,
}

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
        if let Some(what) = no_text(&head) {
            return Err(DataError::NoText { file: source.to_string(), what });
        }
        if head.starts_with(&[0xFF, 0xFE]) || head.starts_with(&[0xFE, 0xFF]) {
            return Err(DataError::NotUtf8 { file: source.to_string(), line: 1 });
        }
        let byte_order_mark = if head.starts_with(&[0xEF, 0xBB, 0xBF]) { 3 } else { 0 };
        head.drain(..byte_order_mark);
        let line_end = if head.contains(&b'\r') && !head.contains(&b'\n') { b'\r' } else { b'\n' };
        let separator = options.separator.unwrap_or_else(|| guess_separator(&head, line_end));
        let dialect = Dialect { separator, comment: Some(b'#'), line_end };
        let mut records = Records::new(io::Cursor::new(head).chain(reader), dialect, 0);
        let mut record = Record::default();
        let any = records.read(&mut record).map_err(|error| unreadable(source, error))?;
        if !any {
            return Err(DataError::Empty { file: source.to_string() });
        }
        if !record.lines().is_empty() {
            let why = "a name in the header holds a line break: is a quote not closed?".to_string();
            return Err(DataError::BadLine { file: source.to_string(), line: record.line, why });
        }
        let header = record
            .cells()
            .map(|cell| std::str::from_utf8(cell).map(ColumnName::parse))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|_| DataError::NotUtf8 { file: source.to_string(), line: record.line })?;
        unique(&header, source)?;
        records.leave_out(options.comment);
        let table = Table { source: source.to_string(), header, separator };
        Ok(Self { table, rows: Rows { records, record, row: 0, marks: Marks::default() } })
    }

    /// Reads lines without quotes, each part of them on any processor.
    fn read_plain(
        &mut self,
        lines: &[u8],
        line: u64,
        wanted: &[Wanted],
        to: &mut Chunk,
    ) -> Result<(), DataError> {
        let (table, dialect) = (&self.table, self.rows.records.dialect());
        let parts = parts(lines, dialect.line_end);
        let read = |&part: &&[u8], line: u64, row: u64, marks: Marks| {
            let records = Records::new(part, dialect, line);
            let mut rows = Rows { records, record: Record::default(), row, marks };
            let mut chunk = Chunk { columns: super::no_cells(wanted), ..Chunk::default() };
            table.read(&mut rows, wanted, usize::MAX, &mut chunk)?;
            Ok((chunk, rows.records.line(), rows.marks))
        };
        let each = parallel::each_of(&parts, |part| read(part, 0, 0, Marks::default()));
        let (mut line, mut row) = (line, self.rows.row);
        for (part, outcome) in parts.iter().zip(each) {
            // Read again, a part with a mistake says where in the file it is.
            let before = self.rows.marks.clone();
            let is_mixed = |own: &Marks| before.clone().merge(own.clone());
            let (chunk, lines, marks) = match outcome {
                Ok((.., marks)) if is_mixed(&marks) => read(part, line, row, before),
                outcome => outcome.or_else(|_: DataError| read(part, line, row, before)),
            }?;
            self.rows.marks.merge(marks);
            to.append_part(chunk, row, line);
            row = to.rows.last().copied().unwrap_or(row);
            line += lines;
        }
        self.rows.row = row;
        Ok(())
    }
}

/// Lines cut into parts of about the same size, each of whole lines.
fn parts(mut lines: &[u8], line_end: u8) -> Vec<&[u8]> {
    let mut parts = Vec::new();
    while !lines.is_empty() {
        let end = lines
            .get(PART..)
            .and_then(|rest| memchr(line_end, rest))
            .map_or(lines.len(), |end| PART + end + 1);
        let (part, rest) = lines.split_at(end);
        parts.push(part);
        lines = rest;
    }
    parts
}

impl Table {
    /// Reads rows, at most so many, and fewer where they are long, behind those of a chunk; returns their length in bytes.
    fn read<R: Read>(
        &self,
        rows: &mut Rows<R>,
        wanted: &[Wanted],
        at_most: usize,
        to: &mut Chunk,
    ) -> Result<usize, DataError> {
        let mut bytes = 0;
        for _ in 0..at_most {
            let Rows { records, record, row, marks } = rows;
            if bytes >= CHUNK_BYTES
                || !records.read(record).map_err(|error| unreadable(&self.source, error))?
            {
                break;
            }
            *row += 1;
            self.check_swallowed(record, wanted)?;
            bytes += self.take(&Row::new(record, *row), marks, wanted, &mut to.columns).map_err(|error| {
                if !record.is_like_a_comment {
                    return error;
                }
                let why = "a line below the header that begins with `#` is a row; if it is a comment, say so: \
                           comment = \"#\" in a study, --comment \"#\" on the command line";
                DataError::BadLine { file: self.source.clone(), line: record.line, why: why.to_string() }
            })?;
            to.rows.push(*row);
            to.lines.push(record.line);
        }
        Ok(bytes)
    }

    /// The place of a cell.
    fn cell(&self, record: &Record, row: u64, column: usize) -> Cell {
        Cell {
            file: self.source.clone(),
            line: Some(record.line),
            row,
            column: self.header.get(column).map_or_else(String::new, |name| name.full.clone()),
        }
    }

    /// The text of a cell.
    fn text<'r>(&self, row: &Row<'r>, column: usize) -> Result<&'r str, DataError> {
        row.text(column).map_err(|_| DataError::NotUtf8 { file: self.source.clone(), line: row.record.line })
    }

    /// The number in a cell.
    fn number(&self, row: &Row<'_>, marks: &mut Marks, column: usize, factor: f64) -> Result<f64, DataError> {
        let text = self.text(row, column)?.trim();
        let cell = || self.cell(row.record, row.number, column);
        match marks.read(text, self.separator) {
            Some(Ok(number)) if number.is_finite() => Ok(number),
            Some(Err(why)) => Err(DataError::UnusableCell { cell: cell(), why }),
            Some(_) => Err(DataError::NotFinite { cell: cell(), text: clipped(text) }),
            None if text.is_empty() => Err(DataError::EmptyCell { cell: cell() }),
            None => sexagesimal(text, factor)
                .ok_or_else(|| DataError::NotANumber { cell: cell(), text: clipped(text) }),
        }
    }

    /// Takes a row over; returns its length in bytes.
    fn take(
        &self,
        row: &Row<'_>,
        marks: &mut Marks,
        wanted: &[Wanted],
        columns: &mut [Cells],
    ) -> Result<usize, DataError> {
        if row.record.len() != self.header.len() {
            return Err(DataError::RaggedRow {
                file: self.source.clone(),
                line: row.record.line,
                row: row.number,
                expected: self.header.len(),
                found: row.record.len(),
            });
        }
        let mut bytes = 0;
        for (want, cells) in wanted.iter().zip(columns) {
            match (want.form, cells) {
                (Form::Number(factor), Cells::Numbers(numbers)) => {
                    bytes += size_of::<f64>();
                    numbers.push(self.number(row, marks, want.column, factor)? * factor);
                }
                (Form::Label, Cells::Labels(texts)) => {
                    let text = self.text(row, want.column)?;
                    bytes += text.len() + size_of::<String>();
                    texts.push(text.to_string());
                }
                (Form::Kept, Cells::Kept(Kept::Texts(texts))) => {
                    let text = self.text(row, want.column)?;
                    bytes += text.len() + size_of::<usize>();
                    texts.push(text);
                }
                _ => unreachable!("`no_cells` made a column of each form that is wanted"),
            }
        }
        Ok(bytes)
    }

    /// Refuses a quoted cell that runs over a line which is a row of its own: its quote was opened by mistake.
    fn check_swallowed(&self, record: &Record, wanted: &[Wanted]) -> Result<(), DataError> {
        let is_row = |line: &[u8]| {
            let cells: Vec<&[u8]> = line.split(|byte| *byte == self.separator).collect();
            let is_number = |want: &Wanted| {
                let cell = cells.get(want.column).and_then(|cell| std::str::from_utf8(cell).ok());
                cell.is_some_and(|cell| parse(cell.trim(), self.separator).is_some())
            };
            let mut numbers = wanted.iter().filter(|want| matches!(want.form, Form::Number(_))).peekable();
            cells.len() == self.header.len() && numbers.peek().is_some() && numbers.all(is_number)
        };
        let Some((first, others)) = record.lines().split_first() else { return Ok(()) };
        // A line wholly inside quotes, what is inside them of the last, or the last if the first is a row by itself too.
        let mistaken = |line: &Line| {
            let inside = line.text.get(..line.inside).unwrap_or_default();
            is_row(inside) || is_row(&first.text) && is_row(&line.text)
        };
        let Some(further) = others.iter().position(mistaken) else { return Ok(()) };
        let line = record.line + 1 + further as u64;
        let why = format!(
            "a quoted cell of this row runs over line {line}, which looks like a row of its own: close the quote \
             on its line, or take it away"
        );
        Err(DataError::BadLine { file: self.source.clone(), line: record.line, why })
    }
}

impl<R: Read + Send> TableReader for Reader<R> {
    fn source(&self) -> &str {
        &self.table.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.table.header
    }

    fn gives_any_label(&self) -> bool {
        true
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let mut chunk = Chunk { columns: super::no_cells(wanted), ..Chunk::default() };
        let mut bytes = 0;
        while bytes < CHUNK_BYTES {
            let left = at_most - chunk.rows.len();
            let line = self.rows.records.line();
            let plain = self.rows.records.plain_lines(left, BLOCK);
            let plain = plain.map_err(|error| unreadable(&self.table.source, error))?;
            bytes += plain.len();
            if plain.is_empty() {
                // A row with a quote, a long one, the last, or the end.
                let rows = chunk.rows.len();
                bytes += self.table.read(&mut self.rows, wanted, left.min(1), &mut chunk)?;
                if chunk.rows.len() == rows {
                    break;
                }
            } else {
                self.read_plain(&plain, line, wanted, &mut chunk)?;
            }
        }
        Ok(chunk)
    }
}

fn unreadable(source: &str, error: RecordError) -> DataError {
    let file = source.to_string();
    match error {
        RecordError::Io(error) => DataError::Unreadable { file, why: error.to_string() },
        RecordError::Line { line, why } => DataError::BadLine { file, line, why: why.to_string() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the first column as numbers and the second as labels.
    fn read(text: &[u8]) -> Result<Chunk, DataError> {
        let mut reader = Reader::new(text, "data.csv", &Options::default())?;
        let wanted = [Wanted { column: 0, form: Form::Number(2.0) }, Wanted { column: 1, form: Form::Label }];
        reader.read(&wanted, usize::MAX)
    }

    #[test]
    fn dialects_read_alike() {
        let expected = vec![
            Cells::Numbers(vec![3.0, -8.0]),
            Cells::Labels(vec!["Mars".to_string(), "Moon".to_string()]),
        ];
        for text in [
            "az,name\n1.5,Mars\n-4,Moon\n",
            "az;name\r\n1,5;Mars\r\n-4;Moon",
            "\u{feff}# made by hand\n#\taz\naz\tname\n1.5\tMars\n\n-4\tMoon\n",
            "az,name\r1.5,Mars\r-4,Moon",
            "az | name\n 1.5 | Mars \n -4e0 | Moon\n",
            "az name\n1.5 Mars\n-4 Moon\n",
            "az,name\n1.5, \"Mars\" \n\"-4\",Moon\n",
            "\"az, to the east\",name\n1.5,Mars\n-4,\"Moon\"\n",
        ] {
            let chunk = read(text.as_bytes());
            assert_eq!(chunk.as_ref().map(|chunk| chunk.rows.as_slice()), Ok([1, 2].as_slice()), "{text}");
            assert_eq!(chunk.map(|chunk| chunk.columns), Ok(expected.clone()), "{text}");
        }
    }

    #[test]
    fn rows_know_their_lines() {
        let text = "# c\naz,name\n1,Mars\n\n2,\"two\nlines\"\n3,Moon\n";
        assert_eq!(
            read(text.as_bytes()).map(|chunk| (chunk.rows, chunk.lines)),
            Ok((vec![1, 2, 3], vec![3, 5, 7]))
        );
    }

    #[test]
    fn columns_without_a_name_go_along_and_a_header_without_one_is_refused() {
        let columns =
            |text: &str| read(text.as_bytes()).map(|chunk| chunk.columns.len()).map_err(|e| e.to_string());
        assert_eq!(columns("az;name;;\n1;Mars;;\n"), Ok(2));
        for text in [",,\n1,2,3\n", "\"\"\n1\n", "\" \",\n1,2\n"] {
            assert!(
                columns(text).is_err_and(|why| why.contains("no column of the header has a name")),
                "{text}"
            );
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
            message(b"az,name\n1,\"Mars\n2,Moon\n3,Sun\n"),
            message(b"az,name\n1,\"Mars\n2,Moon\"\n3,Sun\n"),
            message(b"az,name\n1,\"Mars\n2,\"Moon\"\n3,Sun\n"),
            message(b"az,name\n1,\"Mars\n\",\n"),
            message(b"\"az,name\n1,Mars\"\n"),
            message(b"az,name\n1,Mars\n# by hand\n"),
            message(b"az,name\n1,Mars\n#2,Moon\n"),
        ]);
    }

    #[test]
    fn quoted_cells_keep_what_stands_in_them() {
        let read = |text: &str| read(text.as_bytes()).map(|chunk| chunk.columns[1].clone());
        let labels =
            |texts: &[&str]| Ok(Cells::Labels(texts.iter().map(|text| (*text).to_string()).collect()));
        assert_eq!(read("az,name\n1,\" Mars, \"\"red\"\" \"\n"), labels(&[" Mars, \"red\" "]));
        assert_eq!(read("az,name\r\n1,\"two\r\nlines\"\r\n"), labels(&["two\r\nlines"]));
        assert_eq!(read("az,name\n1,#7\n"), labels(&["#7"]));
        assert_eq!(read("az,name\n1,5\" pipe\n"), labels(&["5\" pipe"]));
    }

    #[test]
    fn lines_below_the_header_are_comments_where_it_is_said() {
        let options = Options { comment: Some(b'%'), ..Options::default() };
        let text = "# above\naz,name\n1,Mars\n% below\n2,Moon\n";
        let rows = Reader::new(text.as_bytes(), "data.csv", &options)
            .and_then(|mut reader| reader.read(&[Wanted { column: 1, form: Form::Label }], usize::MAX));
        assert_eq!(rows.map(|chunk| chunk.rows), Ok(vec![1, 2]));
    }

    #[test]
    fn a_row_without_end_is_refused() {
        let endless = b"az,name\n1,".iter().copied().chain(std::iter::repeat_n(b'x', 17 << 20));
        let message = read(&endless.collect::<Vec<u8>>()).map_err(|error| error.to_string());
        assert!(message.is_err_and(|why| why.contains("line 2") && why.contains("16 MiB")));
    }

    #[test]
    fn every_row_is_read_or_refused() {
        // Labels of all kinds, one a line and none with a line break: as many rows as lines.
        let labels = ["#", "# x", "'", "\"\"", "\"#\"", "\"a\" ", "", "-", "a \"quoted\" word", "\u{feff}"];
        let text: String = labels.iter().map(|label| format!("1,{label}\n")).collect();
        let chunk = read(format!("az,name\n{text}").as_bytes());
        assert_eq!(chunk.map(|chunk| chunk.rows.len()), Ok(labels.len()));
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
            let _ = read(&bytes);
        }
    }
}
