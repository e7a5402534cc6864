//! Readings by the headings of a study: which columns they need, and what follows from these.

use model_core::{ObservableId, SymbolId};
use observe::Derived;
use study::{ColumnAt, Conversion, Headings, Need, Sequence};
use tables::formats::{ColumnName, DataError, find_column};

use crate::evaluation::readings_of;

/// The headings of a study, of which one source is like the table that is read.
#[derive(Clone)]
pub(super) struct Headed {
    pub headings: Headings,
    pub source: usize,
}

/// Columns of some rows beside the readings that have a column of their own.
#[derive(Default)]
pub(super) struct Beside {
    /// Plain numbers by the name of their column.
    pub numbers: Vec<(String, Vec<f64>)>,
    /// What says the order of the rows.
    pub order: Option<Vec<String>>,
}

impl Headed {
    /// The first source of which a table has all that its observable needs, of those of `named` observables; else the first of them.
    pub fn of(headings: Headings, named: &[ObservableId], header: &[ColumnName], declared: &[&str]) -> Self {
        let is_meant = |source: &usize| {
            let observable = headings.sources[*source].observable;
            named.is_empty() || named.contains(&observable)
        };
        let has_all = |source: &usize| {
            let readings = readings_of(&headings.chain, headings.sources[*source].observable);
            let needs = readings.iter().flat_map(|id| headings.needs(*source, *id));
            needs.into_iter().all(|need| {
                found(&headings, *source, &need, (header, ""), declared).is_some_and(|found| found.is_ok())
            })
        };
        let meant = || (0..headings.sources.len()).filter(is_meant);
        let source = meant().find(has_all).or_else(|| meant().next()).unwrap_or(0);
        Self { headings, source }
    }

    /// What a joint or input needs.
    pub fn needs(&self, symbol: SymbolId) -> Vec<Need> {
        self.headings.needs(self.source, symbol)
    }

    /// How a joint or input follows from other columns, if it does.
    pub fn derived(&self, symbol: SymbolId) -> Option<&Derived> {
        self.headings.derived(self.source, symbol)
    }

    /// Finds a column, where the study says which.
    pub fn find(
        &self,
        need: &Need,
        header: (&[ColumnName], &str),
        declared: &[&str],
    ) -> Option<Result<ColumnAt, DataError>> {
        found(&self.headings, self.source, need, header, declared)
    }

    /// Finds the columns of what is observed.
    pub fn find_observed(
        &self,
        header: (&[ColumnName], &str),
        declared: &[&str],
    ) -> Result<Vec<ColumnAt>, DataError> {
        self.headings.find_observed(self.source, header, declared)
    }

    /// The values of joints and inputs that follow from other columns.
    ///
    /// # Errors
    /// The column of the order says no time that one of them follows.
    pub fn follow(
        &self,
        symbols: &[SymbolId],
        readings: &[(SymbolId, Vec<f64>)],
        beside: &Beside,
        file: &str,
    ) -> Result<Vec<(SymbolId, Vec<f64>)>, DataError> {
        let chain = &self.headings.chain;
        let sequence = beside.order.as_deref().map(Sequence::of);
        let name = self.headings.order.as_deref();
        let follows = |id: &SymbolId| {
            self.derived(*id).is_some_and(|own| own.columns().iter().any(|own| Some(*own) == name))
        };
        if let Some(Sequence { times: Err(row), .. }) = &sequence
            && symbols.iter().any(follows)
        {
            let why = format!("column `{}`: this says no time", name.unwrap_or_default());
            let (file, row) = (file.to_owned(), *row as u64 + 1);
            return Err(DataError::Impossible { file, line: None, row, why });
        }
        let values = |id: &SymbolId| {
            let derived = self.derived(*id)?;
            let of = |name: &str| -> Option<Vec<f64>> {
                let symbol = chain.find_symbol(name);
                let own = readings.iter().find(|(id, _)| Some(*id) == symbol).map(|(_, values)| values);
                let plain = || beside.numbers.iter().find(|(own, _)| own == name).map(|(_, values)| values);
                let times = || sequence.as_ref().and_then(|own| own.times.as_ref().ok());
                let values = own.or_else(plain).or_else(times)?;
                Some(match &sequence {
                    Some(sequence) => sequence.order.iter().map(|row| values[*row]).collect(),
                    None => values.clone(),
                })
            };
            let in_order = derived.values(of)?;
            let Some(sequence) = &sequence else { return Some((*id, in_order)) };
            let mut values = vec![0.0; in_order.len()];
            for (row, value) in sequence.order.iter().zip(in_order) {
                values[*row] = value;
            }
            Some((*id, values))
        };
        Ok(symbols.iter().filter_map(values).collect())
    }
}

/// The column of a need; none where the study does not say it.
fn found(
    headings: &Headings,
    source: usize,
    need: &Need,
    (header, file): (&[ColumnName], &str),
    declared: &[&str],
) -> Option<Result<ColumnAt, DataError>> {
    let plain = |at| ColumnAt { at, factor: 1.0, is_bare: false, conversion: Conversion::NONE };
    match need {
        Need::Reading(symbol) => headings.find(source, *symbol, (header, file), declared),
        Need::Numbers(name) | Need::Order(name) => Some(find_column(header, name, file).map(plain)),
    }
}

/// Readings, each taken from the row that stands so many before it; no number where there is no such row.
pub(super) fn shifted(numbers: &[f64], shift: i64) -> Vec<f64> {
    let from =
        |row: usize| i64::try_from(row).ok()?.checked_sub(shift).and_then(|row| usize::try_from(row).ok());
    (0..numbers.len())
        .map(|row| from(row).and_then(|row| numbers.get(row)).copied().unwrap_or(f64::NAN))
        .collect()
}
