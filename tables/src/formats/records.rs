//! Rows of separated values out of bytes: cells, quotes, comments, and the lines that each row stands on.
//!
//! A quoted cell may hold line breaks. Where one is opened by mistake it would swallow the rows below, so that a quote that
//! nothing closes, text behind a closing quote, and a row that is too long are errors; [`Record::lines`] gives the
//! lines that quotes run over, for whoever knows what a row looks like.
//!
//! Not `csv-core` 0.1, which takes an unclosed quote and all rows behind it for one cell and keeps text behind a closing quote, without
//! a word. It is as fast: 300,000 rows of five numbers at 93 to 113 MB/s, and these at 103 to 123.

use std::io::{self, Read};
use std::ops::Range;
use std::str::Utf8Error;

use memchr::{memchr, memchr_iter, memrchr};

/// The longest row that is read, in bytes.
const LONGEST_ROW: usize = 16 << 20;

/// Bytes that are asked of the input at a time.
const PIECE: u64 = 256 << 10;

/// How rows are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dialect {
    pub separator: u8,
    /// Lines that begin with this are left out.
    pub comment: Option<u8>,
    /// What ends a line: a line feed, or a carriage return in files that know no other.
    pub line_end: u8,
}

/// Rows, front to back.
pub(super) struct Records<R> {
    input: Ahead<R>,
    dialect: Dialect,
    /// The line that was read last, without its end.
    text: Vec<u8>,
    /// What that line ended with.
    ended: &'static [u8],
    /// Lines read so far.
    line: u64,
}

/// One row.
#[derive(Debug, Clone, Default)]
pub(super) struct Record {
    /// All cells, one behind the other.
    bytes: Vec<u8>,
    /// Where each cell ends.
    ends: Vec<usize>,
    /// Line of the row's start, from 1.
    pub line: u64,
    /// Whether the row begins with `#`, outside quotes.
    pub is_like_a_comment: bool,
    /// The lines that quoted cells run over, the row's first among them; none if the row stands on one line.
    lines: Vec<Line>,
}

/// One of the lines that a row stands on.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// As it stands in the file.
    pub text: Vec<u8>,
    /// How much of it is inside quotes that were opened on an earlier line.
    pub inside: usize,
}

/// Why there is no next row.
#[derive(Debug)]
pub(super) enum RecordError {
    /// The system says so.
    Io(io::Error),
    /// The bytes of a line cannot be a row.
    Line {
        /// From 1.
        line: u64,
        /// What is wrong, and what was expected.
        why: &'static str,
    },
}

/// A row on its way into columns.
pub struct Row<'r> {
    pub record: &'r Record,
    /// Of the row in its file, from 1.
    pub number: u64,
    /// All cells, where all are text: looking at each alone would take as long as reading them.
    all: Option<&'r str>,
}

impl<'r> Row<'r> {
    pub fn new(record: &'r Record, number: u64) -> Self {
        Self { record, number, all: std::str::from_utf8(&record.bytes).ok() }
    }

    /// The text of a cell.
    pub fn text(&self, column: usize) -> Result<&'r str, Utf8Error> {
        match self.all.and_then(|all| all.get(self.record.range(column))) {
            Some(text) => Ok(text),
            None => std::str::from_utf8(self.record.get(column)),
        }
    }
}

impl<R: Read> Records<R> {
    /// Rows of an input that begins behind so many lines.
    pub fn new(input: R, dialect: Dialect, line: u64) -> Self {
        let input = Ahead { input, bytes: Vec::new(), at: 0 };
        Self { input, dialect, text: Vec::new(), ended: b"", line }
    }

    /// From here on, lines that begin with `comment` are left out.
    pub fn leave_out(&mut self, comment: Option<u8>) {
        self.dialect.comment = comment;
    }

    /// How the rows are written.
    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// Reads the next row into `record`; `false` at the end. Blank lines are no rows.
    pub fn read(&mut self, record: &mut Record) -> Result<bool, RecordError> {
        loop {
            if !self.next_line()? {
                return Ok(false);
            }
            let blank = |byte: &u8| byte.is_ascii_whitespace() && *byte != self.dialect.separator;
            let comment = self.text.first().is_some_and(|first| Some(*first) == self.dialect.comment);
            if !comment && !self.text.iter().all(blank) {
                return self.split(record).map(|()| true);
            }
        }
    }

    /// Takes the lines that come next and hold no quote: at most so many, and no more than fill `bytes`. What ends without a
    /// line end is not among them.
    ///
    /// # Errors
    /// The system's.
    pub fn plain_lines(&mut self, at_most: usize, bytes: usize) -> Result<Vec<u8>, RecordError> {
        let mut looked_at = 0;
        let quote = loop {
            let unseen = self.input.unread().get(looked_at..).unwrap_or_default();
            match memchr(b'"', unseen) {
                Some(quote) => break Some(looked_at + quote),
                None if looked_at + unseen.len() >= bytes => break None,
                None => looked_at += unseen.len(),
            }
            if !self.input.more().map_err(RecordError::Io)? {
                break None;
            }
        };
        let unread = self.input.unread();
        let plain = unread.get(..quote.unwrap_or(unread.len()).min(bytes)).unwrap_or_default();
        let end = match at_most.checked_sub(1) {
            None => 0,
            Some(last) => memchr_iter(self.dialect.line_end, plain)
                .nth(last)
                .or_else(|| memrchr(self.dialect.line_end, plain))
                .map_or(0, |end| end + 1),
        };
        let lines = plain.get(..end).unwrap_or_default().to_vec();
        self.input.at += end;
        self.line += memchr_iter(self.dialect.line_end, &lines).count() as u64;
        Ok(lines)
    }

