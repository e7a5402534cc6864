//! Tables that commands read: the readings of joints and inputs as numbers, and every column as it came.

mod headed;
#[cfg(feature = "parquet")]
mod types;

use model_core::names::listed;
use model_core::unit::Measures;
use model_core::{Chain, ObservableId, Quantity, Symbol, SymbolId};
use tables::formats::{
    Cells, ColumnName, DataError, Extent, Form, Kept, ReadAs, TableReader, Wanted, declared_columns,
    find_reading,
};
use tables::units::{BareColumn, Plausible};

use headed::{Beside, Headed, shifted};
use observe::Derived;
use study::{ColumnAt, Conversion, Headings, Need};

use crate::evaluation::readings_of;
use crate::refusal::Refusal;
use crate::source;

/// Rows that are read, computed and written at a time.
const CHUNK: usize = 1 << 16;

/// Opens a table again from its start, and says how far it has been read.
#[cfg(feature = "parquet")]
pub type Again = dyn Fn() -> Result<(Box<dyn TableReader>, Option<Extent>), Refusal> + Send + Sync;

/// A table whose columns of readings are found by the names of joints and inputs.
pub struct ReadingsTable<'t> {
    reader: Box<dyn TableReader + 't>,
    /// Names that a column can have beside that of a reading.
    declared: Vec<String>,
    /// The headings of a study by which columns are found, in place of the names.
    headed: Option<Headed>,
    readings: Vec<Reading>,
    /// Joints and inputs that follow from other columns.
    followed: Vec<SymbolId>,
    /// The joints and inputs that were asked for.
    asked: Vec<SymbolId>,
    /// Every column as it came, if they are kept, then the readings as numbers.
    wanted: Vec<Wanted>,
    /// What each of them is for.
    uses: Vec<Use>,
    /// Rows that take a reading from a row before or behind that the file does not have.
    without_reading: usize,
    /// Whether a row has been read.
    started: bool,
    /// How far a file has been read; none of what is no regular file.
    extent: Option<Extent>,
    /// What opens it again, if it is a file.
    #[cfg(feature = "parquet")]
    again: Option<Box<Again>>,
}

/// What a column that is wanted is for.
#[derive(Debug, Clone, PartialEq)]
enum Use {
    /// It leaves as it came.
    Kept,
    /// The reading of this place among them.
    Reading(usize),
    /// Plain numbers of this name, from which others follow.
    Numbers(String),
    /// It says the order of the rows.
    Order,
    /// What is observed, as a study writes it.
    Observed(Conversion),
    /// Whoever asked for it.
    Other,
}

/// Where the readings of a joint or input come from.
struct Reading {
    symbol: SymbolId,
    /// Index of its column in the header.
    column: usize,
    /// How its numbers become readings.
    conversion: Conversion,
    /// What is watched where nothing says its unit.
    bare: Option<BareColumn>,
}

/// Some rows of a [`ReadingsTable`].
pub struct Rows {
    /// Every column of the file as it came, if they are kept.
    pub kept: Vec<Kept>,
    /// The readings, in SI.
    pub readings: Vec<(SymbolId, Vec<f64>)>,
    /// Other columns that were asked for, in SI.
    pub others: Vec<Vec<f64>>,
    /// How many rows these are.
    pub count: usize,
}

/// The factor that takes the numbers of a column, found by the name of a joint or input, to SI; and whether nothing says their unit.
///
/// # Errors
/// A unit that is none, or that measures something else.
pub fn factor_of(column: &ColumnName, reading: &Symbol, source: &str) -> Result<(f64, bool), DataError> {
    let read = ReadAs { measures: Measures::of(reading), stated: None, declared: Some(&reading.name) };
    Ok((column.factor(read, source)?, column.is_bare(read)))
}

impl<'t> ReadingsTable<'t> {
    /// The readings of a chain in an open table, of which nothing else is wanted.
    pub fn of(reader: Box<dyn TableReader + 't>, chain: &Chain) -> Self {
        let declared = declared_columns(chain);
        Self {
            reader,
            declared,
            headed: None,
            readings: Vec::new(),
            followed: Vec::new(),
            asked: Vec::new(),
            wanted: Vec::new(),
            uses: Vec::new(),
            without_reading: 0,
            started: false,
            extent: None,
            #[cfg(feature = "parquet")]
            again: None,
        }
    }

