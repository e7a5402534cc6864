//! The files of a calibration, by their names.

use report::{Cells, NotJson, Reported, places};
use study::Plan;

use crate::errors_file;

/// The page, and the table of residuals: what takes long to make, and is made by whoever writes it.
pub const PAGE: &str = "report.html";
/// The table of residuals.
pub const RESIDUALS: &str = "residuals.csv";

/// The files of every calibration in its folder.
const NAMES: [&str; 6] = [PAGE, "report.json", "instrument.toml", "amended.chain", "errors.toml", RESIDUALS];

/// The files that a calibration of a plan may have.
pub fn file_names(plan: &Plan) -> impl Iterator<Item = &'static str> {
    let has_objects = plan.sources.iter().any(|source| source.measure.observes_object());
    NAMES.into_iter().chain(places::NAMES.into_iter().filter(move |_| has_objects))
}

/// The texts beside the page, with the `instrument` file of a usable model; none of what needs a usable model where none came out.
///
/// # Errors
/// A number of the report is none.
pub fn texts(
    reported: &Reported<'_>,
    instrument: Option<String>,
) -> Result<[(&'static str, Option<String>); 4], NotJson> {
    Ok([
        ("report.json", Some(report::json(reported)?)),
        ("instrument.toml", instrument),
        ("amended.chain", reported.calibration.amended.clone()),
        ("errors.toml", errors_file::errors(reported)),
    ])
}

/// The columns of a table by their names.
pub type Columns<'a> = Vec<(String, Cells<'a>)>;

/// The tables of unknown objects and of stations, where there are such.
#[must_use]
pub fn tables_of_places<'a>(reported: &Reported<'a>) -> [(&'static str, Option<Columns<'a>>); 2] {
    let [objects, stations] = places::NAMES;
    let own = reported.calibration.places.as_ref();
    [
        (objects, own.map(places::objects)),
        (stations, own.filter(|own| !own.stations.is_empty()).map(places::stations)),
    ]
}
