//! Rows of separated values out of bytes: cells, quotes, comments, and the lines that each row stands on.
//!
//! A quoted cell may hold line breaks. Where one is opened by mistake it would swallow the rows below, so that a quote that
//! nothing closes, text behind a closing quote, and a row that is too long are errors; [`Record::lines`] gives the
//! lines that quotes run over, for whoever knows what a row looks like.

use std::io::{self, BufRead, BufReader, Read};

/// The longest row that is read, in bytes.
const LONGEST_ROW: usize = 16 << 20;

/// Rows, front to back.
pub(super) struct Records<R> {
    input: BufReader<R>,
    separator: u8,
    /// Lines that begin with this are left out.
    comment: Option<u8>,
    /// What ends a line: a line feed, or a carriage return in files that know no other.
    line_end: u8,
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

impl<R: Read> Records<R> {
    pub fn new(input: R, separator: u8, line_end: u8) -> Self {
        let input = BufReader::new(input);
        Self { input, separator, comment: Some(b'#'), line_end, text: Vec::new(), ended: b"", line: 0 }
    }

    /// From here on, lines that begin with `comment` are left out.
    pub fn leave_out(&mut self, comment: Option<u8>) {
        self.comment = comment;
    }

    /// Reads the next row into `record`; `false` at the end. Blank lines are no rows.
    pub fn read(&mut self, record: &mut Record) -> Result<bool, RecordError> {
        loop {
            if !self.next_line()? {
                return Ok(false);
            }
            let blank = |byte: &u8| byte.is_ascii_whitespace() && *byte != self.separator;
            let comment = self.text.first().is_some_and(|first| Some(*first) == self.comment);
            if !comment && !self.text.iter().all(blank) {
                return self.split(record).map(|()| true);
            }
        }
    }

    /// Reads a line into `self.text`; `false` at the end.
    fn next_line(&mut self) -> Result<bool, RecordError> {
        self.text.clear();
        let mut any = false;
        loop {
            let buffer = match self.input.fill_buf() {
                Ok(buffer) => buffer,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(RecordError::Io(error)),
            };
            if buffer.is_empty() {
                break;
            }
            any = true;
            let end = buffer.iter().position(|byte| *byte == self.line_end);
            let taken = end.unwrap_or(buffer.len());
            if self.text.len() + taken > LONGEST_ROW {
                return Err(too_long(self.line + 1));
            }
            self.text.extend(buffer.iter().take(taken));
            self.input.consume(taken + usize::from(end.is_some()));
            if end.is_some() {
                break;
            }
        }
        self.line += u64::from(any);
        self.ended = if self.line_end == b'\r' {
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
        let separator = self.separator;
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
                let length = rest.iter().position(|byte| *byte == separator).unwrap_or(rest.len());
                record.bytes.extend(rest.get(..length).unwrap_or_default().trim_ascii());
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

fn too_long(line: u64) -> RecordError {
    let why = "the row is longer than 16 MiB: is a quote not closed, or is this no table?";
    RecordError::Line { line, why }
}

impl Record {
    /// How many cells the row has.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// A cell; empty beyond the last.
    pub fn get(&self, column: usize) -> &[u8] {
        let end = self.ends.get(column).copied().unwrap_or_default();
        let start =
            column.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or_default();
        self.bytes.get(start..end).unwrap_or_default()
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
