//! A table of points with the pose of the vehicle at the time of each row, as columns behind its own.

use std::sync::Arc;

use super::overlap::{apart, offset, times};
use super::{NotThere, Pose, Trajectory};
use crate::formats::sbet::of_numbers;
use crate::formats::{Cells, Chunk, ColumnName, DataError, TableReader, Wanted};

/// The columns that a trajectory brings.
pub const COLUMNS: [&str; 6] =
    ["east [m]", "north [m]", "up [m]", "heading [rad]", "pitch [rad]", "roll [rad]"];

/// Rows that are counted at a time where one has no pose.
const COUNTED: usize = 1 << 16;

/// Records that are farther apart say nothing of what lies between, unless a study says more, s.
pub const GAP_S: f64 = 0.1;

/// How rows and poses belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Join {
    /// The column of the points that has their times.
    pub time: String,
    /// What is added to their times, s.
    pub offset_s: f64,
    /// How far records may be apart between which poses are interpolated, s.
    pub gap_s: f64,
}

/// The table.
pub struct Joined<'t> {
    points: Box<dyn TableReader + 't>,
    trajectory: Arc<Trajectory>,
    join: Join,
    header: Vec<ColumnName>,
    /// The column of the times.
    time: Wanted,
    /// All times so far.
    seen: Seen,
}

/// Times of rows, and how many of them have no pose.
#[derive(Debug, Clone, Copy)]
struct Seen {
    rows: u64,
    without: u64,
    span_s: [f64; 2],
}

impl Seen {
    fn take(&mut self, time_s: f64, has_pose: bool) {
        self.rows += 1;
        self.without += u64::from(!has_pose);
        self.span_s = [self.span_s[0].min(time_s), self.span_s[1].max(time_s)];
    }
}

impl<'t> Joined<'t> {
    /// Joins a table of points and a trajectory.
    ///
    /// # Errors
    /// The points have no such column of times, or columns that the trajectory brings.
    pub fn new(
        points: Box<dyn TableReader + 't>,
        trajectory: Arc<Trajectory>,
        join: Join,
    ) -> Result<Self, DataError> {
        let (own, file) = (points.header(), points.source());
        let time = times(&*points, &join.time)?;
        let brought: Vec<ColumnName> = COLUMNS.iter().map(|name| ColumnName::parse(name)).collect();
        if let Some(twice) = own.iter().find(|own| brought.iter().any(|column| own.means(&column.stem, &[])))
        {
            return Err(DataError::UnusableColumn {
                file: file.to_owned(),
                column: twice.full.clone(),
                why: format!(
                    "has the name of one that {} brings: rename it, or leave [trajectory] out of the study",
                    trajectory.source()
                ),
            });
        }
        let header = own.iter().cloned().chain(brought).collect();
        let seen = Seen { rows: 0, without: 0, span_s: [f64::INFINITY, f64::NEG_INFINITY] };
        Ok(Self { points, trajectory, join, header, time, seen })
    }

    /// How many columns the points have by themselves.
    fn own(&self) -> usize {
        self.header.len() - COLUMNS.len()
    }

    /// The pose of each row of a chunk, as the columns have it.
    fn poses(&mut self, times: &[f64], chunk: &Chunk) -> Result<Vec<[f64; 6]>, DataError> {
        let mut poses = Vec::with_capacity(times.len());
        for (at, time) in times.iter().enumerate() {
            match self.pose(*time) {
                Ok(pose) => {
                    let ([east, north, up], [heading, pitch, roll]) = (pose.place_m.into(), pose.angles());
                    poses.push([east, north, up, heading, pitch, roll]);
                }
                Err(why) => return Err(self.without_pose(times, (chunk, at), why)),
            }
            self.seen.take(*time, true);
        }
        Ok(poses)
    }

    fn pose(&self, time_s: f64) -> Result<Pose, NotThere> {
        self.trajectory.at(time_s + self.join.offset_s, self.join.gap_s)
    }

