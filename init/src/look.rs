//! A table as `init` looks at it: its columns with what their names and numbers say.

use std::collections::{BTreeMap, BTreeSet};

use model_core::Quantity;
use model_core::unit::{Measures, Unit};
use tables::formats::{Cells, ColumnName, DataError, Form, TableReader, Texts, Wanted, sexagesimal};

use ::study::Notation;

use crate::NotBegun;
use crate::words::{self, Part, Side};

/// Rows that are looked at.
const ROWS: usize = 50_000;
/// Angles without a unit that reach beyond this are no radians.
const FARTHEST_RAD: f64 = 6.5;
/// Angles between a turn in degrees and a turn in gon are gon.
const GON: std::ops::RangeInclusive<f64> = 360.5..=400.5;

/// A table as its header and its first rows show it.
pub struct Look {
    /// Its name, for messages.
    pub(crate) file: String,
    pub(crate) columns: Vec<Column>,
    /// The latitude of the site, degrees, where the file says it.
    pub(crate) latitude_deg: Option<f64>,
    /// What the file itself asks to be told of it.
    pub(crate) remarks: Vec<String>,
    /// What it lacks to be read as the test of a machine tool that it seems to be.
    pub(crate) lacks: Option<String>,
}

/// One of its columns.
#[derive(Debug, Clone)]
pub struct Column {
    pub name: ColumnName,
    words: Vec<String>,
    /// The unit that the header says.
    unit: Option<Unit>,
    /// Its cells, if all of them are numbers.
    numbers: Option<Vec<f64>>,
    /// The first row whose cell is no number.
    no_number: Option<usize>,
    /// How many different texts it holds.
    pub different: usize,
    /// Which of them each cell has, where they are labels.
    labels: Vec<u32>,
    rows: usize,
}

/// A column that is read, and as what.
#[derive(Debug, Clone)]
pub struct Read {
    /// As the header names it.
    pub column: String,
    /// The unit that the study says; none for a plain number.
    pub unit: Option<&'static str>,
    /// How digits stand for its angles, where that is no unit.
    pub notation: Option<Notation>,
    /// Its numbers in SI.
    pub si: Vec<f64>,
}

impl Look {
    /// Looks at the first rows of a table.
    ///
    /// # Errors
    /// A mistake in the file; no rows; numbers where a header was expected.
    pub fn at(reader: &mut dyn TableReader) -> Result<Self, NotBegun> {
        Self::seen(reader).map_err(NotBegun::from)
    }

    fn seen(reader: &mut dyn TableReader) -> Result<Self, String> {
        let told = |error: DataError| error.to_string();
        let header = reader.header().to_vec();
        let file = reader.source().to_owned();
        if header.iter().all(|name| number(&name.full).is_some()) {
            if matches!(header.len(), 12 | 16) {
                return Err(format!(
                    "{file}: {} numbers a row are poses as matrices, and nothing says the readings of the joints there: write a header, with \
                     the joints first, such as `q1 [rad],q2 [rad],t11,t12,t13,t14 [m],t21`",
                    header.len()
                ));
            }
            return Err(format!(
                "{file}: the first line holds numbers, and no names of columns: write a header above it, such as \
                 `azimuth [deg],elevation [deg],x,y,z`"
            ));
        }
        let wanted: Vec<Wanted> =
            (0..header.len()).map(|column| Wanted { column, form: Form::Kept }).collect();
        let chunk = reader.read(&wanted, ROWS).map_err(told)?;
        if chunk.rows.is_empty() {
            return Err(DataError::NoRows { file }.to_string());
        }
        let mut columns = Vec::new();
        for (at, (name, cells)) in header.into_iter().zip(chunk.columns).enumerate() {
            if reader.behind().contains(&at) {
                continue;
            }
            let Cells::Kept(kept) = cells else { unreachable!("kept columns were wanted") };
            let texts = kept.texts().map_err(told)?;
            columns.push(Column::new(name, &texts));
        }
        Ok(Self {
            file,
            columns,
            latitude_deg: reader.latitude_deg(),
            remarks: reader.remarks(),
            lacks: reader.lacks().map(str::to_owned),
        })
    }

    /// The same without the columns of some names.
    pub(crate) fn without(&self, names: &[&str]) -> Self {
        let other = |column: &&Column| !names.contains(&column.name.stem.as_str());
        let columns = self.columns.iter().filter(other).cloned().collect();
        Self { file: self.file.clone(), columns, remarks: Vec::new(), lacks: None, latitude_deg: None }
    }

    /// The columns of some parts: those that hold numbers, or else those that only their names speak for.
    fn of(&self, parts: &[Part]) -> Vec<&Column> {
        let of = |column: &&Column| column.part().is_some_and(|part| parts.contains(&part));
        let all: Vec<&Column> = self.columns.iter().filter(of).collect();
        let numbers: Vec<&Column> = all.iter().copied().filter(|column| column.numbers.is_some()).collect();
        if numbers.is_empty() { all } else { numbers }
    }

