//! Residuals row by row: before and after, beside the readings.

use std::borrow::Cow;

use calibration::calibrate::Calibration;
use calibration::diagnose::Shown;
use fit::FitResult;
use fit::noise::Layout;
use model_core::SymbolId;
use observe::SiUnit;
use rayon::prelude::*;
use tables::formats::ColumnName;

use crate::Reported;

/// Rows that `residuals.csv` has at most, unless all are asked for.
const ROWS: usize = 100_000;

/// The residual of one component of the observations, before and after, in rad or m; rows without it are absent.
pub struct Component {
    /// `across`, `along`, `x`, …
    pub name: &'static str,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// Of the declaration as it was, one a row that was asked for.
    pub before: Vec<Option<f64>>,
    /// Of the amended one, likewise.
    pub after: Vec<Option<f64>>,
}

/// Every component that the observations have, in order of first appearance, at some rows in order.
#[must_use]
pub fn components(reported: &Reported<'_>, rows: &[usize]) -> Vec<Component> {
    let series = &reported.observations.poses.series;
    let mut named: Vec<(&'static str, SiUnit)> = Vec::new();
    for own in series {
        for &name in own.measure.component_names() {
            if named.iter().all(|(other, _)| *other != name) {
                named.push((name, own.measure.unit()));
            }
        }
    }
    let layout = Layout::of(reported.observations);
    let of = |fit: &FitResult, name: &str| -> Vec<Option<f64>> {
        let residual = |&row: &usize| {
            let own = series.iter().find(|own| own.rows.contains(&row))?;
            let number = own.measure.component_names().iter().position(|other| *other == name)?;
            Some(fit.residuals.raw[layout.first(row) + number])
        };
        rows.par_iter().map(residual).collect()
    };
    let Calibration { before, after, .. } = reported.calibration;
    named
        .into_iter()
        .map(|(name, unit)| Component { name, unit, before: of(before, name), after: of(after, name) })
        .collect()
}

/// The joints and inputs that were read, with their names and units.
pub fn readings<'a>(reported: &'a Reported<'_>) -> impl Iterator<Item = (&'a str, SiUnit, &'a [f64])> {
    let chain = &reported.calibration.chain;
    reported.observations.poses.columns.iter().map(move |(id, values): &(SymbolId, Vec<f64>)| {
        let symbol = chain.symbol(*id);
        (symbol.name.as_str(), symbol.quantity.into(), values.as_slice())
    })
}

/// The cells of one column of the table of residuals.
pub enum Cells<'a> {
    /// Whole numbers: of rows or lines, from 1, or of how many there are.
    Rows(Vec<u64>),
    /// Texts: files, names of rows.
    Texts(Vec<String>),
    /// A number in every row.
    Numbers(Cow<'a, [f64]>),
    /// Residuals; absent where the row has no such component.
    Residuals(Vec<Option<f64>>),
}

/// Which rows `residuals.csv` has.
#[must_use]
pub fn rows_written(reported: &Reported<'_>, all: bool) -> Shown {
    let most = if all { usize::MAX } else { ROWS };
    Shown::of(reported.observations, &reported.calibration.after, most)
}

/// One row an observation that is shown: its number; its file, line, name, station and object, as far as there are such; the readings, the residual components
/// before and after, in SI, and its weight; of a part of the rows, for how many each stands. Each column by its name.
#[must_use]
pub fn table<'a>(reported: &'a Reported<'_>, shown: &Shown) -> Vec<(String, Cells<'a>)> {
    let is_part = shown.is_part_of(reported.observations.rows());
    let mut columns: Vec<(String, Cells<'a>)> = readings(reported)
        .map(|(name, unit, values)| {
            let name = match unit {
                SiUnit::ONE => name.to_owned(),
                unit => format!("{name} [{unit}]"),
            };
            let own = || shown.rows.iter().map(|&row| values[row]).collect();
            (name, Cells::Numbers(if is_part { Cow::Owned(own()) } else { values.into() }))
        })
        .collect();
    for component in components(reported, &shown.rows) {
        let name = |when| format!("{}_{when} [{}]", component.name, component.unit);
        let names = [name("before"), name("after")];
        columns.extend(names.into_iter().zip([component.before, component.after].map(Cells::Residuals)));
    }
    // A joint or input may have the name of one of these columns.
    let own = |name: &str| {
        let mut name = name.to_owned();
        while columns.iter().any(|(other, _)| ColumnName::parse(other).means(&name, &[])) {
            name.push('_');
        }
        name
    };
    let [row, file, line, id, station, object, weight, stands_for] =
        ["row", "file", "line", "id", "station", "object", "weight", "stands_for"].map(own);
    let observations = reported.observations;
    let weights = &reported.calibration.after.residuals.weight;
    let rows = || shown.rows.iter().copied();
    let origins = &observations.origins;
    let lines: Option<Vec<u64>> = rows().map(|row| origins.of(row).line).collect();
    let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
    let places = [
        Some((row, Cells::Rows(rows().map(|row| observations.row_number(row)).collect()))),
        origins
            .has_files()
            .then(|| (file, Cells::Texts(rows().map(|row| text(origins.of(row).file)).collect()))),
        lines.filter(|lines| !lines.is_empty()).map(|lines| (line, Cells::Rows(lines))),
        origins
            .has_names()
            .then(|| (id, Cells::Texts(rows().map(|row| text(origins.of(row).name)).collect()))),
    ];
    let labels = |which: usize| {
        let unknowns = observations.unknowns.as_ref()?;
        let texts: Vec<String> = rows().map(|row| text(unknowns.labels(row)[which])).collect();
        texts.iter().any(|label| !label.is_empty()).then_some(Cells::Texts(texts))
    };
    let seen = [(station, labels(0)), (object, labels(1))];
    let seen = seen.into_iter().filter_map(|(name, labels)| Some((name, labels?)));
    let places: Vec<_> = places.into_iter().flatten().chain(seen).collect();
    columns.splice(0..0, places);
    let weights = rows().map(|row| weights.get(row).copied().unwrap_or(1.0)).collect();
    columns.push((weight, Cells::Numbers(Cow::Owned(weights))));
    if is_part {
        columns.push((stands_for, Cells::Numbers(Cow::Owned(shown.stands_for.clone()))));
    }
    columns
}