    /// What is said of a row without a pose: how many there are, and what to write.
    fn without_pose(&mut self, times: &[f64], (chunk, at): (&Chunk, usize), why: NotThere) -> DataError {
        let count = |joined: &mut Self, time: f64| {
            let has_pose = joined.pose(time).is_ok();
            joined.seen.take(time, has_pose);
        };
        times[at..].iter().for_each(|time| count(self, *time));
        // What else is wrong further on is said when this is mended.
        while let Ok(more) = self.points.read(&[self.time], COUNTED)
            && !more.rows.is_empty()
        {
            if let Some(Cells::Numbers(times)) = more.columns.first() {
                times.iter().for_each(|time| count(self, *time));
            }
        }
        let Seen { rows, without, span_s } = self.seen;
        let named = self.trajectory.source();
        let why = match why {
            NotThere::Gap(from, to) => format!(
                "its time {} is in a gap of {named}, from {from:?} s to {to:?} s. {without} of {rows} rows have no pose. Leave them out, or write \
                 gap = \"{:.3} s\" under [trajectory] to interpolate across",
                self.told(times[at]),
                1.001 * (to - from)
            ),
            NotThere::Outside => self.outside(times[at], span_s),
        };
        let (file, line) = (self.points.source().to_owned(), chunk.lines.get(at).copied());
        DataError::Impossible { file, line, row: chunk.rows[at], why }
    }

    /// A time as it stands in the table, and what it comes to.
    fn told(&self, time_s: f64) -> String {
        match self.join.offset_s {
            0.0 => format!("{time_s:?} s"),
            offset => format!("{time_s:?} s, with the offset {:?} s,", time_s + offset),
        }
    }

    fn outside(&self, time_s: f64, span_s: [f64; 2]) -> String {
        let Seen { rows, without, .. } = self.seen;
        let (named, covered) = (self.trajectory.source(), self.trajectory.span());
        let points = span_s.map(|time| time + self.join.offset_s);
        let [[from, to], [first, last]] = [covered, points];
        let said = format!(
            "its time {} is outside of {named}. The trajectory has {from:?} s to {to:?} s, the points have {first:?} s to {last:?} s. {without} of \
             {rows} rows are outside.",
            self.told(time_s)
        );
        let apart = apart(points, covered).map(|apart| format!("{apart}. ")).unwrap_or_default();
        let help = match offset(points, covered) {
            Some(offset) => format!(
                "Probably {}. If so, write offset = \"{} s\" under [trajectory]",
                offset.what,
                self.join.offset_s + offset.seconds
            ),
            None if apart.is_empty() => "Leave these rows out, or give a trajectory that covers them".to_owned(),
            None => "Give the trajectory of these points. Or write what is to be added to their times, as offset = \"-18 s\" under [trajectory]".to_owned(),
        };
        format!("{said} {apart}{help}")
    }
}

impl TableReader for Joined<'_> {
    fn source(&self) -> &str {
        self.points.source()
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn gives_any_label(&self) -> bool {
        self.points.gives_any_label()
    }

    fn latitude_deg(&self) -> Option<f64> {
        self.points.latitude_deg()
    }

    fn remarks(&self) -> Vec<String> {
        self.points.remarks()
    }

    fn lacks(&self) -> Option<&str> {
        self.points.lacks()
    }

    fn behind(&self) -> &[usize] {
        self.points.behind()
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let own = self.own();
        let of_points = wanted.iter().filter(|want| want.column < own);
        let asked: Vec<Wanted> = of_points.chain([&self.time]).copied().collect();
        let mut chunk = self.points.read(&asked, at_most)?;
        let Some(Cells::Numbers(times)) = chunk.columns.pop() else {
            unreachable!("the times were wanted as numbers, behind all others")
        };
        let poses = self.poses(&times, &chunk)?;
        let brought = |column: usize| poses.iter().map(move |pose| pose[column]);
        let mut read = std::mem::take(&mut chunk.columns).into_iter();
        let columns = wanted.iter().map(|want| match want.column.checked_sub(own) {
            Some(column) => of_numbers(brought(column), want.form),
            None => read.next().unwrap_or_else(|| unreachable!("every column of the points was read")),
        });
        chunk.columns = columns.collect();
        Ok(chunk)
    }
}
