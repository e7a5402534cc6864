//! Tables that commands read: the readings of joints and inputs as numbers, and every column as it came.

use model_core::names::listed;
use model_core::unit::Measures;
use model_core::{Chain, ObservableId, Quantity, Symbol, SymbolId};
#[cfg(feature = "parquet")]
use rayon::prelude::*;
#[cfg(feature = "parquet")]
use tables::formats::parquet::TextType;
use tables::formats::{
    Cells, ColumnName, DataError, Extent, Form, Kept, ReadAs, TableReader, Wanted, declared_columns,
    find_reading,
};
use tables::units::{BareColumn, Plausible};

use crate::evaluation::readings_of;
use crate::refusal::Refusal;
use crate::source;

/// Rows that are read, computed and written at a time.
const CHUNK: usize = 1 << 16;

/// Bytes of a file up to which its texts are held until the last is known.
#[cfg(feature = "parquet")]
const HELD: u64 = 1 << 26;

/// Opens a table again from its start, and says how far it has been read.
#[cfg(feature = "parquet")]
pub type Again = dyn Fn() -> Result<(Box<dyn TableReader>, Option<Extent>), Refusal> + Send + Sync;

/// A table whose columns of readings are found by the names of joints and inputs.
pub struct ReadingsTable<'t> {
    reader: Box<dyn TableReader + 't>,
    /// Names that a column can have beside that of a reading.
    declared: Vec<String>,
    readings: Vec<Reading>,
    /// Every column as it came, if they are kept, then the readings as numbers.
    wanted: Vec<Wanted>,
    /// Whether a row has been read.
    started: bool,
    /// How far a file has been read; none of what is no regular file.
    extent: Option<Extent>,
    /// What opens it again, if it is a file.
    #[cfg(feature = "parquet")]
    again: Option<Box<Again>>,
}

/// Where the readings of a joint or input come from.
struct Reading {
    symbol: SymbolId,
    /// Index of its column in the header.
    column: usize,
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
            readings: Vec::new(),
            wanted: Vec::new(),
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
        self
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

    /// What the texts of each column are that is kept as it came, from reading the whole file once before, of which `tell` hears: with that, a large
    /// table with types of its own is written as it is read. None where it is no such file, or has types itself.
    ///
    /// # Errors
    /// The file cannot be read.
    #[cfg(feature = "parquet")]
    pub fn text_types(&self, tell: impl Fn(f64)) -> Result<Option<Vec<TextType>>, Refusal> {
        let Some(again) = &self.again else { return Ok(None) };
        if self.extent.as_ref().is_none_or(|extent| extent.length() <= HELD) {
            return Ok(None);
        }
        let (reader, extent) = again()?;
        let is_kept = |wanted: &&Wanted| matches!(wanted.form, Form::Kept);
        let wanted: Vec<Wanted> = self.wanted.iter().filter(is_kept).copied().collect();
        let readings = self.readings.iter();
        let readings = readings.map(|own| Reading { symbol: own.symbol, column: own.column, bare: None });
        let mut scanned = Self {
            reader,
            declared: self.declared.clone(),
            readings: readings.collect(),
            started: false,
            extent,
            again: None,
            wanted,
        };
        let mut types = vec![TextType::default(); scanned.wanted.len()];
        while let Some(rows) = scanned.next_rows()? {
            if let Some(share) = scanned.share_read() {
                tell(share);
            }
            if rows.kept.iter().any(|kept| matches!(kept, Kept::Typed(_))) {
                return Ok(None);
            }
            types.par_iter_mut().zip(&rows.kept).for_each(|(seen, kept)| {
                if let Kept::Texts(texts) = kept {
                    seen.see(texts);
                }
            });
        }
        Ok(Some(types))
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
        self.header().iter().map(|column| named.iter().any(|name| self.means(column, name))).collect()
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
        let missing = |&id: &SymbolId| matches!(self.find(chain, id), Err(DataError::MissingColumn { .. }));
        !readings.iter().any(missing)
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

    fn find(&self, chain: &Chain, reading: SymbolId) -> Result<usize, DataError> {
        let name = &chain.symbol(reading).name;
        find_reading(self.reader.header(), name, &self.declared(), self.reader.source())
    }

    /// Finds the columns of joints and inputs by their declared names; an angle or length without a unit in the
    /// header is in SI, as the command itself writes it.
    ///
    /// # Errors
    /// A column that is not there or is there twice, or whose unit is none or measures something else.
    pub fn want(&mut self, chain: &Chain, readings: &[SymbolId]) -> Result<(), Refusal> {
        for &id in readings {
            let (column, source) = (self.find(chain, id).map_err(Refusal::of)?, self.reader.source());
            let (name, symbol) = (&self.reader.header()[column], chain.symbol(id));
            let (factor, is_bare) = factor_of(name, symbol, source).map_err(Refusal::of)?;
            let plausible = Plausible::readings(chain, id);
            let bare = || BareColumn::new(plausible, symbol.quantity, &name.full, source);
            let bare = is_bare.then(bare);
            self.readings.push(Reading { symbol: id, column, bare });
            self.wanted.push(Wanted { column, form: Form::Number(factor) });
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
        Ok(())
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
        let chunk = self.reader.read(&self.wanted, CHUNK).map_err(Refusal::of)?;
        if chunk.rows.is_empty() {
            let file = self.reader.source().to_owned();
            return if self.started { Ok(None) } else { Err(Refusal::of(DataError::NoRows { file })) };
        }
        self.started = true;
        let mut rows =
            Rows { kept: Vec::new(), readings: Vec::new(), others: Vec::new(), count: chunk.rows.len() };
        let mut readings = self.readings.iter_mut();
        for column in chunk.columns {
            match column {
                Cells::Kept(kept) => rows.kept.push(kept),
                Cells::Numbers(numbers) => {
                    // Those of the readings come first.
                    let Some(reading) = readings.next() else {
                        rows.others.push(numbers);
                        continue;
                    };
                    reading.bare.iter_mut().for_each(|bare| bare.see(&numbers));
                    rows.readings.push((reading.symbol, numbers));
                }
                Cells::Labels(_) => unreachable!("no labels are wanted"),
            }
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

    /// The columns whose numbers, as far as they were read, are hardly in SI, although nothing says another unit.
    pub fn doubtful(&self) -> impl Iterator<Item = &BareColumn> {
        self.readings.iter().filter_map(|reading| reading.bare.as_ref()).filter(|bare| bare.is_doubtful())
    }
}
