//! Where an instrument stood and what it looked at, whether or not anything was measured there.

use std::ops::Range;

use model_core::{ObservableId, SymbolId};

use super::{Measure, SiUnit};

/// Consecutive rows that observe one thing in one way: one file of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Series {
    /// What was observed.
    pub observable: ObservableId,
    /// What its numbers are.
    pub measure: Measure,
    /// Which rows.
    pub rows: Range<usize>,
    /// Name of the file or stream, for messages.
    pub source: String,
}

/// Readings of joints and inputs, row by row, and what is observed in which rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Poses {
    /// Blocks of rows, consecutive and covering every row; empty where the readings alone count.
    pub series: Vec<Series>,
    /// Readings of joints and inputs in SI, one value a row, sorted by symbol.
    pub columns: Vec<(SymbolId, Vec<f64>)>,
}

impl Poses {
    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        let of_columns = || self.columns.first().map_or(0, |(_, values)| values.len());
        self.series.last().map_or_else(of_columns, |series| series.rows.end)
    }

    /// The readings of a joint or input, one value a row.
    #[must_use]
    pub fn column(&self, symbol: SymbolId) -> Option<&[f64]> {
        let at = self.columns.binary_search_by_key(&symbol, |(id, _)| *id).ok()?;
        self.columns.get(at).map(|(_, values)| values.as_slice())
    }

    /// The number of residual components of all rows together.
    #[must_use]
    pub fn components(&self) -> usize {
        self.series.iter().map(|series| series.rows.len() * series.measure.components()).sum()
    }

    /// The measure of each row.
    pub fn measures(&self) -> impl Iterator<Item = Measure> + '_ {
        self.series.iter().flat_map(|series| std::iter::repeat_n(series.measure, series.rows.len()))
    }

    /// The unit of the residual of each row.
    #[must_use]
    pub fn unit_of_row(&self) -> Vec<SiUnit> {
        self.measures().map(Measure::unit).collect()
    }

    /// The units of residuals, each once, in the order of the series.
    #[must_use]
    pub fn units(&self) -> Vec<SiUnit> {
        let mut units: Vec<SiUnit> = Vec::new();
        for unit in self.series.iter().map(|series| series.measure.unit()) {
            if !units.contains(&unit) {
                units.push(unit);
            }
        }
        units
    }

    /// The same poses with nothing that stands anywhere: the points and directions themselves.
    #[must_use]
    pub fn bare(&self) -> Self {
        let series = self.series.iter().map(|own| Series { measure: own.measure.bare(), ..own.clone() });
        Self { series: series.collect(), columns: self.columns.clone() }
    }

    /// These rows, in the order given. Every series is kept, though it may hold no rows.
    ///
    /// Rows must come series by series, in the order of the series; indices out of range are left out.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let pick = |values: &[f64]| rows.iter().filter_map(|&row| values.get(row).copied()).collect();
        let mut start = 0;
        let series = self.series.iter().map(|from| {
            let own = rows[start..].iter().take_while(|&&row| from.rows.contains(&row)).count();
            start += own;
            Series { rows: start - own..start, ..from.clone() }
        });
        let series = series.collect();
        Self { series, columns: self.columns.iter().map(|(id, values)| (*id, pick(values))).collect() }
    }
}
