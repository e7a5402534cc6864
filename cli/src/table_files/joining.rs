//! The trajectory that joins the rows of a table, as a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use study::TrajectoryPlan;
use tables::formats::{DataError, Options, TableReader};
use tables::trajectory::Trajectory;

use super::{failure, open_table};
use crate::failure::Failure;

/// A trajectory that was read, and how it joins rows.
#[derive(Clone)]
pub struct Joining {
    plan: TrajectoryPlan,
    trajectory: Arc<Trajectory>,
}

/// Where the trajectory of some data is by default: as the study of other data names it, or by its name alone, beside these data.
pub fn beside(data: &Path, named: &str) -> PathBuf {
    let folder = data.parent().unwrap_or(Path::new(""));
    let as_named = folder.join(named);
    match Path::new(named).file_name() {
        Some(name) if !as_named.exists() => folder.join(name),
        _ => as_named,
    }
}

impl Joining {
    /// Reads the trajectory of a plan: the file that is named, or else the plan's beside the data.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(
        plan: &TrajectoryPlan,
        named: Option<&Path>,
        data: &Path,
        options: &Options,
    ) -> Result<Self, Failure> {
        let beside = beside(data, &plan.path);
        if named.is_none() && !beside.exists() {
            return Err(Failure::Input(format!(
                "`{}` is not there, and the study joins its rows with a trajectory: name that of these rows with --trajectory",
                beside.display()
            )));
        }
        let mut reader = open_table(named.unwrap_or(&beside), options).map_err(failure)?;
        let trajectory = plan.read(&mut *reader, options).map_err(failure)?;
        Ok(Self { plan: plan.clone(), trajectory })
    }

    /// A table with what joins it, if something does.
    ///
    /// # Errors
    /// The rows have no column of times, or columns that a trajectory brings.
    pub fn table<'t>(
        joining: Option<&Self>,
        reader: Box<dyn TableReader + 't>,
    ) -> Result<Box<dyn TableReader + 't>, DataError> {
        match joining {
            Some(Self { plan, trajectory }) => plan.joined(reader, trajectory),
            None => Ok(reader),
        }
    }
}
