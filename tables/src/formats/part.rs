//! A part of a table: some stretches of its rows, or no more than so many.

use std::collections::VecDeque;
use std::ops::{DerefMut, Range};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::{Chunk, ColumnName, DataError, Form, TableReader, Wanted, no_cells};

/// Rows that are passed over at a time.
const SKIPPED: u64 = 1 << 16;

/// Some stretches of a table's rows, of a reader that this owns or borrows.
pub struct Stretches<R> {
    reader: R,
    /// Rows that have been read.
    at: u64,
    left: VecDeque<Range<u64>>,
}

impl<R: DerefMut<Target: TableReader>> Stretches<R> {
    /// The rows in these stretches, which follow each other, of a reader that has read `at` of them.
    #[must_use]
    pub fn new(reader: R, at: u64, stretches: impl IntoIterator<Item = Range<u64>>) -> Self {
        Self { reader, at, left: stretches.into_iter().collect() }
    }
}

impl<R: DerefMut<Target: TableReader> + Send> TableReader for Stretches<R> {
    fn source(&self) -> &str {
        self.reader.source()
    }

    fn header(&self) -> &[ColumnName] {
        self.reader.header()
    }

    fn gives_any_label(&self) -> bool {
        self.reader.gives_any_label()
    }

    fn latitude_deg(&self) -> Option<f64> {
        self.reader.latitude_deg()
    }

    fn behind(&self) -> &[usize] {
        self.reader.behind()
    }

    fn remarks(&self) -> Vec<String> {
        self.reader.remarks()
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        while let Some(next) = self.left.front() {
            if self.at >= next.end {
                self.left.pop_front();
            } else if self.at < next.start {
                let rows = skip(&mut *self.reader, next.start - self.at)?;
                if rows == 0 {
                    break;
                }
                self.at += rows;
            } else {
                let chunk = self.reader.read(wanted, at_most.min((next.end - self.at) as usize))?;
                self.at += chunk.rows.len() as u64;
                return Ok(chunk);
            }
        }
        Ok(Chunk { columns: no_cells(wanted), ..Chunk::default() })
    }
}

/// Passes over at most so many rows; how many there were.
fn skip<R: TableReader + ?Sized>(reader: &mut R, rows: u64) -> Result<u64, DataError> {
    let wanted = [Wanted { column: 0, form: Form::Kept }];
    Ok(reader.read(&wanted, rows.min(SKIPPED) as usize)?.rows.len() as u64)
}

/// How many rows a table has.
///
/// # Errors
/// It cannot be read.
pub fn count(reader: &mut dyn TableReader) -> Result<u64, DataError> {
    let mut rows = 0;
    loop {
        match skip(reader, SKIPPED)? {
            0 => return Ok(rows),
            more => rows += more,
        }
    }
}

/// How many rows some tables may have together, and whether they have more.
#[derive(Debug, Default)]
pub struct Budget {
    left: AtomicUsize,
    is_exceeded: AtomicBool,
}

impl Budget {
    /// So many rows.
    #[must_use]
    pub fn new(rows: usize) -> Self {
        Self { left: AtomicUsize::new(rows), is_exceeded: AtomicBool::new(false) }
    }

    /// Whether there were more.
    #[must_use]
    pub fn is_exceeded(&self) -> bool {
        self.is_exceeded.load(Ordering::Relaxed)
    }
}

/// A table that ends where a budget does.
pub struct Within<'b, R> {
    reader: R,
    budget: &'b Budget,
}

impl<'b, R: DerefMut<Target: TableReader>> Within<'b, R> {
    /// The rows that a budget has left.
    #[must_use]
    pub fn new(reader: R, budget: &'b Budget) -> Self {
        Self { reader, budget }
    }
}

impl<R: DerefMut<Target: TableReader> + Send> TableReader for Within<'_, R> {
    fn source(&self) -> &str {
        self.reader.source()
    }

    fn header(&self) -> &[ColumnName] {
        self.reader.header()
    }

    fn gives_any_label(&self) -> bool {
        self.reader.gives_any_label()
    }

    fn latitude_deg(&self) -> Option<f64> {
        self.reader.latitude_deg()
    }

    fn behind(&self) -> &[usize] {
        self.reader.behind()
    }

    fn remarks(&self) -> Vec<String> {
        self.reader.remarks()
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let left = self.budget.left.load(Ordering::Relaxed);
        if left > 0 {
            let chunk = self.reader.read(wanted, at_most.min(left))?;
            self.budget.left.fetch_sub(chunk.rows.len(), Ordering::Relaxed);
            return Ok(chunk);
        }
        if !self.budget.is_exceeded() && skip(&mut *self.reader, 1)? > 0 {
            self.budget.is_exceeded.store(true, Ordering::Relaxed);
        }
        Ok(Chunk { columns: no_cells(wanted), ..Chunk::default() })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::formats::{Cells, Options, open};

    fn table(rows: usize) -> Box<dyn TableReader> {
        let lines: String = (0..rows).map(|row| format!("{row}\n")).collect();
        open(format!("a\n{lines}").into_bytes(), "t.csv", &Options::default()).unwrap()
    }

    fn rows_of(mut reader: impl TableReader) -> (Vec<f64>, Vec<u64>) {
        let (mut values, mut numbers) = (Vec::new(), Vec::new());
        loop {
            let chunk = reader.read(&[Wanted { column: 0, form: Form::Number(1.0) }], 7).unwrap();
            if chunk.rows.is_empty() {
                return (values, numbers);
            }
            let [Cells::Numbers(own)] = &chunk.columns[..] else { panic!("one column of numbers") };
            values.extend(own);
            numbers.extend(chunk.rows);
        }
    }

    #[test]
    fn stretches_keep_the_numbers_of_their_rows() {
        let (values, numbers) = rows_of(Stretches::new(table(100), 0, [3..5, 5..6, 20..45, 99..200]));
        let expected: Vec<u64> = (3..6).chain(20..45).chain(99..100).collect();
        assert_eq!(values, expected.iter().map(|&row| row as f64).collect::<Vec<_>>());
        assert_eq!(numbers, expected.iter().map(|row| row + 1).collect::<Vec<_>>());
        assert_eq!(rows_of(Stretches::new(table(10), 0, std::iter::once(20..30))).0, [0.0; 0]);
        let mut reader = table(30);
        assert_eq!(rows_of(Stretches::new(&mut *reader, 0, std::iter::once(0..10))).0.len(), 10);
        assert_eq!(rows_of(Stretches::new(&mut *reader, 10, std::iter::once(10..40))).0.len(), 20);
        assert_eq!(count(&mut *table(70_000)).unwrap(), 70_000);
    }

    #[test]
    fn a_budget_is_exceeded_by_one_row_more() {
        for (tables, rows, exceeded) in
            [([10, 10], 20, false), ([10, 11], 20, true), ([21, 1], 20, true), ([0, 5], 5, false)]
        {
            let budget = Budget::new(rows);
            let read: usize =
                tables.iter().map(|&rows| rows_of(Within::new(table(rows), &budget)).0.len()).sum();
            assert_eq!((read, budget.is_exceeded()), (rows.min(tables.iter().sum()), exceeded), "{tables:?}");
        }
    }
}
