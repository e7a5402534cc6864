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
    let (poses, rows) = (&reported.observations.poses, reported.observations.rows());
    let mut components: Vec<Component> = Vec::new();
    for series in &poses.series {
        for &name in series.measure.component_names() {
            if components.iter().all(|component| component.name != name) {
                let absent = vec![None; rows];
                let unit = series.measure.unit();
                components.push(Component { name, unit, before: absent.clone(), after: absent });
            }
        }
    }
    let mut fill = |fit: &FitResult, of: fn(&mut Component) -> &mut Vec<Option<f64>>| {
        let mut residuals = fit.residuals.row.iter().zip(&fit.residuals.raw).peekable();
        for series in &poses.series {
            let names = series.measure.component_names();
            let places: Vec<Option<usize>> =
                names.iter().map(|&name| components.iter().position(|known| known.name == name)).collect();
            for row in series.rows.clone() {
                let mut places = places.iter().flatten();
                while let Some((_, &residual)) = residuals.next_if(|&(&of, _)| of as usize == row) {
                    let Some(&place) = places.next() else { break };
                    of(&mut components[place])[row] = Some(residual);
                }
            }
        }
    };
    fill(&reported.calibration.before, |component| &mut component.before);
    fill(&reported.calibration.after, |component| &mut component.after);
    components
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
