//! Rows of separated values as they are written: quoted wherever a reader could take a cell for something else.

use std::io::{self, Write};

/// Writes one row, separated by commas.
///
/// # Errors
/// What the writer says.
pub fn write_row<'c, W: Write + ?Sized>(
    out: &mut W,
    cells: impl IntoIterator<Item = &'c str>,
) -> io::Result<()> {
    let mut row = Vec::new();
    let mut cells = cells.into_iter().peekable();
    let mut is_first = true;
    while let Some(cell) = cells.next() {
        let alone = is_first && cells.peek().is_none();
        if !is_first {
            row.push(b',');
        }
        is_first = false;
        push_cell(&mut row, cell, alone);
    }
    row.push(b'\n');
    out.write_all(&row)
}

/// Appends one cell; `alone` says that its row has no other.
pub(super) fn push_cell(out: &mut Vec<u8>, cell: &str, alone: bool) {
    if !needs_quotes(cell, alone) {
        return out.extend_from_slice(cell.as_bytes());
    }
    out.push(b'"');
    for byte in cell.bytes() {
        out.extend(std::iter::repeat_n(byte, if byte == b'"' { 2 } else { 1 }));
    }
    out.push(b'"');
}

/// Whether a cell would be read as something else: as several, as a comment, without the space around it, or, where it is
/// the only one of its row, as a blank line or a row that blanks separate.
fn needs_quotes(cell: &str, alone: bool) -> bool {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'-' | b'+' | b'_');
    if !cell.is_empty() && cell.bytes().all(is_plain) {
        return false;
    }
    let of_a_separator = |letter: char| matches!(letter, ',' | ';' | '\t' | '|' | '"' | '\n' | '\r');
    let at_edge = |letter: char| letter.is_whitespace() || matches!(letter, '#' | '\u{feff}');
    cell.contains(of_a_separator)
        || cell.starts_with(at_edge)
        || cell.ends_with(char::is_whitespace)
        || alone && (cell.is_empty() || cell.contains(' '))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::formats::{Cells, Form, Options, TableReader as _, Wanted, csv};

    proptest! {
        #[test]
        fn what_is_written_is_read(
            columns in 1_usize..4,
            texts in proptest::collection::vec("[a-z0-9 ,;|\t\"'#\r\n\u{feff}\u{a0}é.-]{0,6}", 1..30),
        ) {
            let rows: Vec<&[String]> = texts.chunks_exact(columns).collect();
            let names: Vec<String> = (0..columns).map(|at| format!("#a;b c{at}")).collect();
            let mut file = Vec::new();
            super::write_row(&mut file, names.iter().map(String::as_str))?;
            for row in &rows {
                super::write_row(&mut file, row.iter().map(String::as_str))?;
            }
            let mut reader = csv::Reader::new(file.as_slice(), "f.csv", &Options::default())?;
            let header: Vec<&str> = reader.header().iter().map(|name| name.full.as_str()).collect();
            prop_assert_eq!(header, names);
            let wanted: Vec<Wanted> = (0..columns).map(|column| Wanted { column, form: Form::Label }).collect();
            let read = reader.read(&wanted, usize::MAX)?;
            prop_assert_eq!(read.rows.len(), rows.len());
            for (column, cells) in read.columns.into_iter().enumerate() {
                let expected: Vec<String> = rows.iter().map(|row| row[column].clone()).collect();
                prop_assert_eq!(cells, Cells::Labels(expected));
            }
        }
    }
}
