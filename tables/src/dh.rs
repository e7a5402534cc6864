//! Tables of Denavit and Hartenberg as separated values: a row a joint, with `theta`, `d`, `a` and `alpha`.
//!
//! Which of the two conventions a table follows stands in a line `# convention: standard` or `# convention: modified` above its header.
//!
//! Source: J. Denavit, R. S. Hartenberg, A kinematic notation for lower-pair mechanisms based on matrices (1955), as R. P. Paul (1981) has it:
//! Rz(theta) Tz(d) Tx(a) Rx(alpha), the joint first; J. J. Craig, Introduction to Robotics (2005), equation 3.6: Rx(alpha) Tx(a) Rz(theta) Tz(d),
//! with alpha and a of the link before.

use model_core::Quantity;
use model_core::unit::Measures;

use crate::formats::{
    Cell, Cells, DataError, Form, Options, TableReader, Wanted, clipped, open, sexagesimal, words,
};
use crate::urdf::Motion;

/// Where the sizes of a link stand beside its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// Behind the joint.
    Standard,
    /// alpha and a before the joint.
    Modified,
}

/// A row.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The joint.
    pub name: String,
    /// How it moves.
    pub motion: Motion,
    /// rad; of a joint that turns beside its reading.
    pub theta: f64,
    /// m; of a joint that shifts beside its reading.
    pub d: f64,
    /// m
    pub a: f64,
    /// rad
    pub alpha: f64,
}

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct Dh {
    /// Its convention.
    pub convention: Convention,
    /// Its rows from the ground outwards.
    pub links: Vec<Link>,
}

/// The columns of sizes by their words.
const SIZES: [(&str, &[&str], Quantity); 4] = [
    ("theta", &["theta", "offset", "θ"], Quantity::Angle),
    ("d", &["d"], Quantity::Length),
    ("a", &["a", "r"], Quantity::Length),
    ("alpha", &["alpha", "twist", "α"], Quantity::Angle),
];

/// Whether a text is such a table: its header has `theta`, `d`, `a` and `alpha`.
#[must_use]
pub fn looks(text: &str) -> bool {
    let header = text
        .trim_start_matches('\u{feff}')
        .lines()
        .find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let names: Vec<Vec<String>> = header.unwrap_or_default().split([',', ';', '\t']).map(stem).collect();
    SIZES.iter().all(|(_, known, _)| names.iter().filter(|words| is_of(words, known)).count() == 1)
}

fn stem(name: &str) -> Vec<String> {
    words(&crate::formats::ColumnName::parse(name).stem)
}

/// Whether the first word of a name is one of some.
fn is_of(words: &[String], known: &[&str]) -> bool {
    words.first().is_some_and(|first| known.contains(&first.as_str()))
}

impl Dh {
    /// Reads a table.
    ///
    /// # Errors
    /// No convention, a size without a unit, or a cell that cannot be read, with its place.
    pub fn of(text: &str, file: &str) -> Result<Self, DataError> {
        let convention =
            convention(text).map_err(|why| DataError::Unreadable { file: file.to_owned(), why })?;
        let mut reader = open(text.as_bytes(), file, &Options::default())?;
        let table = Table::read(&mut *reader)?;
        let rows = table.lines.len();
        if rows == 0 {
            return Err(DataError::NoRows { file: file.to_owned() });
        }
        let links = (0..rows).map(|row| table.link(row)).collect::<Result<Vec<Link>, DataError>>()?;
        Ok(Self { convention, links })
    }
}