    /// The same with every column kept as it came. Comes before anything is wanted.
    #[must_use]
    pub fn keeping_all(mut self) -> Self {
        let all = 0..self.header().len();
        self.wanted = all.map(|column| Wanted { column, form: Form::Kept }).collect();
        self.uses = self.wanted.iter().map(|_| Use::Kept).collect();
        self
    }

    /// The same of a file with the headings of a study, of which it is like the source of one of the `named` observables, or of any. Comes
    /// before anything is wanted but what is kept.
    #[must_use]
    pub fn headed_by(mut self, headings: &Headings, named: &[ObservableId]) -> Self {
        let headed = Headed::of(headings.clone(), named, self.header(), &self.declared());
        self.headed = Some(headed);
        self
    }

    /// Of which source of the study that it is headed by it is like.
    #[must_use]
    pub fn source_of_study(&self) -> Option<usize> {
        self.headed.as_ref().map(|headed| headed.source)
    }

    /// The same of a file, whose extent says how far it has been read.
    #[must_use]
    pub fn of_extent(mut self, extent: Option<Extent>) -> Self {
        self.extent = extent;
        self
    }

    /// The same of a file that can be opened again.
    #[cfg(feature = "parquet")]
    #[must_use]
    pub fn opened_by(mut self, again: Box<Again>) -> Self {
        self.again = Some(again);
        self
    }

    /// The share of the file that has been read, where that is known.
    #[must_use]
    pub fn share_read(&self) -> Option<f64> {
        self.extent.as_ref().map(Extent::share)
    }

    /// The name of the table, for messages.
    #[must_use]
    pub fn source(&self) -> &str {
        self.reader.source()
    }

    /// The columns, as they stand in the header.
    pub fn header(&self) -> &[ColumnName] {
        self.reader.header()
    }

    /// Whether a name means a column.
    #[must_use]
    pub fn means(&self, column: &ColumnName, name: &str) -> bool {
        column.means(name, &self.declared())
    }

    /// Which columns have a name of those that are added.
    #[must_use]
    pub fn replaced_by(&self, added: &[String]) -> Vec<bool> {
        // A unit in brackets is not part of the name.
        let bare = |name: &str| name.split(" [").next().map(str::to_owned);
        let named: Vec<String> = added.iter().filter_map(|name| bare(name)).collect();
        let is_named = |column: &ColumnName| {
            added.contains(&column.full) || named.iter().any(|name| self.means(column, name))
        };
        self.header().iter().map(is_named).collect()
    }

    /// The names of some columns.
    #[must_use]
    pub fn names_of(&self, is_one: &[bool]) -> Vec<String> {
        let header = self.header().iter().zip(is_one);
        header.filter(|(_, is_one)| **is_one).map(|(column, _)| column.full.clone()).collect()
    }

    /// Whether the readings of a joint or input come from a column.
    #[must_use]
    pub fn reads(&self, column: usize) -> bool {
        self.readings.iter().any(|reading| reading.column == column)
    }

    /// Whether there is a column, or more, for each of these joints and inputs.
    #[must_use]
    pub fn has(&self, chain: &Chain, readings: &[SymbolId]) -> bool {
        let missing = |need: Need| matches!(self.find(chain, &need), Err(DataError::MissingColumn { .. }));
        !readings.iter().flat_map(|id| self.needs(*id)).any(missing)
    }

    /// The observables of these names; if there is none, all that the table has the readings for.
    ///
    /// # Errors
    /// A name that the chain does not declare.
    pub fn with_readings(&self, chain: &Chain, names: &[String]) -> Result<Vec<ObservableId>, Refusal> {
        let mut chosen = source::observables(chain, names)?;
        if names.is_empty() {
            let all = chosen.clone();
            chosen.retain(|&observable| self.has(chain, &readings_of(chain, observable)));
            // If none can be evaluated, the first one's missing column is what to say.
            chosen.extend(all.first().filter(|_| chosen.is_empty()));
        }
        Ok(chosen)
    }

    fn declared(&self) -> Vec<&str> {
        self.declared.iter().map(String::as_str).collect()
    }

    /// From what the values of a joint or input come.
    fn needs(&self, reading: SymbolId) -> Vec<Need> {
        self.headed.as_ref().map_or_else(|| vec![Need::Reading(reading)], |headed| headed.needs(reading))
    }

