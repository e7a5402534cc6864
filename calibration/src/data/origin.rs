//! Where observations stand: in which file, on which line of it, and by what name of their own.

/// Where rows stand; empty for rows that come from no file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origins {
    /// Every file, as messages name it.
    files: Vec<String>,
    /// Per row the index of its file, and its line there, from 1; 0 where the format has no lines.
    places: Vec<(u32, u64)>,
    /// Per row what the study's column of names says; empty if it names none.
    names: Vec<String>,
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
        let place = self.places.get(row);
        let file = place.filter(|_| self.files.len() > 1).and_then(|place| self.files.get(place.0 as usize));
        Origin {
            file: file.map(String::as_str),
            line: place.map(|place| place.1).filter(|&line| line > 0),
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
    pub(crate) fn file(&mut self, file: &str) -> u32 {
        let known = self.files.iter().position(|known| known == file);
        let at = known.unwrap_or_else(|| {
            self.files.push(file.to_owned());
            self.files.len() - 1
        });
        at as u32
    }

    /// Appends rows with their places, and their names where the study says a column of them.
    pub(crate) fn extend(&mut self, places: &[(u32, u64)], names: Option<&[String]>) {
        self.places.extend(places);
        self.names.extend(names.unwrap_or_default().iter().cloned());
    }

    /// Those of some rows.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        Self {
            files: self.files.clone(),
            places: rows.iter().filter_map(|&row| self.places.get(row).copied()).collect(),
            names: rows.iter().filter_map(|&row| self.names.get(row).cloned()).collect(),
        }
    }
}