/// The convention that a line above the header says.
fn convention(text: &str) -> Result<Convention, String> {
    let lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .take_while(|line| line.starts_with('#') || line.trim().is_empty());
    let said = lines.filter_map(|line| line.trim_start_matches('#').split_once([':', '='])).find_map(
        |(name, value)| name.trim().eq_ignore_ascii_case("convention").then(|| value.trim().to_lowercase()),
    );
    match said.as_deref() {
        Some("standard" | "distal" | "classic") => Ok(Convention::Standard),
        Some("modified" | "proximal" | "craig") => Ok(Convention::Modified),
        Some(other) => Err(format!("the convention `{}` is unknown: write standard or modified", clipped(other))),
        None => Err("a table of Denavit and Hartenberg does not show its convention: write `# convention: standard` (Rz Tz Tx Rx) or \
                     `# convention: modified` (Rx Tx Rz Tz, after Craig) above its header"
            .to_owned()),
    }
}

/// The cells of a table.
struct Table {
    file: String,
    names: Vec<String>,
    cells: Vec<Vec<String>>,
    lines: Vec<u64>,
    /// Column and unit of each size.
    sizes: [(usize, f64); 4],
    joint: Option<usize>,
    kind: Option<usize>,
}

impl Table {
    fn read(reader: &mut dyn TableReader) -> Result<Self, DataError> {
        let file = reader.source().to_owned();
        let header = reader.header().to_vec();
        let mut sizes = [(0, 1.0); 4];
        for ((_, known, quantity), own) in SIZES.iter().zip(&mut sizes) {
            let at = header.iter().position(|name| is_of(&words(&name.stem), known));
            let Some(at) = at else {
                let (column, help) = (known[0].to_owned(), "a row needs theta, d, a and alpha".to_owned());
                return Err(DataError::MissingColumn { file, column, help });
            };
            let name = &header[at];
            let unit = name.said(Some(Measures::from(*quantity))).map_err(|why| DataError::UnknownUnit {
                file: file.clone(),
                column: name.full.clone(),
                why: why.to_string(),
            })?;
            let Some(unit) = unit else {
                let column = name.full.clone();
                let why = match quantity {
                    Quantity::Angle => "is an angle without a unit: write `[deg]` or `[rad]` behind its name",
                    _ => "is a length without a unit: write `[mm]` or `[m]` behind its name",
                };
                return Err(DataError::UnusableColumn { file, column, why: why.to_owned() });
            };
            let factor = unit.factor(Measures::from(*quantity)).map_err(|error| DataError::WrongUnit {
                file: file.clone(),
                column: name.full.clone(),
                why: error.to_string(),
            })?;
            *own = (at, factor);
        }
        let find = |known: &[&str]| header.iter().position(|name| is_of(&words(&name.stem), known));
        let (joint, kind) = (find(&["joint", "link", "name"]), find(&["type", "kind", "motion"]));
        let wanted: Vec<Wanted> =
            (0..header.len()).map(|column| Wanted { column, form: Form::Label }).collect();
        let chunk = reader.read(&wanted, usize::MAX)?;
        let cells = chunk.columns.into_iter().map(|cells| match cells {
            Cells::Labels(labels) => labels,
            Cells::Numbers(_) | Cells::Kept(_) => Vec::new(),
        });
        let names = header.into_iter().map(|name| name.full).collect();
        Ok(Self { file, names, cells: cells.collect(), lines: chunk.lines, sizes, joint, kind })
    }

