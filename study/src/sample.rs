//! Some of the rows of a study as its files have them, so that a column can be read otherwise than the study says.

use std::ops::Range;

use model_core::{Quantity, SymbolId};

use super::columns::Columns;
use super::conversion::{Conversion, Notation, to_digits};
use super::labels::Numbered;
use super::plan::Plan;
use super::rows::Rows;
use super::undeclared::{Beside, Labelled, Undeclared};
use observe::Observations;
use tables::formats::DataError;

/// Rows of a source that are kept, in blocks of rows that follow each other.
const ROWS: usize = 240;
const BLOCKS: usize = 6;

/// Rows of a source that are kept where they observe objects, and how many of each object at least: fewer say nothing of it.
const ROWS_OF_OBJECTS: usize = 1500;
const OF_OBJECT: usize = 6;

/// Decimal digits of a number as it was written that survive its conversion to SI and back.
const DIGITS: i32 = 14;

/// Rows of every source, with the columns that they were read by.
#[derive(Debug, Clone, Default)]
pub struct Sample {
    sources: Vec<Sampled>,
    /// Of each source the columns that the study does not name.
    undeclared: Vec<Labelled>,
}

#[derive(Debug, Clone)]
struct Sampled {
    columns: Columns,
    rows: Rows,
    /// To which block of rows that follow each other each belongs.
    block: Vec<usize>,
    /// Numbers of the same rows in columns that the study does not name.
    beside: Vec<Beside>,
}

/// A sample decides nothing of whether two sets of data are the same.
impl PartialEq for Sample {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Where a column stands among those of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The source.
    pub source: usize,
    /// The column among those of the source.
    pub column: usize,
}

/// What a column is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Read {
    /// The readings of a joint or an input.
    Reading(SymbolId),
    /// A component of what was observed.
    Observed(usize),
}

/// A column that may be read otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledColumn {
    /// Where it stands.
    pub place: Place,
    /// What it is read as.
    pub read: Read,
    /// Its name in the file.
    pub name: String,
    /// Its quantity.
    pub quantity: Quantity,
    /// What its numbers are multiplied by to be in SI.
    pub factor: f64,
    /// Whether the study says its unit.
    pub unit_is_of_study: bool,
    /// Whether its header says none, so that a study may say another.
    pub unit_is_open: bool,
    /// Its heading in the file.
    pub heading: String,
    /// Its numbers as the file has them.
    pub written: Vec<f64>,
}

/// How a file writes a column of what was observed.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenColumn {
    /// Its heading.
    pub heading: String,
    /// The size of its unit, rad, m or 1; `None` where its digits are packed, or where files differ.
    pub in_si: Option<f64>,
    /// Whether some of its numbers are below zero.
    pub below_zero: bool,
}

/// How a column is read otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Its numbers are this many rad or m.
    Factor(f64),
    /// Its digits are degrees or hours, minutes and seconds.
    Notation(Notation),
    /// It counts the other way, from here, rad or m.
    Reversed(f64),
    /// It counts from elsewhere: this is added, rad or m.
    Moved(f64),
    /// The other column stands there.
    Exchanged(Place),
    /// Rows take the number of the row that stands so many before.
    Shift(i64),
    /// It is what a column that the study does not name has more than it.
    Short {
        /// That column, among those beside.
        of: usize,
        /// What its numbers are multiplied by to be in SI.
        in_si: f64,
    },
}

/// A column with how it is read otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Changed {
    /// Which column.
    pub place: Place,
    /// How it is read.
    pub change: Change,
    /// The rows of the sample that are read so.
    pub rows: Range<usize>,
}

impl Changed {
    /// A change of all rows.
    #[must_use]
    pub fn all(place: Place, change: Change) -> Self {
        Self { place, change, rows: 0..usize::MAX }
    }
}

impl Sample {
    /// Takes some rows of a source; `objects` has the number of what each row observes, where that is an object.
    pub(super) fn take(&mut self, columns: &Columns, rows: &Rows, objects: Option<&[u32]>) {
        let kept = objects.map_or_else(|| in_blocks(rows.row_numbers.len()), of_objects);
        let undeclared = rows.undeclared.clone();
        let block = blocks(&kept);
        let rows = rows.select(&kept);
        let beside = undeclared.numbers(&rows.row_numbers);
        self.undeclared.push(undeclared);
        self.sources.push(Sampled { columns: columns.clone(), rows, block, beside });
    }

    /// Columns that the study does not name and of which a few values come back in all rows of some observations of one source.
    #[must_use]
    pub fn undeclared(&self, observations: &Observations) -> Vec<Undeclared> {
        match self.undeclared.as_slice() {
            [only] => only.of(observations),
            _ => Vec::new(),
        }
    }

    /// Columns of numbers of a source that the study does not name.
    #[must_use]
    pub fn beside(&self, source: usize) -> &[Beside] {
        self.sources.get(source).map_or(&[], |own| &own.beside)
    }

    /// How the files of each source write what was observed, column by column.
    #[must_use]
    pub fn observed(&self) -> Vec<Vec<WrittenColumn>> {
        let of_source = |Sampled { columns, rows, .. }: &Sampled| {
            let column = |at: usize| {
                let conversion = columns.plans[at].conversion;
                let is_below = |reading: &f64| conversion.plain(*reading) < 0.0;
                WrittenColumn {
                    heading: rows.headings[at].clone(),
                    in_si: rows.factors[at].filter(|_| conversion.notation.is_none()),
                    below_zero: rows.numbers[at].iter().any(is_below),
                }
            };
            columns.observed.clone().map(column).collect()
        };
        self.sources.iter().map(of_source).collect()
    }

