//! Formats of measured data: one file a format, all read as tables of named columns, chunk by chunk.
//!
//! | format | file | known by |
//! |---|---|---|
//! | separated values | [`csv`] | nothing else |
//! | plate solves as separated values | `plate_solves` | right ascensions and declinations of both sides in the header |
//! | tests of machine tools as separated values | [`machine_tools`] | deviations beside positions or an angle in the header |
//! | TPOINT observations | `tpoint` | its options, or the ending `.dat` |
//! | GSI of Leica | `gsi` | its words |
//! | models of MountWizzard4 | `mountwizard` | JSON with its keys |
//! | point files of AutoSlew, which plugins of NINA write | `pox` | a count, then `"Number 1"` |
//! | trajectories as SBET | [`sbet`] | records of plausible numbers, or the ending `.sbet` |
//! | columns in memory | [`memory`] | a program hands them over |
//! | Parquet, with the feature of that name | `parquet` | the ending `.parquet` |
//!
//! Formats are parsed from an [`Input`]; opening files is the command's part. `seen` decides which one a file has.

pub mod csv;
mod decimal;
mod error;
mod gsi;
mod header;
mod held;
mod input;
pub mod machine_tools;
pub mod memory;
mod mountwizard;
mod number;
mod options;
mod packed;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod part;
mod plate_solves;
mod pox;
mod quote;
mod records;
pub mod sbet;
mod seen;
mod separator;
mod sexagesimal;
pub mod sha256;
mod sights;
mod texts;
mod tpoint;
mod words;
mod write;

use std::borrow::Cow;
use std::io::{self, Read};

pub use decimal::numbers;
pub use error::clipped;
pub use error::{Cell, DataError};
pub use header::{ColumnName, ReadAs, declared_columns, find_column, find_reading};
pub use input::{Extent, Input, Ranged};
pub use number::push_number;
pub use options::Options;
pub use quote::write_row;
pub use sexagesimal::sexagesimal;
pub use sights::Site;
pub use texts::Texts;
pub use words::words;
pub use write::{Written, write_rows};

/// One column of a chunk.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Finite numbers, times the factor that was asked for.
    Numbers(Vec<f64>),
    /// The text of the cells, without the space around them that no quotes hold.
    Labels(Vec<String>),
    /// The cells as they came.
    Kept(Kept),
}

impl Cells {
    /// Appends cells of the same column of the same file, read in the same way.
    pub fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Numbers(own), Self::Numbers(more)) => own.extend(more),
            (Self::Labels(own), Self::Labels(more)) => own.extend(more),
            (Self::Kept(own), Self::Kept(more)) => own.append(more),
            _ => unreachable!("the parts of one file hold a column in one way"),
        }
    }
}

/// A column that no command computes: it leaves as it came.
#[derive(Debug, Clone, PartialEq)]
pub enum Kept {
    /// Texts.
    Texts(Texts),
    /// Values with their types.
    #[cfg(feature = "parquet")]
    Typed(parquet::TypedCells),
}

impl Kept {
    /// What the cells say.
    ///
    /// # Errors
    /// A cell that no text can say, such as a time that no calendar has.
    pub fn texts(&self) -> Result<Cow<'_, Texts>, DataError> {
        match self {
            Self::Texts(texts) => Ok(Cow::Borrowed(texts)),
            #[cfg(feature = "parquet")]
            Self::Typed(cells) => cells.texts().map(Cow::Owned),
        }
    }

    /// Appends cells of the same column of the same file.
    pub fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Texts(texts), Self::Texts(more)) => texts.append(&more),
            #[cfg(feature = "parquet")]
            (Self::Typed(cells), Self::Typed(more)) => cells.append(more),
            #[cfg(feature = "parquet")]
            _ => unreachable!("the chunks of one file hold a column in one way"),
        }
    }
}

/// Some rows of a column that is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// Numbers.
    Numbers(Vec<f64>),
    /// A column that came from elsewhere, and leaves as it came.
    Kept(Kept),
}

/// As what a column is to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// Numbers times this factor (to SI).
    Number(f64),
    /// Texts that are compared.
    Label,
    /// Whatever they are, to be written again.
    Kept,
}

/// A column that is to be read, and as what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Index in the header.
    pub column: usize,
    /// As what.
    pub form: Form,
}

/// Consecutive rows of a file, column by column in the order wanted.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chunk {
    /// The columns that were wanted.
    pub columns: Vec<Cells>,
    /// Number of each row, counted from 1 without the header.
    pub rows: Vec<u64>,
    /// The line that each row starts on, from 1; none where the format has no lines.
    pub lines: Vec<u64>,
}

