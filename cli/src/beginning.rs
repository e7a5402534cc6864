//! A trajectory that a study is begun with.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tables::formats::{Options, TableReader};
use tables::trajectory::{GAP_S, Join, Joined as JoinedTable, Offset, Trajectory, offset_of, time_column};

use crate::failure::Failure;
use crate::table_files::{failure, open_table};

/// A trajectory, and how it joins the rows of a table.
pub struct Joined {
    /// The file.
    pub file: PathBuf,
    trajectory: Arc<Trajectory>,
    time: String,
    offset: Option<Offset>,
}

impl Joined {
    /// Reads a trajectory, and sees how the times of points are counted beside it.
    ///
    /// # Errors
    /// Either cannot be read; the points have no times.
    pub fn read(file: &Path, points: &mut dyn TableReader) -> Result<Self, Failure> {
        let options = Options::default();
        let mut reader = open_table(file, &options).map_err(failure)?;
        let trajectory = Trajectory::read(&mut *reader, None, &options).map_err(failure)?;
        let time = time_column(points).map_err(failure)?;
        let offset = offset_of(points, &time, &trajectory).map_err(failure)?;
        Ok(Self { file: file.to_owned(), trajectory: Arc::new(trajectory), time, offset })
    }

    /// A table with the poses of its rows.
    ///
    /// # Errors
    /// It has no times, or columns that a trajectory brings.
    pub fn table(&self, points: Box<dyn TableReader>) -> Result<Box<dyn TableReader>, Failure> {
        let offset_s = self.offset.map_or(0.0, |offset| offset.seconds);
        let join = Join { time: self.time.clone(), offset_s, gap_s: GAP_S };
        Ok(Box::new(JoinedTable::new(points, Arc::clone(&self.trajectory), join).map_err(failure)?))
    }

    /// What was assumed of the times, if that is more than what the files have.
    pub fn said(&self) -> Option<String> {
        let Offset { seconds, what } = self.offset?;
        Some(format!("By their times {what}. The study adds {seconds} s to the times of the points."))
    }

    /// As a study names it, by this path.
    pub fn named<'a>(&'a self, file: &'a str) -> init::Joined<'a> {
        init::Joined { file, time: &self.time, offset: self.offset, origin: self.trajectory.origin }
    }
}
