//! Residuals row by row: before and after, beside the readings.

use std::borrow::Cow;

use calibration::data::SiUnit;
use calibration::fit::FitResult;
use calibration::formats::ColumnName;
use model_core::SymbolId;

use super::Reported;

/// The residual of one component of the observations, before and after, in rad or m; rows without it are absent.
pub struct Component {
    /// `across`, `along`, `x`, …
    pub name: &'static str,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// Of the declaration as it was, one a row.
    pub before: Vec<Option<f64>>,
    /// Of the amended one, one a row.
    pub after: Vec<Option<f64>>,
}

/// Every component that the observations have, in order of first appearance.
#[must_use]
pub fn components(reported: &Reported<'_>) -> Vec<Component> {
    let rows = reported.observations.rows();
    let before = by_row(&reported.calibration.before, rows);
    let after = by_row(&reported.calibration.after, rows);
    let mut components: Vec<Component> = Vec::new();
    for (row, measure) in reported.observations.poses.measures().enumerate() {
        for (index, &name) in measure.component_names().iter().enumerate() {
            let at = components.iter().position(|component| component.name == name).unwrap_or_else(|| {
                let absent = vec![None; rows];
                components.push(Component {
                    name,
                    unit: measure.unit(),
                    before: absent.clone(),
                    after: absent,
                });
                components.len() - 1
            });
            components[at].before[row] = before[row].get(index).copied();
            components[at].after[row] = after[row].get(index).copied();
        }
    }
    components
}

/// The raw residual components of each row.
fn by_row(fit: &FitResult, rows: usize) -> Vec<Vec<f64>> {
    let mut by_row = vec![Vec::new(); rows];
    for (&row, &residual) in fit.residuals.row.iter().zip(&fit.residuals.raw) {
        if let Some(components) = by_row.get_mut(row as usize) {
            components.push(residual);
        }
    }
    by_row
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
    /// Numbers of rows or lines, from 1.
    Rows(Vec<u64>),
    /// Texts: files, names of rows.
    Texts(Vec<String>),
    /// A number in every row.
    Numbers(Cow<'a, [f64]>),
    /// Residuals; absent where the row has no such component.
    Residuals(Vec<Option<f64>>),
}

/// One row an observation: its number; its file, line and name, as far as there are such; the readings, the residual components before and after, in SI, and its weight; each
/// column by its name.
#[must_use]
pub fn table<'a>(reported: &'a Reported<'_>) -> Vec<(String, Cells<'a>)> {
    let mut columns: Vec<(String, Cells<'a>)> = readings(reported)
        .map(|(name, unit, values)| {
            let name = match unit {
                SiUnit::ONE => name.to_owned(),
                unit => format!("{name} [{unit}]"),
            };
            (name, Cells::Numbers(values.into()))
        })
        .collect();
    for component in components(reported) {
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
    let [row, file, line, id, weight] = ["row", "file", "line", "id", "weight"].map(own);
    let observations = reported.observations;
    let weights = &reported.calibration.after.residuals.weight;
    let rows = observations.rows();
    let origins = &observations.origins;
    let lines: Option<Vec<u64>> = (0..rows).map(|row| origins.of(row).line).collect();
    let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
    let places = [
        Some((row, Cells::Rows((0..rows).map(|row| observations.row_number(row)).collect()))),
        origins
            .has_files()
            .then(|| (file, Cells::Texts((0..rows).map(|row| text(origins.of(row).file)).collect()))),
        lines.filter(|_| rows > 0).map(|lines| (line, Cells::Rows(lines))),
        origins
            .has_names()
            .then(|| (id, Cells::Texts((0..rows).map(|row| text(origins.of(row).name)).collect()))),
    ];
    columns.splice(0..0, places.into_iter().flatten());
    let weights = (0..rows).map(|row| weights.get(row).copied().unwrap_or(1.0)).collect();
    columns.push((weight, Cells::Numbers(Cow::Owned(weights))));
    columns
}
