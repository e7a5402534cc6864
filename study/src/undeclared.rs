//! Columns that a file has and a study does not name: what a few values that come back in many rows may say of how rows were measured.

use std::collections::BTreeMap;

use observe::{Numbers, Observations};
use tables::formats::{Cells, Form, TableReader, Wanted};

/// Columns of a file that are looked at, at most.
const MOST_COLUMNS: usize = 12;

/// Rows that one value has on average at least; fewer name rows and not what rows share.
const ROWS_OF_VALUE: usize = 5;

/// A column that no study names, with the number of each row's value in order of first appearance.
#[derive(Debug, Clone, PartialEq)]
pub struct Undeclared {
    /// Its name in the file.
    pub column: String,
    /// The number of each row's value.
    pub of_row: Vec<usize>,
}

/// A column of numbers that no study names.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// Its name in the file.
    pub name: String,
    /// As the file has them, a number for each row of a sample.
    pub numbers: Vec<f64>,
}

/// Columns while a file is read: of each the values by the number of their row.
#[derive(Debug, Clone, Default)]
pub(super) struct Labelled {
    columns: Vec<(String, BTreeMap<u64, String>)>,
}

impl Labelled {
    /// The columns of a file that are read beside those that are wanted, each with its name.
    pub fn beside(wanted: &[Wanted], reader: &dyn TableReader) -> Vec<(String, Wanted)> {
        if !reader.gives_any_label() {
            return Vec::new();
        }
        let free = (0..reader.header().len()).filter(|at| wanted.iter().all(|want| want.column != *at));
        let named =
            free.map(|at| (reader.header()[at].full.clone(), Wanted { column: at, form: Form::Label }));
        named.take(MOST_COLUMNS).collect()
    }

    /// Takes up cells of rows by their numbers.
    pub fn take(
        &mut self,
        names: &[(String, Wanted)],
        rows: impl Iterator<Item = u64> + Clone,
        cells: Vec<Cells>,
    ) {
        for ((name, _), cells) in names.iter().zip(cells) {
            let Cells::Labels(values) = cells else { continue };
            let at = self.columns.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
                self.columns.push((name.clone(), BTreeMap::new()));
                self.columns.len() - 1
            });
            self.columns[at].1.extend(rows.clone().zip(values.iter().map(|value| value.trim().to_owned())));
        }
    }

    /// Forgets all: rows are too many for what hangs on a few values.
    pub fn forget(&mut self) {
        self.columns.clear();
    }

    /// The columns of which each of some rows, by their numbers, has a number.
    pub fn numbers(&self, rows: &Numbers) -> Vec<Beside> {
        let of_column = |(name, values): &(String, BTreeMap<u64, String>)| {
            let numbers =
                rows.iter().map(|row| values.get(&row)?.parse().ok().filter(|own: &f64| own.is_finite()));
            Some(Beside { name: name.clone(), numbers: numbers.collect::<Option<_>>()? })
        };
        self.columns.iter().filter_map(of_column).collect()
    }

    /// The columns of which every one of some observations has a value, and few of them.
    pub fn of(&self, observations: &Observations) -> Vec<Undeclared> {
        let of_column = |(name, values): &(String, BTreeMap<u64, String>)| {
            let mut known: BTreeMap<&str, usize> = BTreeMap::new();
            let mut of_row = Vec::with_capacity(observations.rows());
            for row in 0..observations.rows() {
                let next = known.len();
                of_row.push(*known.entry(values.get(&observations.row_number(row))?).or_insert(next));
            }
            let is_shared = known.len() > 1 && known.len() * ROWS_OF_VALUE <= observations.rows();
            is_shared.then(|| Undeclared { column: name.clone(), of_row })
        };
        self.columns.iter().filter_map(of_column).collect()
    }
}
