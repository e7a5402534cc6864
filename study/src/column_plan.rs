//! A column that a study takes from its files.

use std::ops::Range;

use model_core::unit::{Measures, Unit};

use super::conversion::Conversion;
use super::mistakes::{Outcome, mistake, plain};
use super::written::Column;
use tables::formats::{ColumnName, DataError, ReadAs, find_column, find_reading};

/// A column that is to be found in a file.
#[derive(Debug, Clone)]
pub(super) struct ColumnPlan {
    pub name: String,
    pub unit: Option<Unit>,
    pub measures: Measures,
    /// A column with a declared name needs no unit: it is in SI.
    pub declared: bool,
    /// The study names it.
    pub named: bool,
    /// How its numbers become readings.
    pub conversion: Conversion,
}

impl ColumnPlan {
    /// A column of a declared name, which a study need not name: its numbers are in SI.
    pub fn declared(name: String, measures: Measures) -> Self {
        Self { name, unit: None, measures, declared: true, named: false, conversion: Conversion::NONE }
    }

    /// A column that a study names, of numbers without a unit.
    pub fn of_numbers(name: &str) -> Self {
        Self { named: true, ..Self::declared(name.to_owned(), Measures::Number) }
    }

    /// A column that a study names, of times.
    pub fn of_times(name: &str) -> Self {
        Self { measures: Measures::Time, declared: false, ..Self::of_numbers(name) }
    }
}

/// Where a column stands in a file, and how its numbers are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnAt {
    /// Its index in the header.
    pub at: usize,
    /// What takes its numbers to SI; 1 where they are packed.
    pub factor: f64,
    /// Whether nothing says their unit.
    pub is_bare: bool,
    /// How they become readings then.
    pub conversion: Conversion,
}

impl ColumnPlan {
    /// Finds it among the columns of a file; `declared` are the names of the chain.
    pub fn find(&self, header: &[ColumnName], declared: &[&str], file: &str) -> Result<ColumnAt, DataError> {
        let Self { name, unit, measures, conversion, .. } = self;
        let at = if self.named {
            find_column(header, name, file)?
        } else {
            find_reading(header, name, declared, file)?
        };
        let own = self.declared.then_some(name.as_str());
        let read = ReadAs { measures: *measures, stated: *unit, declared: own };
        let (factor, is_bare) = match conversion.notation {
            // Its digits are degrees or hours whatever the header says.
            Some(_) => (1.0, false),
            None => (header[at].factor(read, file)?, header[at].is_bare(read)),
        };
        Ok(ColumnAt { at, factor, is_bare, conversion: *conversion })
    }
}

/// The column that a study names, with its unit; only inputs have a meaning.
pub(super) fn column_plan(
    column: &Column,
    measures: Measures,
    place: &Range<usize>,
    of_input: bool,
) -> Outcome<ColumnPlan> {
    let unit = column.unit.as_deref().map(|unit| Unit::read(unit, Some(measures))).transpose();
    let unit = unit.map_err(|error| plain(place.clone(), error.to_string()))?;
    if let Some(other) = unit.filter(|unit| measures == Measures::Number && unit.measures().needs_meaning()) {
        let message = format!(
            "`{}` measures {}, and nothing says that the column does",
            other.name(),
            other.measures().noun()
        );
        return Err(mistake(
            place.clone(),
            message,
            "write its `meaning` beside the unit, or leave the unit out",
        ));
    }
    if let (Some(meaning), false) = (&column.meaning, of_input) {
        return Err(mistake(
            meaning.span(),
            "what is measured has no meaning of its own",
            "leave `meaning` out",
        ));
    }
    if let (Some(sigma), false) = (&column.sigma, of_input) {
        return Err(mistake(
            sigma.span(),
            "only a joint or an input states here how uncertain it is",
            "state the noise of what is measured under `[noise]`, as `sigma`",
        ));
    }
    if let (Some((other, _)), false) = (column.correlation.first_key_value(), of_input) {
        return Err(mistake(
            other.span(),
            "only readings of joints and inputs have correlations",
            "leave `correlation` out",
        ));
    }
    let conversion = Conversion::of(column, measures)?;
    match &column.column {
        Some(name) => {
            Ok(ColumnPlan { name: name.clone(), unit, measures, declared: false, named: true, conversion })
        }
        None => Err(mistake(place.clone(), "this column is measured, not derived", "write `column = \"…\"`")),
    }
}