impl Chunk {
    /// Appends rows that were counted as if they began their file, in which so many rows and lines come before them.
    fn append_part(&mut self, part: Self, rows: u64, lines: u64) {
        self.columns.iter_mut().zip(part.columns).for_each(|(own, more)| own.append(more));
        self.rows.extend(part.rows.iter().map(|row| rows + row));
        self.lines.extend(part.lines.iter().map(|line| lines + line));
    }
}

/// A table that is read front to back, on whatever thread.
pub trait TableReader: Send {
    /// Name of the file or stream, for messages.
    fn source(&self) -> &str;

    /// The columns there are.
    fn header(&self) -> &[ColumnName];

    /// Whether every column can be had as labels, whatever its cells hold.
    fn gives_any_label(&self) -> bool {
        false
    }

    /// The latitude of the site, degrees, where the file says it.
    fn latitude_deg(&self) -> Option<f64> {
        None
    }

    /// What the user should know of the file.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    /// What the file lacks to be read as the test of a machine tool that it seems to be.
    fn lacks(&self) -> Option<&str> {
        None
    }

    /// The columns from which the format itself has computed others: they say nothing that those do not.
    fn behind(&self) -> &[usize] {
        &[]
    }

    /// The next rows, at most so many, and fewer where they are long; no rows at the end.
    ///
    /// # Errors
    /// A cell that cannot be read as what was wanted, with its place.
    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError>;
}

/// A column without cells for each that is wanted.
fn no_cells(wanted: &[Wanted]) -> Vec<Cells> {
    let empty = |want: &Wanted| match want.form {
        Form::Number(_) => Cells::Numbers(Vec::new()),
        Form::Label => Cells::Labels(Vec::new()),
        Form::Kept => Cells::Kept(Kept::Texts(Texts::default())),
    };
    wanted.iter().map(empty).collect()
}

/// The form of another program's files, which are read whole.
struct WholeFile {
    /// What it is called in messages.
    name: &'static str,
    /// Whether a beginning is that of such a file.
    looks: fn(&str) -> bool,
    /// Reads the text of a file of this name.
    read: fn(&str, &str, &Options) -> Result<held::Held, DataError>,
}

/// Every such form.
const FORMS: &[WholeFile] = &[tpoint::FORM, gsi::FORM, mountwizard::FORM, pox::FORM];

/// Reads the whole of a file whose format must be held in memory, within the budget.
///
/// # Errors
/// It cannot be read, or is larger than the budget.
fn whole(reader: impl Read, source: &str, options: &Options) -> Result<Vec<u8>, DataError> {
    let mut bytes = Vec::new();
    reader
        .take(options.memory_bytes.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| DataError::Unreadable { file: source.to_string(), why: error.to_string() })?;
    options.holds(bytes.len(), source)?;
    Ok(bytes)
}

/// Opens a table: a Parquet file by the ending of its name, anything else by what it begins with.
///
/// # Errors
/// The header cannot be read, or there is none.
pub fn open<'r>(
    input: impl Into<Input<'r>>,
    source: &str,
    options: &Options,
) -> Result<Box<dyn TableReader + 'r>, DataError> {
    let input = input.into();
    let ending = source.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    match ending.as_deref() {
        #[cfg(feature = "parquet")]
        Some("parquet") => Ok(Box::new(parquet::Reader::new(input, source, options)?)),
        #[cfg(not(feature = "parquet"))]
        Some("parquet") => Err(DataError::NoParquet { file: source.to_string() }),
        _ => text(input.front_to_back(), source, options),
    }
}

/// Opens records or a text. Not generic, so that what reads it is compiled with this crate and optimised as it is.
fn text<'r>(
    mut reader: Box<dyn Read + Send + 'r>,
    source: &str,
    options: &Options,
) -> Result<Box<dyn TableReader + 'r>, DataError> {
    let mut head = Vec::new();
    reader
        .by_ref()
        .take(seen::PEEK)
        .read_to_end(&mut head)
        .map_err(|error| DataError::Unreadable { file: source.to_string(), why: error.to_string() })?;
    if sbet::is_named(source) || sbet::looks(&head) {
        return Ok(Box::new(sbet::Reader::new(Box::new(io::Cursor::new(head).chain(reader)), source)));
    }
    let form = seen::form(&head, source)?;
    let all = io::Cursor::new(head).chain(reader);
    match form {
        Some(form) => {
            let bytes = whole(all, source, options)?;
            let text = String::from_utf8_lossy(&bytes);
            Ok(Box::new((form.read)(text.trim_start_matches('\u{feff}'), source, options)?))
        }
        None => {
            let comments = seen::comments(all.get_ref().0.get_ref());
            let table = csv::Reader::new(all, source, options)?;
            Ok(machine_tools::seen(plate_solves::seen(table, &comments, options)?, &comments))
        }
    }
}
