//! The files of a calibration, each written whole.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use model_core::SymbolKind;

use super::{Reported, html, quantities, residuals};
use crate::failure::Failure;
use crate::{output, tables};

/// Writes `report.html`, `report.json`, `amended.chain`, `errors.toml` and `residuals.csv` into a folder, which is
/// made if it is not there.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_all(reported: &Reported<'_>, folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::write(folder, &error))?;
    output::write_text(&folder.join("report.json"), &json(reported)?)?;
    output::write_text(&folder.join("amended.chain"), &reported.calibration.amended)?;
    output::write_text(&folder.join("errors.toml"), &errors(reported))?;
    write_residuals(reported, &folder.join("residuals.csv"))?;
    output::write_text(&folder.join("report.html"), &html::page(reported))
}

/// The report for programs.
///
/// # Errors
/// A number in it is none.
pub fn json(reported: &Reported<'_>) -> Result<String, Failure> {
    serde_json::to_string_pretty(&reported.calibration.report)
        .map(|text| text + "\n")
        .map_err(|error| Failure::Input(format!("the report cannot be written as JSON: {error}")))
}

/// Estimates as an errors file, each with a remark for people.
fn errors(reported: &Reported<'_>) -> String {
    let calibration = reported.calibration;
    let mut text = format!(
        "# Errors of {}, calibrated on {}; for `trueaxis eval`, `trueaxis apply` and amended.chain.\n",
        calibration.chain.name, reported.date
    );
    let found = &calibration.report.errors;
    let width = found.iter().map(|error| error.name.len()).max().unwrap_or_default();
    for error in found {
        let quantity = match error.unit {
            "1" => format!("{:?}", error.value),
            unit => format!("\"{:?} {unit}\"", error.value),
        };
        let told = quantities::estimate(error.value, error.standard_uncertainty, error.unit);
        let alone = if error.separable { "" } else { ", determined only together with others" };
        let _ = writeln!(text, "{:width$} = {quantity:32} # {told}{alone}", error.name);
    }
    // Errors that were held at a value belong to the model as much as those that were estimated.
    for (symbol, &value) in calibration.chain.symbols.iter().zip(&calibration.after.values) {
        let estimated = found.iter().any(|error| error.name == symbol.name);
        if symbol.kind == SymbolKind::Error && value != 0.0 && !estimated {
            let _ = writeln!(
                text,
                "{:width$} = {value:?} # held fixed, in {}",
                symbol.name,
                symbol.quantity.unit()
            );
        }
    }
    text
}

/// One row an observation: its number, the readings, and the residual components before and after, in SI.
fn write_residuals(reported: &Reported<'_>, path: &Path) -> Result<(), Failure> {
    let components = residuals::components(reported);
    let columns = components.iter().flat_map(|component| {
        let name = |when| format!("{}_{when} [{}]", component.name, component.unit);
        [(name("before"), &component.before), (name("after"), &component.after)]
    });
    let (names, columns): (Vec<String>, Vec<&Vec<Option<f64>>>) = columns.unzip();
    let weights = &reported.calibration.after.residuals.weight;
    tables::write(path, |writer| {
        let readings = residuals::readings(reported).map(|(name, unit, _)| match unit {
            "1" => name.to_owned(),
            unit => format!("{name} [{unit}]"),
        });
        writer
            .row(["row".to_owned()].into_iter().chain(readings).chain(names).chain(["weight".to_owned()]))?;
        for row in 0..reported.observations.rows() {
            let number = reported.observations.row_numbers.get(row).map_or(row as u64 + 1, |&number| number);
            let readings = residuals::readings(reported).map(|(_, _, values)| tables::number(values[row]));
            let residuals = columns.iter().map(|column| column[row].map_or_else(String::new, tables::number));
            let weight = tables::number(weights.get(row).copied().unwrap_or(1.0));
            writer.row([number.to_string()].into_iter().chain(readings).chain(residuals).chain([weight]))?;
        }
        Ok(())
    })
}
