//! The trajectory that joins the rows of a table, as a file.

use std::path::{Path, PathBuf};

use study::{Joining, TrajectoryPlan};
use tables::formats::Options;

use super::{failure, open_table};
use crate::failure::Failure;

/// Where the trajectory of some data is by default: as the study of other data names it, or by its name alone, beside these data.
pub fn beside(data: &Path, named: &str) -> PathBuf {
    let folder = data.parent().unwrap_or(Path::new(""));
    let as_named = folder.join(named);
    match Path::new(named).file_name() {
        Some(name) if !as_named.exists() => folder.join(name),
        _ => as_named,
    }
}

/// Reads the trajectory of a plan: the file that is named, or else the plan's beside the data.
///
/// # Errors
/// It cannot be read.
pub fn joining(
    plan: &TrajectoryPlan,
    named: Option<&Path>,
    data: &Path,
    options: &Options,
) -> Result<Joining, Failure> {
    let beside = beside(data, &plan.path);
    if named.is_none() && !beside.exists() {
        return Err(Failure::Input(format!(
            "`{}` is not there, and the study joins its rows with a trajectory: name that of these rows with --trajectory",
            beside.display()
        )));
    }
    let mut reader = open_table(named.unwrap_or(&beside), options).map_err(failure)?;
    Joining::read(plan, &mut *reader, options).map_err(failure)
}