    /// The column of one of some names, whatever unit stands behind it.
    pub(crate) fn named(&self, names: &[&str]) -> Option<&Column> {
        let of = |name: &&str| {
            self.columns.iter().find(|column| column.name.stem == **name || column.name.full == **name)
        };
        names.iter().find_map(of)
    }

    /// The column with the instrument's own reading of a part.
    ///
    /// # Errors
    /// Several could be meant.
    pub(crate) fn reading(&self, parts: &[Part]) -> Result<Option<&Column>, String> {
        let on = |side| self.of(parts).into_iter().filter(|column| column.side() == side).collect::<Vec<_>>();
        let said = on(Side::Reading);
        self.one(if said.is_empty() { on(Side::Unsaid) } else { said })
    }

    /// The column with the truth of a part: said to be, or the other one beside a reading.
    ///
    /// # Errors
    /// Several could be meant.
    pub(crate) fn truth(&self, parts: &[Part]) -> Result<Option<&Column>, String> {
        let on = |side| self.of(parts).into_iter().filter(|column| column.side() == side).collect::<Vec<_>>();
        let said = on(Side::True);
        let beside = || if on(Side::Reading).is_empty() { Vec::new() } else { on(Side::Unsaid) };
        self.one(if said.is_empty() { beside() } else { said })
    }

    fn one<'a>(&self, found: Vec<&'a Column>) -> Result<Option<&'a Column>, String> {
        match found.as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            several => {
                let names: Vec<String> =
                    several.iter().map(|column| format!("`{}`", column.name.full)).collect();
                Err(format!(
                    "{}: {} could each be meant: call what the instrument said `encoder_…` and what was true `true_…`",
                    self.file,
                    names.join(" and ")
                ))
            }
        }
    }

    /// The reading of a part that the template cannot do without.
    ///
    /// # Errors
    /// It is not there, or there several times.
    pub(crate) fn needed(&self, parts: &[Part], what: &str, names: &str) -> Result<&Column, String> {
        self.reading(parts)?.ok_or_else(|| {
            let there: Vec<String> =
                self.columns.iter().map(|column| format!("`{}`", column.name.full)).collect();
            format!("{}: no column for {what}: call it {names}; the file has {}", self.file, there.join(", "))
        })
    }

    /// Some columns as angles. Where the header says no unit, their numbers together do.
    ///
    /// # Errors
    /// A unit that is none, or of something else; hours that could be degrees.
    pub(crate) fn angles(&self, columns: &[&Column], remarks: &mut Vec<String>) -> Result<Vec<Read>, String> {
        let bare = || columns.iter().filter(|column| column.unit.is_none() && column.notation().is_none());
        let farthest = |column: &Column| column.values().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let reach = bare().map(|column| farthest(column)).fold(0.0, f64::max);
        let likely = match reach {
            reach if reach <= FARTHEST_RAD => "rad",
            reach if GON.contains(&reach) => "gon",
            _ => "deg",
        };
        columns
            .iter()
            .map(|column| {
                if let Some(notation) = column.notation() {
                    return column.packed(notation, &self.file);
                }
                let unit = column.said(Quantity::Angle, &self.file)?.map_or_else(
                    || {
                        if column.part() == Some(Part::HourAngle) && farthest(column) <= 24.0 && likely != "rad" {
                            let name = &column.name.full;
                            return Err(format!(
                                "{}: are the numbers of `{name}` hours or degrees? write `{name} [hour]` or `{name} [deg]`",
                                self.file
                            ));
                        }
                        remarks.push(format!("`{}` says no unit; by its numbers it is in {likely}", column.name.full));
                        Unit::find(likely).ok_or_else(|| unreachable!("{likely} is a unit"))
                    },
                    Ok,
                )?;
                column.read(unit, &self.file)
            })
            .collect()
    }

    /// Some columns as lengths; metres where the header says no unit.
    ///
    /// # Errors
    /// A unit that is none, or of something else.
    pub(crate) fn lengths(
        &self,
        columns: &[&Column],
        remarks: &mut Vec<String>,
    ) -> Result<Vec<Read>, String> {
        columns
            .iter()
            .map(|column| {
                let unit = column.said(Quantity::Length, &self.file)?.or_else(|| {
                    remarks.push(format!(
                        "`{}` says no unit; metres are assumed: mend it if not",
                        column.name.full
                    ));
                    Unit::find("m")
                });
                column.read(unit.unwrap_or_else(|| unreachable!("m is a unit")), &self.file)
            })
            .collect()
    }
}