    /// The lines read so far.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Reads a line into `self.text`; `false` at the end.
    fn next_line(&mut self) -> Result<bool, RecordError> {
        self.text.clear();
        let mut any = false;
        loop {
            if self.input.unread().is_empty() && !self.input.more().map_err(RecordError::Io)? {
                break;
            }
            any = true;
            let unread = self.input.unread();
            let end = memchr(self.dialect.line_end, unread);
            let taken = end.unwrap_or(unread.len());
            if self.text.len() + taken > LONGEST_ROW {
                return Err(too_long(self.line + 1));
            }
            self.text.extend_from_slice(&unread[..taken]);
            self.input.at += taken + usize::from(end.is_some());
            if end.is_some() {
                break;
            }
        }
        self.line += u64::from(any);
        self.ended = if self.dialect.line_end == b'\r' {
            b"\r"
        } else if self.text.pop_if(|last| *last == b'\r').is_some() {
            b"\r\n"
        } else {
            b"\n"
        };
        Ok(any)
    }

    /// Splits the line that was read last, and those that its quoted cells run over.
    fn split(&mut self, record: &mut Record) -> Result<(), RecordError> {
        record.bytes.clear();
        record.ends.clear();
        record.lines.clear();
        record.line = self.line;
        record.is_like_a_comment = self.text.first() == Some(&b'#');
        let separator = self.dialect.separator;
        let blank = |byte: &u8| matches!(byte, b' ' | b'\t') && *byte != separator;
        let mut at = 0;
        loop {
            at += self.text.iter().skip(at).take_while(|byte| blank(byte)).count();
            if self.text.get(at) == Some(&b'"') {
                at = self.quoted(record, at + 1)?;
                at += self.text.iter().skip(at).take_while(|byte| blank(byte)).count();
                if self.text.get(at).is_some_and(|next| *next != separator) {
                    let why = "text stands behind a closing quote: where a quote is meant inside a cell, write it \
                               twice and quote the cell";
                    return Err(RecordError::Line { line: self.line, why });
                }
            } else {
                let rest = self.text.get(at..).unwrap_or_default();
                let length = memchr(separator, rest).unwrap_or(rest.len());
                record.bytes.extend_from_slice(rest.get(..length).unwrap_or_default().trim_ascii());
                at += length;
            }
            record.ends.push(record.bytes.len());
            if self.text.get(at) != Some(&separator) {
                return Ok(());
            }
            at += 1;
        }
    }

    /// Takes over a quoted cell from behind its opening quote; returns where its closing quote ends.
    fn quoted(&mut self, record: &mut Record, mut at: usize) -> Result<usize, RecordError> {
        let opened = self.line;
        loop {
            match (self.text.get(at), self.text.get(at + 1)) {
                (Some(b'"'), Some(b'"')) => {
                    record.bytes.push(b'"');
                    at += 2;
                }
                (Some(b'"'), _) => {
                    if self.line > opened
                        && let Some(last) = record.lines.last_mut()
                    {
                        last.inside = at;
                    }
                    return Ok(at + 1);
                }
                (Some(&byte), _) => {
                    record.bytes.push(byte);
                    at += 1;
                }
                (None, _) => {
                    let why = "the quote that opens a cell here is never closed: close it, or take it away";
                    record.bytes.extend(self.ended);
                    if record.lines.is_empty() {
                        record.lines.push(Line { text: self.text.clone(), inside: 0 });
                    }
                    if !self.next_line()? {
                        return Err(RecordError::Line { line: opened, why });
                    }
                    if record.bytes.len() + self.text.len() > LONGEST_ROW {
                        return Err(too_long(opened));
                    }
                    record.lines.push(Line { text: self.text.clone(), inside: self.text.len() });
                    at = 0;
                }
            }
        }
    }
}

/// What was read of an input and not yet taken.
struct Ahead<R> {
    input: R,
    bytes: Vec<u8>,
    /// How many of the bytes were taken.
    at: usize,
}

impl<R: Read> Ahead<R> {
    fn unread(&self) -> &[u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Reads more; `false` at the end.
    fn more(&mut self) -> io::Result<bool> {
        self.bytes.drain(..self.at);
        self.at = 0;
        let read = self.input.by_ref().take(PIECE).read_to_end(&mut self.bytes)?;
        Ok(read > 0)
    }
}

fn too_long(line: u64) -> RecordError {
    let why = "the row is longer than 16 MiB: is a quote not closed, or is this no table?";
    RecordError::Line { line, why }
}

impl Record {
    /// How many cells the row has.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Where a cell stands among all.
    fn range(&self, column: usize) -> Range<usize> {
        let end = self.ends.get(column).copied().unwrap_or_default();
        let start =
            column.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or_default();
        start..end
    }

    /// A cell; empty beyond the last.
    pub fn get(&self, column: usize) -> &[u8] {
        self.bytes.get(self.range(column)).unwrap_or_default()
    }

    /// Every cell.
    pub fn cells(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.len()).map(|column| self.get(column))
    }

    /// The lines that quoted cells run over, the row's first among them; none if the row stands on one line.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }
}
