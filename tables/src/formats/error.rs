//! What can be wrong with a data file, and where: file, line, row and column by name.

use std::fmt;

pub use model_core::escape::clipped;
use thiserror::Error;

/// The place of one cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// Name of the file.
    pub file: String,
    /// Line in the file, from 1, where the format has lines.
    pub line: Option<u64>,
    /// Row, from 1, without the header.
    pub row: u64,
    /// Name of the column as in the header.
    pub column: String,
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if let Some(line) = self.line {
            write!(f, "line {line}, ")?;
        }
        write!(f, "row {}, column `{}`", self.row, clipped(&self.column))
    }
}

/// What is wrong with a data file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum DataError {
    /// Its rows do not say where something unknown is.
    #[error("{why}")]
    NotPlaced {
        /// What, and what to add.
        why: String,
    },
    /// It cannot be read.
    #[error("{file}: {why}")]
    Unreadable {
        /// Name of the file.
        file: String,
        /// What the system or the format says.
        why: String,
    },
    /// A Parquet file, and a build without the format.
    #[error(
        "{file}: this build does not read or write Parquet: build the command with `--features parquet`, or use a .csv file"
    )]
    NoParquet {
        /// Name of the file.
        file: String,
    },
    /// It begins as files of two forms do.
    #[error("{file}: this looks like {one} and like {other}: leave only the lines of one of them in it")]
    TwoForms {
        /// Name of the file.
        file: String,
        /// One form.
        one: &'static str,
        /// The other.
        other: &'static str,
    },
    /// Nothing in it.
    #[error(
        "{file}: the file is empty: write a line with the names of the columns, and the measured rows below it"
    )]
    Empty {
        /// Name of the file.
        file: String,
    },
    /// A header in which no column has a name.
    #[error("{file}: no column of the header has a name: the first line was expected to name the columns")]
    NoNames {
        /// Name of the file.
        file: String,
    },
    /// A header and nothing else.
    #[error("{file}: there are no rows below the header: write the measured rows there")]
    NoRows {
        /// Name of the file.
        file: String,
    },
    /// Columns that take their readings from rows so far away that no row has all of them.
    #[error("{file}: `shift` leaves none of {rows} rows: write a smaller number of rows")]
    ShiftedAway {
        /// Names of the files.
        file: String,
        /// The rows that there are.
        rows: usize,
    },
    /// More rows than their numbers have room for.
    #[error("{file}: these are more than {} rows, the most that one fit holds: fit a part of them", u32::MAX)]
    TooManyRows {
        /// Names of the files.
        file: String,
    },
    /// Bytes that are no text.
    #[error("{file}: line {line}: not UTF-8: save the file as UTF-8 text")]
    NotUtf8 {
        /// Name of the file.
        file: String,
        /// Line in the file, from 1.
        line: u64,
    },
    /// A file that is compressed, or of another format.
    #[error("{file}: {what}")]
    NoText {
        /// Name of the file.
        file: String,
        /// What it is, and what to do.
        what: &'static str,
    },
    /// Two columns of one name.
    #[error("{file}: column `{column}` is there twice: rename one of them")]
    DuplicateColumn {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
    },
    /// A column of a kind that cannot be read as what was wanted.
    #[error("{file}: column `{column}` {why}")]
    UnusableColumn {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
        /// What it holds, and what to give instead.
        why: String,
    },
    /// A column that is not there.
    #[error("{file}: no column `{column}`: {help}")]
    MissingColumn {
        /// Name of the file.
        file: String,
        /// Name of the column that was looked for.
        column: String,
        /// The nearest name, or all of them.
        help: String,
    },
    /// More or fewer cells than the header has.
    #[error(
        "{file}: line {line}, row {row}: {found} cells where the header has {expected}: write one cell for each column"
    )]
    RaggedRow {
        /// Name of the file.
        file: String,
        /// Line in the file, from 1.
        line: u64,
        /// Row, from 1, without the header.
        row: u64,
        /// Cells of the header.
        expected: usize,
        /// Cells of this row.
        found: usize,
    },
    /// A cell that is no number.
    #[error("{cell}: `{text}` is no number: fill in a number, or leave the row out")]
    NotANumber {
        /// Where.
        cell: Cell,
        /// What stands there.
        text: String,
    },
    /// A cell that is not what its column holds: with another decimal mark, beyond a pole.
    #[error("{cell}: {why}")]
    UnusableCell {
        /// Where.
        cell: Cell,
        /// What stands there, and what to write.
        why: String,
    },
    /// A cell without anything in it.
    #[error("{cell}: the cell is empty: fill in a number, or leave the row out")]
    EmptyCell {
        /// Where.
        cell: Cell,
    },
    /// What is to be held out is fitted as well.
    #[error(
        "{file}: {fitted} of its {rows} rows are rows of the data that are fitted, number by number: held out has to be what nobody \
         fitted; name another file under [hold_out], or leave `file` out, and the data are held out part by part"
    )]
    NotHeldOut {
        /// The file.
        file: String,
        /// Rows of it that are fitted.
        fitted: usize,
        /// Its rows.
        rows: usize,
    },
    /// A cell that says what a row observes, or from where, without anything in it.
    #[error("{cell}: the cell is empty: fill in the label, or leave the row out")]
    NoLabel {
        /// Where.
        cell: Cell,
    },
    /// A cell that says with which rows its row belongs together, without anything in it.
    #[error(
        "{cell}: the cell is empty, and rows without a label are no group of their own: fill in which group this row belongs to, or leave \
         the row out"
    )]
    NoGroup {
        /// Where.
        cell: Cell,
    },
    /// A cell that names the target of its row, without anything in it.
    #[error(
        "{cell}: the cell is empty, and the row has no target: fill in the target's name, or leave the row out"
    )]
    NoTarget {
        /// Where.
        cell: Cell,
    },
    /// A cell that says when its row was taken, without anything in it.
    #[error(
        "{cell}: the cell is empty, and nothing says where in the order its row belongs: fill it in, or leave the row out"
    )]
    NoOrder {
        /// Where.
        cell: Cell,
    },
    /// A label with something in it that no reader sees, and that a terminal would obey.
    #[error("{cell}: a control character stands in the text: take it out; was the file damaged?")]
    ControlCharacter {
        /// Where.
        cell: Cell,
    },
    /// NaN or an infinity.
    #[error("{cell}: `{text}` is not finite: fill in a number, or leave the row out")]
    NotFinite {
        /// Where.
        cell: Cell,
        /// What stands there.
        text: String,
    },
    /// An angle whose unit nothing says.
    #[error(
        "{file}: column `{column}` is an angle without a unit: write the unit in the header, `{column} [deg]`, \
         or in the study, {{ column = \"{column}\", unit = \"deg\" }}"
    )]
    NoUnit {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
    },
    /// The header says a unit that is none.
    #[error("{file}: the header of column `{column}`: {why}")]
    UnknownUnit {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
        /// What was said, and which units there are.
        why: String,
    },
    /// A declared name that itself ends like a unit, and a column that says no more.
    #[error(
        "{file}: column `{column}`: is `{unit}` its unit, or part of the name? Write the unit in the header: \
         `{column} [{unit}]` or `{column} [{si}]`"
    )]
    NameOrUnit {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
        /// What the name ends in.
        unit: &'static str,
        /// The SI unit.
        si: &'static str,
    },
    /// Two columns that could be meant by one name.
    #[error("{file}: both `{one}` and `{other}` are columns for `{name}`: take one away, or rename it")]
    TwoColumns {
        /// Name of the file.
        file: String,
        /// The name that was looked for.
        name: String,
        /// The column further to the left.
        one: String,
        /// The other.
        other: String,
    },
    /// The rows take more memory than they may.
    #[error(
        "{file}: its rows take more than {} MiB of memory: leave out rows, or allow more with memory = \"8 GiB\" in \
         a study",
        budget_bytes >> 20
    )]
    TooLarge {
        /// Name of the file.
        file: String,
        /// How much they may take.
        budget_bytes: u64,
    },
    /// The header says one unit, the study another.
    #[error(
        "{file}: the header of column `{column}` says {header}, the study says {study}: correct one of them"
    )]
    UnitConflict {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
        /// Unit in the header.
        header: &'static str,
        /// Unit in the study.
        study: &'static str,
    },
    /// A unit of something else.
    #[error("{file}: column `{column}`: {why}")]
    WrongUnit {
        /// Name of the file.
        file: String,
        /// Name of the column.
        column: String,
        /// What the unit measures, and what is wanted.
        why: String,
    },
    /// A row whose numbers cannot be what they are said to be.
    #[error("{file}: {}row {row}: {why}", line.map_or(String::new(), |line| format!("line {line}, ")))]
    Impossible {
        /// Name of the file.
        file: String,
        /// Line in the file, from 1, where the format has lines.
        line: Option<u64>,
        /// Row, from 1, without the header.
        row: u64,
        /// Why it cannot be, and what was expected.
        why: String,
    },
    /// A record that the format does not allow.
    #[error("{file}: record {record}: {why}")]
    BadRecord {
        /// Name of the file.
        file: String,
        /// Number of the record, from 1.
        record: u64,
        /// What is wrong and what to do.
        why: String,
    },
    /// A line that the format does not allow.
    #[error("{file}: line {line}: {why}")]
    BadLine {
        /// Name of the file.
        file: String,
        /// Line in the file, from 1.
        line: u64,
        /// What is wrong and what was expected.
        why: String,
    },
}
