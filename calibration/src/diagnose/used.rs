//! How many observations were used, and which were not.

use serde::Serialize;

use fit::FitResult;
use observe::unknowns::Unknowns;
use observe::{Observations, Origin};

/// How many observations were used, and which were not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Used {
    /// Observations read.
    pub rows: usize,
    /// Observations with weight.
    pub used: usize,
    /// Groups of rows that are not independent.
    pub groups: usize,
    /// Observed objects whose place the study does not say; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknown_objects: Option<usize>,
    /// The others.
    pub set_aside: Vec<SetAsideRow>,
}

/// An observation that has no weight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetAsideRow {
    /// Its number in its file, from 1.
    pub row: u64,
    /// Its file, where the observations come from several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Its line in the file, from 1, where the format has lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Its own name, where the study says a column of names.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Why.
    pub why: String,
}

/// What a fit used of some observations.
pub(super) fn used(observations: &Observations, fit: &FitResult) -> Used {
    let mut groups = observations.groups.clone();
    groups.sort_unstable();
    groups.dedup();
    Used {
        rows: observations.rows(),
        used: observations.rows() - fit.set_aside.len(),
        groups: groups.len(),
        unknown_objects: observations.unknowns.as_ref().and_then(Unknowns::unknown_objects),
        set_aside: fit
            .set_aside
            .iter()
            .map(|aside| {
                let Origin { file, line, name } = observations.origins.of(aside.row);
                let (file, id) = (file.map(str::to_owned), name.map(str::to_owned));
                SetAsideRow {
                    row: observations.row_number(aside.row),
                    file,
                    line,
                    id,
                    why: aside.why.to_string(),
                }
            })
            .collect(),
    }
}
