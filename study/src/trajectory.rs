//! `[trajectory]`: the poses of a vehicle, which join the rows of a study's tables by time.

use std::sync::Arc;

use toml::Spanned;

use super::amount::si_with_unit;
use super::format::angle;
use super::mistakes::{Gathered, Outcome, mistake};
use super::written::{Origin, Study};
use model_core::Quantity;
use tables::formats::{DataError, Options, TableReader};
use tables::trajectory::{GAP_S, Geodetic, Join, Joined, Trajectory};
use tables::units;

/// Which trajectory joins the rows of a study, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryPlan {
    /// Path of the file, relative to the study.
    pub path: String,
    /// The times that belong together.
    pub join: Join,
    /// The place that is zero; where the first record is, if none is said.
    pub origin: Option<Geodetic>,
}

impl Study {
    /// The trajectory that joins its rows.
    pub(super) fn trajectory(&self) -> Outcome<Option<TrajectoryPlan>> {
        let Some(written) = &self.trajectory else { return Ok(None) };
        let mut mistakes = Gathered::default();
        let time = |text: &Option<Spanned<String>>, default: f64| match text {
            Some(text) => units::parse_time(text.get_ref())
                .map_err(|error| mistake(text.span(), error.to_string(), "write a time, as \"0.1 s\"")),
            None => Ok(default),
        };
        let offset_s = mistakes.take(time(&written.offset, 0.0));
        let gap_s = mistakes.take(time(&written.gap, GAP_S));
        if let (Some(gap), Some(seconds)) = (&written.gap, gap_s)
            && seconds <= 0.0
        {
            let help = "write a time above zero, as gap = \"0.1 s\"";
            mistakes.take::<()>(Err(mistake(gap.span(), "records are always some time apart", help)));
        }
        let origin = mistakes.take(written.origin.as_ref().map(origin).transpose());
        mistakes.none()?;
        let (Some(offset_s), Some(gap_s), Some(origin)) = (offset_s, gap_s, origin) else {
            unreachable!("what is missing comes with a mistake")
        };
        let join = Join { time: written.time.clone(), offset_s, gap_s };
        Ok(Some(TrajectoryPlan { path: written.file.get_ref().clone(), join, origin }))
    }
}

fn origin(written: &Origin) -> Outcome<Geodetic> {
    let height = &written.height;
    Ok(Geodetic {
        latitude_rad: angle(&written.latitude, 90.0)?.to_radians(),
        longitude_rad: angle(&written.longitude, 360.0)?.to_radians(),
        height_m: si_with_unit("height", height.get_ref(), Quantity::Length, &height.span())?,
    })
}

/// A trajectory that is read once, for every table that it joins.
#[derive(Clone)]
pub struct Joining {
    trajectory: Arc<Trajectory>,
    join: Join,
}

impl Joining {
    /// Reads the trajectory of a plan from an open table.
    ///
    /// # Errors
    /// What is wrong with it, with its place.
    pub fn read(
        plan: &TrajectoryPlan,
        reader: &mut dyn TableReader,
        options: &Options,
    ) -> Result<Self, DataError> {
        let trajectory = Arc::new(Trajectory::read(reader, plan.origin, options)?);
        Ok(Self { trajectory, join: plan.join.clone() })
    }

    /// A table of points with what joins it, if something does.
    ///
    /// # Errors
    /// The points have no column of times, or columns that a trajectory brings.
    pub fn table<'t>(
        joining: Option<&Self>,
        points: Box<dyn TableReader + 't>,
    ) -> Result<Box<dyn TableReader + 't>, DataError> {
        match joining {
            Some(Self { trajectory, join }) => {
                Ok(Box::new(Joined::new(points, Arc::clone(trajectory), join.clone())?))
            }
            None => Ok(points),
        }
    }
}
