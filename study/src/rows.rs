//! The rows of one source on their way from its files.

use model_core::unit::Measures;

use super::columns::Columns;
use super::conversion::Conversion;
use super::labels::says_nothing;
use super::order::order_of;
use super::plan::{Plan, SourcePlan};
use super::undeclared::Labelled;
use observe::{Numbers, Places};
use tables::formats::{Cell, Cells, DataError, Form, ReadAs, TableReader, Wanted, find_column};
use tables::units::BareColumn;

/// Rows that are read at a time.
const CHUNK: usize = 1 << 16;

/// Memory that a number takes while a file is read: it is held as read, and among what was observed with a mark of what it is.
const BYTES_A_NUMBER: usize = 3 * size_of::<f64>();

/// The columns of one source as numbers and labels, in the order of [`Columns`].
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub numbers: Vec<Vec<f64>>,
    pub labels: Vec<Vec<String>>,
    /// The files that they come from.
    pub file: String,
    pub row_numbers: Numbers,
    pub places: Places,
    /// Of each column of numbers whether all files so far give it in SI.
    pub in_si: Vec<bool>,
    /// Of each column of numbers what they were multiplied by to be in SI; `None` where files differ.
    pub factors: Vec<Option<f64>>,
    /// Of each column of numbers whether the header of some file says its unit.
    pub headed: Vec<bool>,
    /// What takes the numbers of the column of the order to seconds, by the headers; or why nothing does.
    pub seconds: Result<f64, DataError>,
    /// Of each column of numbers its heading in the first file.
    pub headings: Vec<String>,
    /// Columns that the study does not name.
    pub undeclared: Labelled,
    /// Memory that these take, in bytes.
    bytes: usize,
}

impl Rows {
    /// None yet, of these columns of files.
    pub fn of(columns: &Columns, paths: &[String]) -> Self {
        Self {
            numbers: vec![Vec::new(); columns.plans.len()],
            labels: vec![Vec::new(); columns.labels.len()],
            file: paths.join(", "),
            row_numbers: Numbers::default(),
            places: Places::default(),
            in_si: vec![true; columns.plans.len()],
            factors: vec![None; columns.plans.len()],
            headed: vec![false; columns.plans.len()],
            seconds: Ok(1.0),
            headings: Vec::new(),
            undeclared: Labelled::default(),
            bytes: 0,
        }
    }

    /// Appends all rows of one file, and the columns of it that are doubtful.
    pub fn append(
        &mut self,
        (plan, source): (&Plan, &SourcePlan),
        reader: &mut dyn TableReader,
        file: u32,
        columns: &Columns,
        doubtful: &mut Vec<BareColumn>,
    ) -> Result<(), DataError> {
        let (wanted, mut bare) = columns.wanted(plan, source, reader)?;
        let is_first = self.row_numbers.is_empty();
        let own = self.in_si.iter_mut().zip(&mut self.factors);
        for ((in_si, factor), (column, plan)) in own.zip(wanted.iter().zip(&columns.plans)) {
            *in_si &= matches!(column.form, Form::Number(1.0)) && plan.conversion == Conversion::NONE;
            let this = if let Form::Number(factor) = column.form { Some(factor) } else { None };
            *factor = this.filter(|_| is_first || *factor == this);
        }
        for (headed, column) in self.headed.iter_mut().zip(&wanted) {
            *headed |= reader.header()[column.column].unit().is_some();
        }
        if let (Some(order), Ok(_)) = (&plan.order, &self.seconds) {
            let read = ReadAs { measures: Measures::Time, stated: None, declared: None };
            let found = find_column(reader.header(), order, reader.source())?;
            self.seconds = reader.header()[found].factor(read, reader.source());
        }
        if self.headings.is_empty() {
            let numbers = wanted.iter().take(columns.plans.len());
            self.headings = numbers.map(|column| reader.header()[column.column].full.clone()).collect();
        }
        let before = self.row_numbers.last().unwrap_or_default();
        let mut beside = Labelled::beside(&wanted, reader);
        loop {
            let asked: Vec<Wanted> =
                wanted.iter().copied().chain(beside.iter().map(|(_, want)| *want)).collect();
            let mut chunk = reader.read(&asked, CHUNK)?;
            if chunk.rows.is_empty() {
                break;
            }
            let labelled = chunk.columns.split_off(wanted.len());
            if chunk.rows.len() == CHUNK {
                beside.clear();
                self.undeclared.forget();
            }
            self.undeclared.take(&beside, chunk.rows.iter().map(|row| before + row), labelled);
            self.row_numbers.extend(chunk.rows.iter().map(|row| before + row));
            let lines = chunk.lines.iter().copied().chain(std::iter::repeat(0));
            self.places.extend(file, lines.take(chunk.rows.len()));
            let mut numbers = self.numbers.iter_mut().enumerate();
            let mut labels = self.labels.iter_mut().zip(&columns.labels);
            for cells in chunk.columns {
                match cells {
                    Cells::Numbers(values) => {
                        let Some((at, column)) = numbers.next() else { continue };
                        if let Some((_, bare)) = bare.iter_mut().find(|(column, _)| *column == at) {
                            bare.see(&values);
                        }
                        self.bytes += values.len() * BYTES_A_NUMBER;
                        let conversion = columns.plans[at].conversion;
                        if conversion == Conversion::NONE {
                            column.extend(&values);
                        } else {
                            column.extend(values.iter().map(|number| conversion.value(*number)));
                        }
                    }
                    Cells::Labels(values) => {
                        let Some((column, name)) = labels.next() else { continue };
                        let says_what = source.object.contains(name) || source.station.contains(name);
                        let says_with_whom =
                            plan.group.contains(name) || plan.hold_out.together.contains(name);
                        for (at, label) in values.iter().map(|label| label.trim().to_owned()).enumerate() {
                            let cell = || {
                                let (file, column) = (reader.source().to_owned(), name.clone());
                                let (line, row) = (chunk.lines.get(at).copied(), chunk.rows[at]);
                                Cell { file, line, row, column }
                            };
                            if says_what && says_nothing(&label) {
                                return Err(DataError::NoLabel { cell: cell() });
                            }
                            if plan.target.contains(name) && says_nothing(&label) {
                                return Err(DataError::NoTarget { cell: cell() });
                            }
                            if says_with_whom && says_nothing(&label) {
                                return Err(DataError::NoGroup { cell: cell() });
                            }
                            if plan.order.as_ref() == Some(name) && says_nothing(&label) {
                                return Err(DataError::NoOrder { cell: cell() });
                            }
                            if label.contains(|letter: char| letter.is_control() && letter != '\t') {
                                return Err(DataError::ControlCharacter { cell: cell() });
                            }
                            self.bytes += label.len() + size_of::<String>();
                            column.push(label);
                        }
                    }
                    Cells::Kept(_) => unreachable!("a study wants numbers and labels"),
                }
            }
            plan.format.holds(self.bytes, reader.source())?;
        }
        doubtful.extend(bare.into_iter().map(|(_, bare)| bare).filter(BareColumn::is_doubtful));
        Ok(())
    }

