//! The files of a calibration, each written whole.

use std::io::Write;
use std::path::Path;

use calibration::diagnose::{Diagnosis, Shown};
use model_core::{Chain, escape};
use network::Placed;
use observe::unknowns::Shape;
use serde::Serialize;
use study::Plan;
use tables::formats::{Texts, Written};

use super::errors::{errors_toml, ranges_of};
use super::page::page;
use super::residuals::Cells;
use super::{Provenance, Reported, diff, places, residuals};
use crate::errors_file::FoundOver;
use crate::failure::Failure;
use crate::output::Folder;
use crate::{table_files, terminal};

/// The number of the promise that the keys of `report.json` are.
const SCHEMA: u32 = 4;

/// The files of every calibration in its folder.
const NAMES: [&str; 5] = ["report.html", "report.json", "amended.chain", "errors.toml", "residuals.csv"];

/// Objects and stations at most of which `report.json` says where they are.
const FEW: usize = 1000;

/// Rows that `residuals.csv` has at most, unless all are asked for.
const ROWS: usize = 100_000;

/// The files that a calibration of a plan may write into its folder.
pub fn file_names(plan: &Plan) -> impl Iterator<Item = &'static str> {
    let has_objects = plan.sources.iter().any(|source| Shape::of(source.measure).is_some());
    NAMES.into_iter().chain(places::NAMES.into_iter().filter(move |_| has_objects))
}

/// Which rows `residuals.csv` has.
#[must_use]
pub fn rows_written(reported: &Reported<'_>, all: bool) -> Shown {
    let most = if all { usize::MAX } else { ROWS };
    Shown::of(reported.observations, &reported.calibration.after, most)
}

/// Writes `report.html`, `report.json` and, with the rows that are shown, `residuals.csv` into a folder, which is made if it is not there;
/// and, where a usable model came out, `amended.chain` and `errors.toml`, and `objects.csv` and `stations.csv` where there are such. They appear together, or not at all.
///
/// # Errors
/// The folder or a file cannot be written; nothing has changed then.
pub fn write_all(reported: &Reported<'_>, shown: &Shown, folder: &Path) -> Result<(), Failure> {
    let mut files = Folder::new(folder)?;
    files.write_text("report.json", &json(reported)?)?;
    let calibration = reported.calibration;
    let is_left = |name: &str| {
        if folder.join(name).exists() {
            terminal::warn(format_args!("{name} in {} is from an earlier run", folder.display()));
        }
    };
    for (name, text) in [("amended.chain", calibration.amended.clone()), ("errors.toml", errors(reported))] {
        match text {
            Some(text) => files.write_text(name, &text)?,
            None => is_left(name),
        }
    }
    let [objects, stations] = places::NAMES;
    let of_places = calibration.places.as_ref();
    let tables = [
        (objects, of_places.map(places::objects)),
        (stations, of_places.filter(|own| !own.stations.is_empty()).map(places::stations)),
    ];
    for (name, columns) in tables {
        match columns {
            Some(columns) => files.write(name, |file| write_table(&columns, &folder.join(name), file))?,
            None if file_names(reported.plan).any(|own| own == name) => is_left(name),
            None => {}
        }
    }
    let (residuals, page) = rayon::join(
        || {
            let path = folder.join("residuals.csv");
            files.write("residuals.csv", |file| write_table(&residuals::table(reported, shown), &path, file))
        },
        || page(reported),
    );
    residuals?;
    files.write_text("report.html", &page)?;
    files.finish()
}

/// `errors.toml`, where a usable model came out.
#[must_use]
pub fn errors(reported: &Reported<'_>) -> Option<String> {
    let calibration = reported.calibration;
    let date = &reported.provenance.date;
    let values = &calibration.after.values;
    let over = found_over(reported)?;
    Some(errors_toml(&calibration.diagnosis.errors, &calibration.chain, values, date, &over))
}

/// The ranges of the readings that an amended declaration was found over, if a usable model came out.
#[must_use]
pub fn found_over(reported: &Reported<'_>) -> Option<Vec<FoundOver>> {
    let calibration = reported.calibration;
    let amended = Chain::from_text(calibration.amended.as_ref()?).unwrap_or_else(|mistakes| {
        unreachable!("an amended text is read before it is given out: {mistakes}")
    });
    let mut over = ranges_of(reported.observations, &calibration.after.residuals.weight);
    // A side quantity that no effect needed is none of the amended chain's.
    over.retain(|range| amended.find_symbol(&calibration.chain.symbol(range.symbol).name).is_some());
    Some(over)
}

/// `report.json`: the diagnosis, and what it was made with.
#[derive(Serialize)]
struct Json<'a> {
    schema: u32,
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    /// Where objects and stations came out, where they are few enough.
    #[serde(skip_serializing_if = "Option::is_none")]
    places: Option<&'a Placed>,
    /// The declaration's change, as a unified diff; empty where nothing was added.
    diff: String,
    provenance: &'a Provenance,
}

/// The report for programs.
///
/// # Errors
/// A number in it is none.
pub fn json(reported: &Reported<'_>) -> Result<String, Failure> {
    let is_short = |places: &&Placed| places.objects.len() + places.stations.len() <= FEW;
    let json = Json {
        schema: SCHEMA,
        diagnosis: &reported.calibration.diagnosis,
        places: reported.calibration.places.as_ref().filter(is_short),
        diff: diff(reported),
        provenance: reported.provenance,
    };
    serde_json::to_string_pretty(&json)
        .map(|text| escape::json(&text).into_owned() + "\n")
        .map_err(|error| Failure::Input(format!("the report cannot be written as JSON: {error}")))
}

/// Columns as separated values, row by row; a cell is empty where there is no number.
fn write_table(columns: &[(String, Cells<'_>)], path: &Path, file: &mut dyn Write) -> Result<(), Failure> {
    table_files::csv_row(file, path, columns.iter().map(|(name, _)| name.as_str()))?;
    let texts: Vec<Option<Texts>> = columns
        .iter()
        .map(|(_, cells)| if let Cells::Texts(texts) = cells { Some(texts.iter().collect()) } else { None })
        .collect();
    let rows = columns.first().map_or(0, |(_, cells)| match cells {
        Cells::Rows(numbers) => numbers.len(),
        Cells::Texts(texts) => texts.len(),
        Cells::Numbers(numbers) => numbers.len(),
        Cells::Residuals(numbers) => numbers.len(),
    });
    let written = columns.iter().zip(&texts).map(|((_, cells), texts)| match (cells, texts) {
        (Cells::Rows(numbers), _) => Written::Counts(numbers),
        (Cells::Numbers(numbers), _) => Written::Numbers(numbers),
        (Cells::Residuals(numbers), _) => Written::Residuals(numbers),
        (Cells::Texts(_), Some(texts)) => Written::Texts(texts),
        (Cells::Texts(_), None) => unreachable!("texts were gathered above"),
    });
    table_files::csv_rows(file, path, &written.collect::<Vec<_>>(), rows)
}
