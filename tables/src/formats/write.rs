//! Columns as rows of separated values, set as text on all processors: the same bytes on any number of them.

use std::io::{self, Write};

use super::Texts;
use super::number::push_number;
use super::quote::push_cell;

/// Rows that one processor sets at a time.
const PART: usize = 4096;

/// Rows that are text at a time.
const AT_ONCE: usize = 16 * PART;

/// A column to be written.
#[derive(Debug, Clone, Copy)]
pub enum Written<'a> {
    /// Texts, quoted where they must be.
    Texts(&'a Texts),
    /// Numbers, as short as read back to the same.
    Numbers(&'a [f64]),
    /// Whole numbers.
    Counts(&'a [u64]),
    /// Numbers that some rows have; the others have an empty cell.
    Residuals(&'a [Option<f64>]),
}

/// Writes rows in their order.
///
/// # Errors
/// What the writer says.
pub fn write_rows(out: &mut dyn Write, columns: &[Written<'_>], rows: usize) -> io::Result<()> {
    for first in (0..rows).step_by(AT_ONCE) {
        let starts: Vec<usize> = (first..rows.min(first + AT_ONCE)).step_by(PART).collect();
        let parts = parallel::each_of(starts, |start| {
            let end = rows.min(start + PART);
            let mut text = Vec::with_capacity((end - start) * columns.len() * 16);
            (start..end).for_each(|row| push_row(&mut text, columns, row));
            text
        });
        parts.iter().try_for_each(|part| out.write_all(part))?;
    }
    Ok(())
}

fn push_row(text: &mut Vec<u8>, columns: &[Written<'_>], row: usize) {
    for (at, column) in columns.iter().enumerate() {
        if at > 0 {
            text.push(b',');
        }
        let alone = columns.len() == 1;
        match column {
            Written::Texts(texts) => push_cell(text, texts.get(row).unwrap_or_default(), alone),
            Written::Numbers(numbers) => push_number(text, numbers[row]),
            Written::Counts(counts) => text.extend_from_slice(counts[row].to_string().as_bytes()),
            Written::Residuals(numbers) => match numbers[row] {
                Some(number) => push_number(text, number),
                None => push_cell(text, "", alone),
            },
        }
    }
    text.push(b'\n');
}

#[cfg(test)]
mod tests {
    use super::super::{Cells, Form, Kept, Options, TableReader as _, Wanted, csv};
    use super::*;

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(16))]

        /// What is set part by part is read part by part, with quotes anywhere and lines and rows counted through.
        #[test]
        fn many_rows_come_back(rows in 1_usize..70_000, quoted in 1_usize..4000, at_most in 1_usize..5000) {
            let text = |row: usize| if row.is_multiple_of(quoted) { format!("a,\n{row}") } else { row.to_string() };
            let texts: Texts = (0..rows).map(text).collect();
            let numbers: Vec<f64> = (0..rows).map(|row| row as f64 * 1.7e-7).collect();
            let mut file = b"text,number\n".to_vec();
            write_rows(&mut file, &[Written::Texts(&texts), Written::Numbers(&numbers)], rows)?;
            let Ok(mut reader) = csv::Reader::new(file.as_slice(), "f.csv", &Options::default()) else {
                unreachable!("there is a header")
            };
            let wanted = [Wanted { column: 0, form: Form::Kept }, Wanted { column: 1, form: Form::Number(1.0) }];
            let (mut row, mut line) = (0, 2);
            loop {
                let chunk = reader.read(&wanted, at_most);
                let Ok(chunk) = chunk else { unreachable!("what was written can be read") };
                if chunk.rows.is_empty() {
                    break;
                }
                proptest::prop_assert!(chunk.rows.len() <= at_most);
                let [Cells::Kept(Kept::Texts(read)), Cells::Numbers(read_numbers)] = chunk.columns.as_slice() else {
                    unreachable!("what was wanted")
                };
                proptest::prop_assert_eq!(read_numbers.len(), chunk.rows.len());
                for (at, number) in read_numbers.iter().enumerate() {
                    proptest::prop_assert_eq!(read.get(at), texts.get(row));
                    proptest::prop_assert_eq!(*number, numbers[row]);
                    proptest::prop_assert_eq!((chunk.rows[at], chunk.lines[at]), (row as u64 + 1, line));
                    line += if row.is_multiple_of(quoted) { 2 } else { 1 };
                    row += 1;
                }
            }
            proptest::prop_assert_eq!(row, rows);
        }
    }
}