    /// Brings the rows into the [order](order_of) of a label.
    pub fn sort_by_label(&mut self, label: usize) {
        let Some(labels) = self.labels.get(label) else { return };
        let order = order_of(labels);
        for column in &mut self.numbers {
            *column = order.iter().map(|&row| column[row]).collect();
        }
        for column in &mut self.labels {
            *column = order.iter().map(|&row| column[row].clone()).collect();
        }
        self.row_numbers = self.row_numbers.select(&order);
        self.places = self.places.select(&order);
    }

    /// Lets columns that a study shifts take their readings from other rows; rows that have none then are left out.
    pub fn shift(&mut self, columns: &Columns) {
        let rows = self.row_numbers.len() as i64;
        let shifts = || columns.plans.iter().map(|plan| plan.conversion.shift);
        let (forward, back) = (shifts().max().unwrap_or(0).max(0), shifts().min().unwrap_or(0).min(0));
        if (forward, back) == (0, 0) {
            return;
        }
        for (column, shift) in self.numbers.iter_mut().zip(shifts()) {
            *column = (forward..rows + back).map(|row| column[(row - shift) as usize]).collect();
        }
        let kept: Vec<usize> = (forward..rows + back).map(|row| row as usize).collect();
        for column in &mut self.labels {
            *column = kept.iter().map(|&row| column[row].clone()).collect();
        }
        self.row_numbers = self.row_numbers.select(&kept);
        self.places = self.places.select(&kept);
    }

    /// These rows, in the order given.
    pub fn select(&self, rows: &[usize]) -> Self {
        let numbers = |column: &Vec<f64>| rows.iter().map(|&row| column[row]).collect();
        let labels = |column: &Vec<String>| rows.iter().map(|&row| column[row].clone()).collect();
        Self {
            numbers: self.numbers.iter().map(numbers).collect(),
            labels: self.labels.iter().map(labels).collect(),
            file: self.file.clone(),
            row_numbers: self.row_numbers.select(rows),
            places: self.places.select(rows),
            in_si: self.in_si.clone(),
            factors: self.factors.clone(),
            headed: self.headed.clone(),
            seconds: self.seconds.clone(),
            headings: self.headings.clone(),
            undeclared: Labelled::default(),
            bytes: 0,
        }
    }

    /// The number of a row in its file.
    pub fn number(&self, row: usize) -> u64 {
        self.row_numbers.get(row).unwrap_or_default()
    }
}
