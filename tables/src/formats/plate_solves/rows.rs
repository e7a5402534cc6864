//! The rows of a table of plate solves, held as texts, and the same with sights beside them.

use crate::formats::held::Held;
use crate::formats::sights::{NAMES, Sight};
use crate::formats::{Cell, Cells, Chunk, DataError, Form, Kept, Options, TableReader, Wanted};

/// The whole table as texts.
pub(super) struct Rows {
    pub source: String,
    pub names: Vec<String>,
    cells: Vec<Vec<String>>,
    lines: Vec<u64>,
}

impl Rows {
    /// Reads all rows.
    ///
    /// # Errors
    /// A row that cannot be read, or more than may be held.
    pub fn all(table: &mut dyn TableReader, options: &Options) -> Result<Self, DataError> {
        let source = table.source().to_owned();
        let names: Vec<String> = table.header().iter().map(|name| name.full.clone()).collect();
        let wanted: Vec<Wanted> =
            (0..names.len()).map(|column| Wanted { column, form: Form::Kept }).collect();
        let mut rows = Self { cells: vec![Vec::new(); names.len()], source, names, lines: Vec::new() };
        let mut bytes = 0;
        loop {
            let Chunk { columns, lines, .. } = table.read(&wanted, usize::MAX)?;
            if lines.is_empty() {
                return Ok(rows);
            }
            rows.lines.extend(lines);
            for (own, more) in rows.cells.iter_mut().zip(columns) {
                if let Cells::Kept(Kept::Texts(texts)) = more {
                    bytes += texts.bytes() + texts.len() * size_of::<String>();
                    own.extend(texts.iter().map(str::to_owned));
                }
            }
            options.holds(bytes, &rows.source)?;
        }
    }

    /// The table as it is.
    pub fn held(&self) -> Held {
        let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let mut held = Held::new(&self.source, &names);
        for (row, line) in self.lines.iter().enumerate() {
            held.push(Some(*line), self.cells.iter().map(|column| &column[row]));
        }
        held
    }

    /// The table with its sights behind, those that every row has.
    pub fn with_sights(&self, sights: &[Sight]) -> Held {
        let cells: Vec<[Option<f64>; 5]> = sights.iter().map(Sight::cells).collect();
        let there: Vec<usize> =
            (0..NAMES.len()).filter(|at| cells.first().is_none_or(|first| first[*at].is_some())).collect();
        let names: Vec<&str> =
            self.names.iter().map(String::as_str).chain(there.iter().map(|at| NAMES[*at])).collect();
        let mut held = Held::new(&self.source, &names);
        for (row, sight) in cells.iter().enumerate() {
            let own = self.cells.iter().map(|column| column[row].clone());
            let added = there.iter().map(|at| sight[*at].map_or_else(String::new, |cell| cell.to_string()));
            held.push(Some(self.lines[row]), own.chain(added));
        }
        held
    }

    /// The cells of a column.
    pub fn column(&self, at: usize) -> &[String] {
        &self.cells[at]
    }

    /// How many rows there are.
    pub fn count(&self) -> usize {
        self.lines.len()
    }

    /// The place of a cell.
    pub fn cell(&self, column: usize, row: usize) -> Cell {
        Cell {
            file: self.source.clone(),
            line: self.lines.get(row).copied(),
            row: row as u64 + 1,
            column: self.names[column].clone(),
        }
    }
}
