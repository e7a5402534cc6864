//! A table that is held as texts: what the file of another program says, row by row, under names of columns.

use super::decimal::parse;
use super::error::clipped;
use super::sexagesimal::sexagesimal;
use super::{Cell, Cells, Chunk, ColumnName, DataError, Form, Kept, TableReader, Texts, Wanted};

/// What separates no cell, so that a comma may be a decimal mark.
const NO_SEPARATOR: u8 = b'\n';

/// Rows of texts.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Held {
    source: String,
    header: Vec<ColumnName>,
    columns: Vec<Texts>,
    /// The line that each row starts on; empty where the format has none.
    lines: Vec<u64>,
    /// The latitude of the site, degrees, where the file says it.
    pub latitude_deg: Option<f64>,
    /// What the user should know of the file.
    pub remarks: Vec<String>,
    /// The columns that others follow from.
    pub behind: Vec<usize>,
    rows: usize,
    next: usize,
}

impl Held {
    /// A table of these columns without rows.
    pub fn new(source: &str, names: &[&str]) -> Self {
        Self {
            source: source.to_owned(),
            header: names.iter().map(|name| ColumnName::parse(name)).collect(),
            columns: vec![Texts::default(); names.len()],
            ..Self::default()
        }
    }

    /// Adds a row, with a cell for each column.
    pub fn push<S: AsRef<str>>(&mut self, line: Option<u64>, cells: impl IntoIterator<Item = S>) {
        let mut cells = cells.into_iter();
        for column in &mut self.columns {
            column.push(cells.next().as_ref().map_or("", AsRef::as_ref));
        }
        self.lines.extend(line);
        self.rows += 1;
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    fn number(&self, text: &str, column: usize, row: usize, factor: f64) -> Result<f64, DataError> {
        let text = text.trim();
        let cell = || Cell {
            file: self.source.clone(),
            line: self.lines.get(row).copied(),
            row: row as u64 + 1,
            column: self.header[column].full.clone(),
        };
        if text.is_empty() {
            return Err(DataError::EmptyCell { cell: cell() });
        }
        let number = parse(text, NO_SEPARATOR).or_else(|| sexagesimal(text, factor));
        match number {
            Some(number) if number.is_finite() => Ok(number * factor),
            Some(_) => Err(DataError::NotFinite { cell: cell(), text: clipped(text) }),
            None => Err(DataError::NotANumber { cell: cell(), text: clipped(text) }),
        }
    }
}

impl TableReader for Held {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn gives_any_label(&self) -> bool {
        true
    }

    fn latitude_deg(&self) -> Option<f64> {
        self.latitude_deg
    }

    fn remarks(&self) -> Vec<String> {
        self.remarks.clone()
    }

    fn behind(&self) -> &[usize] {
        &self.behind
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let start = self.next;
        let end = start.saturating_add(at_most).min(self.rows);
        self.next = end;
        let column = |want: &Wanted| {
            let texts = || (start..end).filter_map(|row| self.columns.get(want.column)?.get(row));
            Ok(match want.form {
                Form::Number(factor) => {
                    let numbers =
                        texts().zip(start..).map(|(text, row)| self.number(text, want.column, row, factor));
                    Cells::Numbers(numbers.collect::<Result<_, _>>()?)
                }
                Form::Label => Cells::Labels(texts().map(|text| text.trim().to_owned()).collect()),
                Form::Kept => Cells::Kept(Kept::Texts(texts().collect())),
            })
        };
        let columns = wanted.iter().map(column).collect::<Result<_, DataError>>()?;
        let lines = self.lines.get(start..end).unwrap_or_default().to_vec();
        Ok(Chunk { columns, rows: (start + 1..=end).map(|row| row as u64).collect(), lines })
    }
}
