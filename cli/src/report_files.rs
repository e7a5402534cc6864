//! The files of a calibration, each written whole.

use std::io::Write;
use std::path::Path;

use calibration::diagnose::Shown;
use report::{Cells, Reported, places};
use service::errors_file;
use study::Plan;

use crate::failure::Failure;
use crate::output::Folder;
use crate::terminal;

/// The files of every calibration in its folder.
const NAMES: [&str; 6] =
    ["report.html", "report.json", "instrument.toml", "amended.chain", "errors.toml", "residuals.csv"];

/// The files that a calibration of a plan may write into its folder.
pub fn file_names(plan: &Plan) -> impl Iterator<Item = &'static str> {
    let has_objects = plan.sources.iter().any(|source| source.measure.observes_object());
    NAMES.into_iter().chain(places::NAMES.into_iter().filter(move |_| has_objects))
}

/// Writes `report.html`, `report.json` and, with the rows that are shown, `residuals.csv` into a folder, which is made if it is not there;
/// and, where a usable model came out, the `instrument` as `instrument.toml`, `amended.chain` and `errors.toml`, and `objects.csv` and `stations.csv` where there are such. They appear together, or not at all.
///
/// # Errors
/// The folder or a file cannot be written; nothing has changed then.
pub fn write_all(
    reported: &Reported<'_>,
    shown: &Shown,
    instrument: Option<String>,
    folder: &Path,
) -> Result<(), Failure> {
    let mut files = Folder::new(folder)?;
    files.write_text("report.json", &report::json(reported)?)?;
    let calibration = reported.calibration;
    let is_left = |name: &str| {
        if folder.join(name).exists() {
            terminal::warn(format_args!("{name} in {} is from an earlier run", folder.display()));
        }
    };
    for (name, text) in [
        ("instrument.toml", instrument),
        ("amended.chain", calibration.amended.clone()),
        ("errors.toml", errors_file::errors(reported)),
    ] {
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
            files.write("residuals.csv", |file| write_table(&report::table(reported, shown), &path, file))
        },
        || report::page(reported),
    );
    residuals?;
    files.write_text("report.html", &page)?;
    files.finish()
}

/// Columns as separated values into the file of a name.
fn write_table(columns: &[(String, Cells<'_>)], path: &Path, file: &mut dyn Write) -> Result<(), Failure> {
    report::write_csv(columns, file).map_err(|error| Failure::write(path, &error))
}
