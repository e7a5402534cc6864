//! Residuals row by row: before and after, beside the readings.

use calibration::data::SiUnit;
use calibration::fit::FitResult;
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
    for (row, measure) in reported.observations.measures().enumerate() {
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
    reported.observations.columns.iter().map(move |(id, values): &(SymbolId, Vec<f64>)| {
        let symbol = chain.symbol(*id);
        (symbol.name.as_str(), symbol.quantity.into(), values.as_slice())
    })
}
