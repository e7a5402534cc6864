//! Trajectories as SBET files: records of 17 numbers, which inertial navigation is smoothed to. Nothing in the file says what it is: size,
//! plausible numbers and increasing times do.
//!
//! Source: the description of SBET that Applanix published, as readers of point clouds have it (PDAL, `readers.sbet`): little-endian
//! numbers of 64 bits; angles in radians, body axes forward, right and down, heading = platform heading − wander angle.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::io::Read;

use super::number::push_number;
use super::{Cells, Chunk, ColumnName, DataError, Form, Kept, TableReader, Texts, Wanted};

/// Numbers of a record, by the names of their columns.
pub const COLUMNS: [&str; 17] = [
    "time [s]",
    "latitude [rad]",
    "longitude [rad]",
    "altitude [m]",
    "x_velocity",
    "y_velocity",
    "z_velocity",
    "roll [rad]",
    "pitch [rad]",
    "platform_heading [rad]",
    "wander_angle [rad]",
    "x_acceleration",
    "y_acceleration",
    "z_acceleration",
    "x_angular_rate",
    "y_angular_rate",
    "z_angular_rate",
];

/// Bytes of a record.
pub const RECORD: usize = 8 * COLUMNS.len();

/// What is beyond this is no time of a GPS week, nor since 1980, s.
const LATEST: f64 = 1e10;
/// Texts read as numbers come to nearly nothing.
const EARLIEST: f64 = 1e-6;
/// Where vehicles go, m.
const ALTITUDES: std::ops::RangeInclusive<f64> = -12_000.0..=1_000_000.0;
/// What rounding leaves beyond a whole turn.
const ROUNDING: f64 = 1e-9;

/// The numbers of a record.
pub type Record = [f64; COLUMNS.len()];

/// Whether a beginning is that of an SBET file: its first record is one, and no text.
pub(super) fn looks(head: &[u8]) -> bool {
    let is_text = |byte: &u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    let first = head.get(..RECORD).filter(|first| !first.iter().all(is_text));
    first.is_some_and(|first| implausible(&decoded(first)).is_none())
}

/// Whether a file is called as these are.
pub(super) fn is_named(source: &str) -> bool {
    source.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("sbet"))
}

/// Whether a table is an SBET file.
#[must_use]
pub fn is_one(reader: &dyn TableReader) -> bool {
    reader.header().iter().map(|column| column.full.as_str()).eq(COLUMNS)
}

/// The bytes of a record.
#[must_use]
pub fn encoded(record: &Record) -> Vec<u8> {
    record.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// The next records of an SBET file, at most so many; none at its end.
///
/// # Errors
/// One that is none, with its number.
pub fn records(reader: &mut dyn TableReader, at_most: usize) -> Result<Vec<Record>, DataError> {
    let wanted: Vec<Wanted> =
        (0..COLUMNS.len()).map(|column| Wanted { column, form: Form::Number(1.0) }).collect();
    let chunk = reader.read(&wanted, at_most)?;
    let number = |column: &Cells, row: usize| match column {
        Cells::Numbers(numbers) => numbers[row],
        Cells::Labels(_) | Cells::Kept(_) => unreachable!("numbers were wanted"),
    };
    Ok((0..chunk.rows.len()).map(|row| std::array::from_fn(|at| number(&chunk.columns[at], row))).collect())
}

/// The numbers of the bytes of a record.
fn decoded(bytes: &[u8]) -> Record {
    let mut record = [f64::NAN; COLUMNS.len()];
    for (number, bytes) in record.iter_mut().zip(bytes.chunks_exact(8)) {
        *number = bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
    }
    record
}

/// Why these are not the numbers of a record, if they are not.
fn implausible(record: &Record) -> Option<String> {
    let refused = |at: usize, why: &str| Some(format!("its {} is {:?}, {why}", said(at), record[at]));
    if let Some(at) = record.iter().position(|number| !number.is_finite()) {
        return refused(at, "which is no number: export the trajectory again");
    }
    let none =
        "so this is no SBET file: give the file of 136 bytes a record that the navigation software exports";
    if !(0.0..LATEST).contains(&record[0]) || record[0] != 0.0 && record[0] < EARLIEST {
        return refused(0, none);
    }
    if !ALTITUDES.contains(&record[3]) {
        return refused(3, none);
    }
    let most = [(1, FRAC_PI_2), (2, TAU), (7, TAU), (8, FRAC_PI_2), (9, 2.0 * TAU), (10, TAU)];
    let (at, _) = most.into_iter().find(|&(at, most)| record[at].abs() > most + ROUNDING)?;
    let in_degrees = "and SBET has radians: export the trajectory in radians";
    refused(at, if record[at].abs() <= 720.0 { in_degrees } else { none })
}

/// `platform heading`
fn said(at: usize) -> String {
    COLUMNS[at].split(" [").next().unwrap_or_default().replace('_', " ")
}

/// Records one after the other.
pub(super) struct Reader<'r> {
    reader: Box<dyn Read + Send + 'r>,
    source: String,
    header: Vec<ColumnName>,
    /// Records that have been read.
    records: u64,
    /// The time of the last of them.
    last: Option<f64>,
}

