//! The files of a calibration, each written whole.

use std::fs;
use std::path::Path;

use calibration::data::SiUnit;
use calibration::diagnose::Diagnosis;
use serde::Serialize;

use super::errors::errors_toml;
use super::{Provenance, Reported, diff, page, residuals};
use crate::failure::Failure;
use crate::{output, tables, terminal};

/// The number of the promise that the keys of `report.json` are.
const SCHEMA: u32 = 2;

/// Writes `report.html`, `report.json` and `residuals.csv` into a folder, which is made if it is not there; and, where a
/// usable model came out, `amended.chain` and `errors.toml`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_all(reported: &Reported<'_>, folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::write(folder, &error))?;
    output::write_text(&folder.join("report.json"), &json(reported)?)?;
    let calibration = reported.calibration;
    for (name, text) in [
        ("amended.chain", calibration.amended.clone()),
        ("errors.toml", calibration.amended.as_ref().map(|_| errors(reported))),
    ] {
        match text {
            Some(text) => output::write_text(&folder.join(name), &text)?,
            None if folder.join(name).exists() => {
                terminal::warn(format_args!("{name} in {} is from an earlier run", folder.display()));
            }
            None => {}
        }
    }
    write_residuals(reported, &folder.join("residuals.csv"))?;
    output::write_text(&folder.join("report.html"), &page::page(reported))
}

fn errors(reported: &Reported<'_>) -> String {
    let calibration = reported.calibration;
    let date = &reported.provenance.date;
    errors_toml(&calibration.diagnosis.errors, &calibration.chain, &calibration.after.values, date)
}

/// `report.json`: the diagnosis, and what it was made with.
#[derive(Serialize)]
struct Json<'a> {
    schema: u32,
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    /// The declaration's change, as a unified diff; empty where nothing was added.
    diff: String,
    provenance: &'a Provenance,
}

/// The report for programs.
///
/// # Errors
/// A number in it is none.
pub fn json(reported: &Reported<'_>) -> Result<String, Failure> {
    let json = Json {
        schema: SCHEMA,
        diagnosis: &reported.calibration.diagnosis,
        diff: diff(reported),
        provenance: &reported.provenance,
    };
    serde_json::to_string_pretty(&json)
        .map(|text| text + "\n")
        .map_err(|error| Failure::Input(format!("the report cannot be written as JSON: {error}")))
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
            SiUnit::ONE => name.to_owned(),
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