    fn link(&self, row: usize) -> Result<Link, DataError> {
        let [(theta, theta_by), (d, d_by), _, _] = [0, 1, 2, 3].map(|size| {
            let (column, _) = self.sizes[size];
            variable(&self.cells[column][row]).unzip()
        });
        let kind = self.kind.map(|column| self.cells[column][row].to_lowercase());
        let motion = match kind.as_deref() {
            None if d.is_some() && theta.is_none() => Motion::Shifts,
            None | Some("r" | "revolute" | "rotary" | "continuous") => Motion::Turns,
            Some("p" | "prismatic" | "linear") => Motion::Shifts,
            Some(_) => {
                let column = self.kind.unwrap_or_default();
                let text = clipped(&self.cells[column][row]);
                let why = format!("`{text}` is no kind of joint: write revolute or prismatic");
                return Err(DataError::UnusableCell { cell: self.cell(column, row), why });
            }
        };
        let size = |at: usize, beside: Option<&str>| {
            let (column, factor) = self.sizes[at];
            let text = beside.unwrap_or(&self.cells[column][row]);
            if text.is_empty() && beside.is_some() {
                return Ok(0.0);
            }
            let compact: String = text.split_whitespace().collect();
            let number = compact.replace(',', ".").parse().ok().or_else(|| sexagesimal(text, factor));
            let number = number.filter(|number: &f64| (number * factor).is_finite());
            number.map(|number| number * factor).ok_or_else(|| DataError::NotANumber {
                cell: self.cell(column, row),
                text: clipped(&self.cells[column][row]),
            })
        };
        let named = self.joint.map(|column| self.cells[column][row].clone()).filter(|name| !name.is_empty());
        let by_variable = if motion == Motion::Turns { theta } else { d };
        // A number alone is no name of a joint.
        let named = named.map(|name| if name.parse::<f64>().is_ok() { format!("q{name}") } else { name });
        Ok(Link {
            name: named.or(by_variable.map(str::to_owned)).unwrap_or_else(|| format!("q{}", row + 1)),
            motion,
            theta: size(0, theta_by)?,
            d: size(1, d_by)?,
            a: size(2, None)?,
            alpha: size(3, None)?,
        })
    }

    fn cell(&self, column: usize, row: usize) -> Cell {
        Cell {
            file: self.file.clone(),
            line: self.lines.get(row).copied(),
            row: row as u64 + 1,
            column: self.names[column].clone(),
        }
    }
}

/// The variable of a cell such as `q1` or `q2 - 90`, and what stands behind it.
fn variable(cell: &str) -> Option<(&str, &str)> {
    let cell = cell.trim();
    let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
    cell.chars().next().filter(|letter| letter.is_alphabetic())?;
    let end = cell.find(|letter| !is_name(letter)).unwrap_or(cell.len());
    let (name, rest) = cell.split_at(end);
    let rest = rest.trim_start_matches('*').trim();
    (rest.is_empty() || rest.starts_with(['+', '-'])).then_some((name, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "# convention: standard\njoint,theta [deg],d [mm],a [mm],alpha [deg]\n\
                         1,q1,100,0,90\n2,q2 - 90,0,250,0\nslide,0,d3 + 20,0,0\n";

    #[test]
    fn rows_become_links() {
        assert!(looks(TABLE) && !looks("a,d\n") && !looks("") && !looks("alpha,beta,d,theta\n"));
        let Ok(dh) = Dh::of(TABLE, "dh.csv") else { panic!("it is a table") };
        assert_eq!(dh.convention, Convention::Standard);
        let found: Vec<_> =
            dh.links.iter().map(|link| (link.name.as_str(), link.motion, link.theta, link.d)).collect();
        let quarter = -std::f64::consts::FRAC_PI_2;
        let expected = [
            ("q1", Motion::Turns, 0.0, 0.1),
            ("q2", Motion::Turns, quarter, 0.0),
            ("slide", Motion::Shifts, 0.0, 0.02),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn nothing_that_a_table_does_not_say_is_guessed() {
        for (from, to, why) in [
            ("# convention: standard\n", "", "does not show its convention"),
            ("standard", "other", "the convention `other` is unknown"),
            ("d [mm]", "d", "column `d` is a length without a unit"),
            ("alpha [deg]", "alpha", "column `alpha` is an angle without a unit"),
            ("alpha [deg]", "alpha [mm]", "`mm`"),
            ("100", "x?", "line 3, row 1, column `d [mm]`: `x?` is no number"),
            ("250", "nan", "is no number"),
            (",250,0", ",250", "cells where the header has"),
        ] {
            let said = Dh::of(&TABLE.replace(from, to), "dh.csv").map_err(|error| error.to_string());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{why}: {said:?}");
        }
    }
}