impl<'r> Reader<'r> {
    pub fn new(reader: Box<dyn Read + Send + 'r>, source: &str) -> Self {
        let header = COLUMNS.iter().map(|name| ColumnName::parse(name)).collect();
        Self { reader, source: source.to_owned(), header, records: 0, last: None }
    }

    fn bad(&self, why: String) -> DataError {
        DataError::BadRecord { file: self.source.clone(), record: self.records + 1, why }
    }

    /// The next record; none at the end.
    fn next(&mut self) -> Result<Option<Record>, DataError> {
        let mut bytes = Vec::with_capacity(RECORD);
        let read = self.reader.by_ref().take(RECORD as u64).read_to_end(&mut bytes);
        read.map_err(|error| DataError::Unreadable { file: self.source.clone(), why: error.to_string() })?;
        if bytes.is_empty() && self.records > 0 {
            return Ok(None);
        }
        if bytes.len() < RECORD {
            let found = bytes.len();
            return Err(
                self.bad(format!("it has {found} of {RECORD} bytes: the file is cut off, so copy it again"))
            );
        }
        let record = decoded(&bytes);
        if let Some(why) = implausible(&record) {
            return Err(self.bad(why));
        }
        let time = record[0];
        if let Some(last) = self.last.filter(|last| time <= *last) {
            let help = if last - time > 500_000.0 {
                "a GPS week ends there: export the two weeks as two files"
            } else {
                "take the records from there on out, or export the trajectory again"
            };
            return Err(self.bad(format!(
                "its time {time:?} s is not later than {last:?} s of the record before: {help}"
            )));
        }
        self.last = Some(time);
        self.records += 1;
        Ok(Some(record))
    }
}

impl TableReader for Reader<'_> {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn gives_any_label(&self) -> bool {
        true
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let first = self.records;
        let mut records = Vec::new();
        while records.len() < at_most
            && let Some(record) = self.next()?
        {
            records.push(record);
        }
        let column = |want: &Wanted| {
            let numbers = records.iter().filter_map(|record| record.get(want.column).copied());
            of_numbers(numbers, want.form)
        };
        let columns = wanted.iter().map(column).collect();
        Ok(Chunk { columns, rows: (first + 1..=self.records).collect(), lines: Vec::new() })
    }
}

/// Numbers as they are wanted.
pub(crate) fn of_numbers(numbers: impl Iterator<Item = f64>, form: Form) -> Cells {
    let text = |number: f64| {
        let mut text = Vec::new();
        push_number(&mut text, number);
        String::from_utf8_lossy(&text).into_owned()
    };
    match form {
        Form::Number(factor) => Cells::Numbers(numbers.map(|number| number * factor).collect()),
        Form::Label => Cells::Labels(numbers.map(text).collect()),
        Form::Kept => {
            let texts: Vec<String> = numbers.map(text).collect();
            Cells::Kept(Kept::Texts(texts.iter().collect::<Texts>()))
        }
    }
}