    /// Finds a column by the headings of a study, else by the declared name of a joint or input; an angle or length without a unit in the
    /// header is in SI then, as the command itself writes it.
    fn find(&self, chain: &Chain, need: &Need) -> Result<ColumnAt, DataError> {
        let (header, source) = (self.reader.header(), self.reader.source());
        let declared = self.declared();
        if let Some(found) = self.headed.as_ref().and_then(|own| own.find(need, (header, source), &declared))
        {
            return found;
        }
        let Need::Reading(reading) = need else { unreachable!("only a study names other columns: {need:?}") };
        let symbol = chain.symbol(*reading);
        let at = find_reading(header, &symbol.name, &declared, source)?;
        let (factor, is_bare) = factor_of(&header[at], symbol, source)?;
        Ok(ColumnAt { at, factor, is_bare, conversion: Conversion::NONE })
    }

    /// Finds the columns of joints and inputs.
    ///
    /// # Errors
    /// A column that is not there or is there twice, or whose unit is none or measures something else.
    pub fn want(&mut self, chain: &Chain, readings: &[SymbolId]) -> Result<(), Refusal> {
        self.asked.extend(readings);
        for &id in readings {
            if self.headed.as_ref().is_some_and(|headed| headed.derived(id).is_some()) {
                self.followed.push(id);
            }
            for need in self.needs(id) {
                self.want_one(chain, need)?;
            }
        }
        Ok(())
    }

    fn want_one(&mut self, chain: &Chain, need: Need) -> Result<(), Refusal> {
        let found = self.find(chain, &need).map_err(Refusal::of)?;
        let (column, form) = (found.at, Form::Number(found.factor));
        let (form, own) = match need {
            Need::Reading(symbol) if self.readings.iter().any(|own| own.symbol == symbol) => return Ok(()),
            Need::Reading(symbol) => {
                let declared = chain.symbol(symbol);
                let source = self.reader.source();
                let name = &self.reader.header()[column].full;
                let bare =
                    || BareColumn::new(Plausible::readings(chain, symbol), declared.quantity, name, source);
                let bare = found.is_bare.then(bare);
                self.readings.push(Reading { symbol, column, conversion: found.conversion, bare });
                (form, Use::Reading(self.readings.len() - 1))
            }
            Need::Numbers(name) => (form, Use::Numbers(name)),
            Need::Order(_) => (Form::Label, Use::Order),
        };
        if matches!(own, Use::Reading(_)) || !self.uses.contains(&own) {
            self.wanted.push(Wanted { column, form });
            self.uses.push(own);
        }
        Ok(())
    }

    /// Asks for another column by its name, after all readings; without a unit in the header it is in SI.
    ///
    /// # Errors
    /// As [`ReadingsTable::want`].
    pub fn want_other(&mut self, name: &str, quantity: Quantity) -> Result<(), Refusal> {
        let source = self.reader.source();
        let column =
            find_reading(self.reader.header(), name, &self.declared(), source).map_err(Refusal::of)?;
        let read = ReadAs { measures: quantity.into(), stated: None, declared: Some(name) };
        let factor = self.reader.header()[column].factor(read, source).map_err(Refusal::of)?;
        self.wanted.push(Wanted { column, form: Form::Number(factor) });
        self.uses.push(Use::Other);
        Ok(())
    }

    /// Asks for the columns of what is observed as the study has them, after all readings.
    ///
    /// # Errors
    /// As [`ReadingsTable::want`].
    pub fn want_observed(&mut self) -> Result<(), Refusal> {
        let (header, source) = (self.reader.header(), self.reader.source());
        let Some(headed) = &self.headed else { return Ok(()) };
        let found = headed.find_observed((header, source), &self.declared()).map_err(Refusal::of)?;
        for column in found {
            self.wanted.push(Wanted { column: column.at, form: Form::Number(column.factor) });
            self.uses.push(Use::Observed(column.conversion));
        }
        Ok(())
    }

    /// Whether the columns of what is observed are there as the study has them.
    #[must_use]
    pub fn has_observed(&self) -> bool {
        let (header, source) = (self.reader.header(), self.reader.source());
        let found =
            self.headed.as_ref().map(|headed| headed.find_observed((header, source), &self.declared()));
        found.is_some_and(|found| found.is_ok_and(|found| !found.is_empty()))
    }

    /// What to warn of where columns of the input are not in the output, since what was computed has their names. Where readings are
    /// solved for, those of the input were read as starts.
    #[must_use]
    pub fn lost(&self, is_replaced: &[bool]) -> Option<String> {
        let is_lost = is_replaced.iter().enumerate().map(|(at, replaced)| *replaced && !self.reads(at));
        let columns = self.names_of(&is_lost.collect::<Vec<_>>());
        let names = listed(columns.iter().map(String::as_str));
        match columns.len() {
            0 => None,
            1 => Some(format!("the input's own column {names} was replaced")),
            _ => Some(format!("the input's own columns {names} were replaced")),
        }
    }

