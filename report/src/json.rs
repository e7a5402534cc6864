//! `report.json`: the diagnosis, and what it was made with.

use std::collections::BTreeMap;

use calibration::diagnose::Diagnosis;
use calibration::thresholds::decided;
use model_core::escape;
use network::Placed;
use serde::Serialize;

use crate::text::diff;
use crate::{Provenance, Reported};

/// The number of the promise that the keys of `report.json` are.
const SCHEMA: u32 = 4;

/// Objects and stations at most of which `report.json` says where they are.
const FEW: usize = 1000;

/// The keys of `report.json` beside those of the diagnosis.
#[derive(Serialize)]
struct Json<'a> {
    schema: u32,
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    /// The thresholds that decided, by their names in the book.
    policy: BTreeMap<&'static str, f64>,
    /// Where objects and stations came out, where they are few enough.
    #[serde(skip_serializing_if = "Option::is_none")]
    places: Option<&'a Placed>,
    /// The declaration's change, as a unified diff; empty where nothing was added.
    diff: String,
    provenance: &'a Provenance,
}

/// A report that has no form as JSON.
#[derive(Debug, thiserror::Error)]
#[error("the report cannot be written as JSON: {0}")]
pub struct NotJson(#[from] serde_json::Error);

/// The report for programs.
///
/// # Errors
/// A number in it is none.
pub fn json(reported: &Reported<'_>) -> Result<String, NotJson> {
    let is_short = |places: &&Placed| places.objects.len() + places.stations.len() <= FEW;
    let json = Json {
        schema: SCHEMA,
        diagnosis: &reported.calibration.diagnosis,
        policy: decided(&reported.calibration.diagnosis).iter().map(|own| (own.name, own.value)).collect(),
        places: reported.calibration.places.as_ref().filter(is_short),
        diff: diff(reported),
        provenance: reported.provenance,
    };
    Ok(escape::json(&serde_json::to_string_pretty(&json)?).into_owned() + "\n")
}