impl Column {
    fn new(name: ColumnName, texts: &Texts) -> Self {
        let (words, unit) = (words::words(&name.stem), name.unit());
        let in_si = unit.map_or(1.0, |unit| unit.in_si());
        let read = |text: &str| number(text).or_else(|| sexagesimal(text, in_si));
        let numbers = texts.iter().map(read).collect();
        let no_number = texts.iter().position(|text| read(text).is_none());
        let different: BTreeSet<&str> = texts.iter().map(str::trim).collect();
        let mut column = Self {
            name,
            words,
            unit,
            numbers,
            no_number,
            different: different.len(),
            labels: Vec::new(),
            rows: texts.len(),
        };
        if column.labels_rows() {
            let numbers: BTreeMap<&str, u32> = different.into_iter().zip(0..).collect();
            column.labels = texts.iter().filter_map(|text| numbers.get(text.trim()).copied()).collect();
        }
        column
    }

    /// What it is of.
    pub fn part(&self) -> Option<Part> {
        words::part(&self.words, self.unit.is_some_and(|unit| unit.measures() == Measures::Angle))
    }

    fn side(&self) -> Side {
        words::side(&self.words)
    }

    /// Its words without one.
    pub fn words_without(&self, word: &str) -> Option<Vec<&str>> {
        let at = self.words.iter().rposition(|own| own == word)?;
        Some(
            self.words
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != at)
                .map(|(_, own)| own.as_str())
                .collect(),
        )
    }

    /// Whether its cells are labels, which come again in other rows: as often as twice on average.
    pub fn labels_rows(&self) -> bool {
        self.different > 1 && 2 * self.different <= self.rows
    }

    /// Which of its texts each cell has, where they are labels.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Whether its name has a word.
    pub fn has_word(&self, word: &str) -> bool {
        self.words.iter().any(|own| own == word)
    }

    /// Whether each row has a value of its own.
    pub fn tells_rows_apart(&self) -> bool {
        self.different == self.rows
    }

    /// Its numbers as written; none if a cell is none.
    pub fn values(&self) -> &[f64] {
        self.numbers.as_deref().unwrap_or_default()
    }

    /// It as plain numbers.
    pub fn plain(&self) -> Read {
        Read { column: self.name.full.clone(), unit: None, notation: None, si: self.values().to_vec() }
    }

    fn said(&self, quantity: Quantity, file: &str) -> Result<Option<Unit>, String> {
        let name = &self.name.full;
        let unit = self.name.said(Some(quantity.into())).map_err(|why| format!("{file}: `{name}`: {why}"))?;
        match unit {
            Some(unit) if unit.measures() != Measures::from(quantity) => Err(format!(
                "{file}: the unit of `{name}` is `{}`, which does not fit what it is",
                unit.name()
            )),
            unit => Ok(unit),
        }
    }

    fn read(&self, unit: Unit, file: &str) -> Result<Read, String> {
        self.all_numbers(file)?;
        let si = self.values().iter().map(|number| number * unit.in_si()).collect();
        Ok(Read { column: self.name.full.clone(), unit: Some(unit.name()), notation: None, si })
    }

    fn all_numbers(&self, file: &str) -> Result<(), String> {
        let refused = |row: usize| {
            format!(
                "{file}: `{}` has a cell that is no number in row {}: fill it in, or leave such rows out",
                self.name.full,
                row + 1
            )
        };
        self.no_number.map_or(Ok(()), |row| Err(refused(row)))
    }

    /// The notation that stands in brackets behind its name.
    fn notation(&self) -> Option<Notation> {
        let inside =
            self.name.full.trim_end_matches([']', ')']).rsplit(['[', '(']).next()?.trim().to_lowercase();
        match inside.as_str() {
            "ddd.mmss" | "dd.mmss" | "d.mmss" => Some(Notation::Degrees),
            "hhmmss" => Some(Notation::Hours),
            _ => None,
        }
    }

    fn packed(&self, notation: Notation, file: &str) -> Result<Read, String> {
        self.all_numbers(file)?;
        let unpack = |(row, number): (usize, &f64)| match notation.unpack(*number) {
            (angle, true) => Ok(angle),
            (_, false) => Err(format!(
                "{file}: `{}` has {number} in row {}, whose minutes or seconds are not below 60: correct it, or write the unit of \
                 decimal degrees, `[deg]`",
                self.name.full,
                row + 1
            )),
        };
        let si = self.values().iter().enumerate().map(unpack).collect::<Result<_, _>>()?;
        Ok(Read { column: self.name.full.clone(), unit: None, notation: Some(notation), si })
    }
}

/// A number as a table has it, with a decimal comma too.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let dot = || text.replacen(',', ".", 1).parse().ok();
    text.parse().ok().or_else(dot).filter(|number: &f64| number.is_finite())
}