    /// Every column of joints, inputs and observed components whose numbers stand in the file as the study reads them.
    #[must_use]
    pub fn columns(&self) -> Vec<SampledColumn> {
        let mut all = Vec::new();
        for (source, Sampled { columns, rows, .. }) in self.sources.iter().enumerate() {
            let readings = columns.readings.iter().map(|(id, at)| (Read::Reading(*id), *at));
            let observed =
                columns.observed.clone().enumerate().map(|(at, column)| (Read::Observed(at), column));
            for (read, column) in readings.chain(observed) {
                let (plan, factor) = (&columns.plans[column], rows.factors[column]);
                let (Conversion::NONE, Some(factor)) = (plan.conversion, factor) else { continue };
                all.push(SampledColumn {
                    place: Place { source, column },
                    read,
                    name: plan.name.clone(),
                    quantity: plan.measures.quantity(),
                    factor,
                    unit_is_of_study: plan.unit.is_some(),
                    unit_is_open: !rows.headed[column],
                    heading: rows.headings[column].clone(),
                    written: rows.numbers[column].iter().map(|si| as_written(*si, factor)).collect(),
                });
            }
        }
        all
    }

    /// What the rows observe, with some columns read otherwise; nothing is left out of the sample but rows that a shift leaves without a
    /// number.
    ///
    /// # Errors
    /// What is impossible in a row when it is read so.
    pub fn observations(&self, plan: &Plan, changes: &[Changed]) -> Result<Observations, DataError> {
        let mut all = plan.no_observations();
        let mut numbered = Numbered::default();
        for (number, (source, sampled)) in plan.sources.iter().zip(&self.sources).enumerate() {
            let own: Vec<Changed> =
                changes.iter().filter(|own| own.place.source == number).cloned().collect();
            for path in &source.paths {
                all.origins.file(path);
            }
            let mut rows = sampled.changed(&own);
            plan.observe(&mut all, source, &sampled.columns, &mut rows, &mut numbered)?;
        }
        Ok(all)
    }
}

impl Sampled {
    fn changed(&self, changes: &[Changed]) -> Rows {
        let mut rows = self.rows.clone();
        let mut kept = vec![true; self.block.len()];
        for Changed { place, change, rows: those } in changes {
            // One change behind another; what is exchanged comes from the file.
            let own = &rows.numbers[place.column];
            let factor = self.rows.factors[place.column].unwrap_or(1.0);
            let read: Vec<f64> = match *change {
                Change::Factor(other) => own.iter().map(|si| as_written(*si, factor) * other).collect(),
                Change::Notation(notation) => {
                    own.iter().map(|si| notation.unpack(as_written(*si, factor)).0).collect()
                }
                Change::Reversed(from) => own.iter().map(|si| from - si).collect(),
                Change::Moved(by) => own.iter().map(|si| si + by).collect(),
                Change::Short { of, in_si } => {
                    let other = self.beside.get(of).map_or(&[][..], |beside| &beside.numbers);
                    own.iter().zip(other).map(|(si, other)| other * in_si - si).collect()
                }
                Change::Exchanged(other) => self.rows.numbers[other.column].clone(),
                Change::Shift(by) => {
                    let from = |row: usize| {
                        let other = usize::try_from(row as i64 - by).ok();
                        other.filter(|&other| self.block.get(other) == Some(&self.block[row]))
                    };
                    for (row, kept) in kept.iter_mut().enumerate() {
                        *kept &= from(row).is_some();
                    }
                    (0..own.len()).map(|row| from(row).map_or(own[row], |other| own[other])).collect()
                }
            };
            let those = those.start..those.end.min(read.len());
            rows.numbers[place.column][those.clone()].copy_from_slice(&read[those]);
        }
        let kept: Vec<usize> = (0..kept.len()).filter(|&row| kept[row]).collect();
        if kept.len() == self.block.len() { rows } else { rows.select(&kept) }
    }
}

/// Some of so many rows, in blocks that are evenly spread.
fn in_blocks(rows: usize) -> Vec<usize> {
    if rows <= ROWS {
        return (0..rows).collect();
    }
    let length = ROWS / BLOCKS;
    let start = |block: usize| block * (rows - length) / (BLOCKS - 1);
    (0..BLOCKS).flat_map(|block| start(block)..start(block) + length).collect()
}

/// Some of the rows of every object, or all rows of some of them where there are many: each evenly spread.
fn of_objects(objects: &[u32]) -> Vec<usize> {
    if objects.len() <= ROWS_OF_OBJECTS {
        return (0..objects.len()).collect();
    }
    let mut count = vec![0; objects.iter().max().map_or(0, |last| *last as usize + 1)];
    objects.iter().for_each(|object| count[*object as usize] += 1);
    let every = (count.len() * OF_OBJECT).div_ceil(ROWS_OF_OBJECTS).max(1);
    let most = ROWS_OF_OBJECTS / count.len().div_ceil(every);
    let mut seen = vec![0; count.len()];
    let is_kept = |object: u32| {
        let object = object as usize;
        let (before, all) = (seen[object], count[object]);
        seen[object] += 1;
        object.is_multiple_of(every) && (all <= most || before * most / all != seen[object] * most / all)
    };
    let kept: Vec<bool> = objects.iter().copied().map(is_kept).collect();
    (0..objects.len()).filter(|&row| kept[row]).collect()
}

/// To which block of rows that follow each other each of some rows belongs.
fn blocks(kept: &[usize]) -> Vec<usize> {
    let mut block = 0;
    let of_row = |at: usize| {
        block += usize::from(at > 0 && kept[at] != kept[at - 1] + 1);
        block
    };
    (0..kept.len()).map(of_row).collect()
}

/// The number that was multiplied by a factor, as it was written.
fn as_written(si: f64, factor: f64) -> f64 {
    to_digits(si / factor, DIGITS)
}
