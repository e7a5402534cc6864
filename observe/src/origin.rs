//! Where observations stand: in which file, on which line of it, and by what name of their own.

use super::Numbers;

/// Where rows stand; empty for rows that come from no file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origins {
    /// Every file, as messages name it.
    files: Vec<String>,
    places: Places,
    /// Per row what the study's column of names says; empty if it names none.
    names: Vec<String>,
}

/// Per row the index of its file, and its line there, from 1; 0 where the format has no lines.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Places {
    file: Numbers,
    line: Numbers,
}

impl Places {
    /// Appends rows of one file.
    pub fn extend(&mut self, file: u32, lines: impl Iterator<Item = u64>) {
        self.line.extend(lines);
        self.file.extend(std::iter::repeat_n(u64::from(file), self.line.len() - self.file.len()));
    }

    /// The line that a row stands on, where the format has lines.
    pub fn line(&self, row: usize) -> Option<u64> {
        self.line.get(row).filter(|&line| line > 0)
    }

    /// Those of some rows, in the order given.
    pub fn select(&self, rows: &[usize]) -> Self {
        Self { file: self.file.select(rows), line: self.line.select(rows) }
    }
}

/// Where one row stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Origin<'a> {
    /// Its file, where the rows come from several.
    pub file: Option<&'a str>,
    /// Its line in the file, from 1, where the format has lines.
    pub line: Option<u64>,
    /// Its own name.
    pub name: Option<&'a str>,
}

impl Origins {
    /// Where a row stands, as far as that is known.
    #[must_use]
    pub fn of(&self, row: usize) -> Origin<'_> {
        let place = self.places.file.get(row).filter(|_| self.files.len() > 1);
        let file = place.and_then(|place| self.files.get(place as usize));
        Origin {
            file: file.map(String::as_str),
            line: self.places.line(row),
            name: self.names.get(row).map(String::as_str),
        }
    }

    /// Whether rows come from several files.
    #[must_use]
    pub fn has_files(&self) -> bool {
        self.files.len() > 1
    }

    /// Whether rows have names.
    #[must_use]
    pub fn has_names(&self) -> bool {
        !self.names.is_empty()
    }

    /// A file that further rows stand in; returns its index.
    pub fn file(&mut self, file: &str) -> u32 {
        let known = self.files.iter().position(|known| known == file);
        let at = known.unwrap_or_else(|| {
            self.files.push(file.to_owned());
            self.files.len() - 1
        });
        at as u32
    }

    /// Appends rows with their places, and their names where the study says a column of them.
    pub fn extend(&mut self, places: &Places, names: Option<&[String]>) {
        self.places.file.extend(places.file.iter());
        self.places.line.extend(places.line.iter());
        self.names.extend(names.unwrap_or_default().iter().cloned());
    }

    /// Those of some rows.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        Self {
            files: self.files.clone(),
            places: self.places.select(rows),
            names: rows.iter().filter_map(|&row| self.names.get(row).cloned()).collect(),
        }
    }
}