    /// The next rows; `None` at the end.
    ///
    /// # Errors
    /// A cell that cannot be read, with its place; no rows at all.
    pub fn next_rows(&mut self) -> Result<Option<Rows>, Refusal> {
        let Some((cells, count)) = self.read()? else {
            let file = self.reader.source().to_owned();
            return if self.started { Ok(None) } else { Err(Refusal::of(DataError::NoRows { file })) };
        };
        self.started = true;
        let mut rows = Rows { kept: Vec::new(), readings: Vec::new(), others: Vec::new(), count };
        let mut beside = Beside::default();
        let shifts = || self.readings.iter().map(|reading| reading.conversion.shift);
        let (forward, back) = (shifts().max().unwrap_or(0).max(0), shifts().min().unwrap_or(0).min(0));
        self.without_reading += usize::try_from(forward - back).map_or(count, |rows| rows.min(count));
        for (column, own) in cells.into_iter().zip(&self.uses) {
            match (column, own) {
                (Cells::Kept(kept), _) => rows.kept.push(kept),
                (Cells::Labels(labels), _) => beside.order = Some(labels),
                (Cells::Numbers(mut numbers), Use::Reading(at)) => {
                    let reading = &mut self.readings[*at];
                    reading.bare.iter_mut().for_each(|bare| bare.see(&numbers));
                    if reading.conversion != Conversion::NONE {
                        numbers.iter_mut().for_each(|number| *number = reading.conversion.value(*number));
                    }
                    if reading.conversion.shift != 0 {
                        numbers = shifted(&numbers, reading.conversion.shift);
                    }
                    rows.readings.push((reading.symbol, numbers));
                }
                (Cells::Numbers(numbers), Use::Numbers(name)) => beside.numbers.push((name.clone(), numbers)),
                (Cells::Numbers(mut numbers), Use::Observed(conversion)) => {
                    numbers.iter_mut().for_each(|number| *number = conversion.value(*number));
                    rows.others.push(numbers);
                }
                (Cells::Numbers(numbers), _) => rows.others.push(numbers),
            }
        }
        if let Some(headed) = &self.headed {
            let file = self.reader.source();
            let followed = headed.follow(&self.followed, &rows.readings, &beside, file);
            rows.readings.extend(followed.map_err(Refusal::of)?);
            // Some were read because others follow from them.
            rows.readings.retain(|(id, _)| self.asked.contains(id));
        }
        for reading in &self.readings {
            // What was read as a number with a decimal comma is no number between commas.
            if let Some(Kept::Texts(texts)) = rows.kept.get_mut(reading.column)
                && texts.contain(',')
            {
                *texts = texts.iter().map(|text| text.replace(',', ".")).collect();
            }
        }
        Ok(Some(rows))
    }

    /// The cells of the next rows, and how many these are; of all rows where some follow from those before them.
    fn read(&mut self) -> Result<Option<(Vec<Cells>, usize)>, Refusal> {
        let follows = |id: &SymbolId| {
            let derived = self.headed.as_ref().and_then(|headed| headed.derived(*id));
            derived.is_some_and(Derived::follows_rows)
        };
        let mut is_left = self.followed.iter().any(follows)
            || self.readings.iter().any(|reading| reading.conversion.shift != 0);
        let chunk = self.reader.read(&self.wanted, CHUNK).map_err(Refusal::of)?;
        if chunk.rows.is_empty() {
            return Ok(None);
        }
        let (mut cells, mut count) = (chunk.columns, chunk.rows.len());
        while is_left {
            let chunk = self.reader.read(&self.wanted, CHUNK).map_err(Refusal::of)?;
            is_left = !chunk.rows.is_empty();
            if is_left {
                count += chunk.rows.len();
                cells.iter_mut().zip(chunk.columns).for_each(|(all, more)| all.append(more));
            }
        }
        Ok(Some((cells, count)))
    }

    /// How many rows take a reading from a row that the file does not have: what is computed of them is no number.
    #[must_use]
    pub fn without_reading(&self) -> usize {
        self.without_reading
    }

    /// The columns whose numbers, as far as they were read, are hardly in SI, although nothing says another unit.
    pub fn doubtful(&self) -> impl Iterator<Item = &BareColumn> {
        self.readings.iter().filter_map(|reading| reading.bare.as_ref()).filter(|bare| bare.is_doubtful())
    }
}
