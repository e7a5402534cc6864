//! Times of points and of a trajectory that do not overlap: how far they are apart, and which count of GPS time would bring them together.

use model_core::names::listed;
use model_core::unit::Measures;

use super::Trajectory;
use crate::formats::{Cells, ColumnName, DataError, Form, ReadAs, TableReader, Wanted, find_column};

/// Names of columns with times, the plainest first.
const NAMES: [&str; 10] =
    ["gps_time", "gpstime", "time", "timestamp", "time_of_week", "tow", "sow", "gps_seconds", "seconds", "t"];
/// Rows that are read at a time.
const CHUNK: usize = 1 << 16;

/// Seconds of a GPS week.
const WEEK_S: f64 = 604_800.0;
/// Seconds of a day.
const DAY_S: f64 = 86_400.0;
/// What standard (adjusted) GPS time is less than the seconds since 6 January 1980.
const ADJUSTED_S: f64 = 1e9;

/// What is added to the times of points so that all of them are those of the trajectory, and what they are counted from then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    /// What is added, s.
    pub seconds: f64,
    /// What that makes of the times.
    pub what: &'static str,
}

/// Which of the counts of GPS time brings the points (first and last time) into the trajectory (first and last time), s.
#[must_use]
pub fn offset([first, last]: [f64; 2], [from, to]: [f64; 2]) -> Option<Offset> {
    let whole = |away: f64, unit: f64| (away / unit).ceil() * unit;
    let known = [
        (
            ADJUSTED_S + whole(from - ADJUSTED_S - first, WEEK_S),
            "the points have standard GPS time (less 10⁹ s) and the trajectory has seconds of the GPS week",
        ),
        (whole(from - first, WEEK_S), "one of them counts GPS weeks and the other does not"),
        (
            whole(from - first + ADJUSTED_S, WEEK_S) - ADJUSTED_S,
            "the trajectory has standard GPS time (less 10⁹ s) and the points have seconds of the GPS week",
        ),
        (whole(from - first, DAY_S), "one of them counts days and the other does not"),
    ];
    let fits = |seconds: f64| seconds != 0.0 && first + seconds >= from && last + seconds <= to;
    known.into_iter().find(|(seconds, _)| fits(*seconds)).map(|(seconds, what)| Offset { seconds, what })
}

/// How far two ranges that do not overlap are apart, in words.
#[must_use]
pub fn apart([first, last]: [f64; 2], [from, to]: [f64; 2]) -> Option<String> {
    if first > to {
        return Some(format!("The first point comes {:?} s after the last record", first - to));
    }
    (last < from).then(|| format!("The last point comes {:?} s before the first record", from - last))
}

/// The column of a table of points that has their times, as a study names it.
///
/// # Errors
/// There is none.
pub fn time_column(points: &dyn TableReader) -> Result<String, DataError> {
    let plain = |column: &ColumnName| column.stem.to_lowercase().replace([' ', '-'], "_");
    let found = NAMES.iter().find_map(|name| points.header().iter().find(|column| plain(column) == *name));
    found.map(|column| column.full.clone()).ok_or_else(|| DataError::MissingColumn {
        file: points.source().to_owned(),
        column: "gps_time".to_owned(),
        help: format!(
            "it says when each row was measured, `gps_time [s]`; the file has {}",
            listed(points.header().iter().map(|column| column.full.as_str()))
        ),
    })
}

/// Times of a table of points, in seconds.
///
/// # Errors
/// There is no such column, or its unit is none of a time.
pub(super) fn times(points: &dyn TableReader, name: &str) -> Result<Wanted, DataError> {
    let (header, file) = (points.header(), points.source());
    let column = find_column(header, name, file)?;
    let read = ReadAs { measures: Measures::Time, stated: None, declared: Some(name) };
    Ok(Wanted { column, form: Form::Number(header[column].factor(read, file)?) })
}

/// What is added to the times of points so that all are a trajectory's; nothing where they are, or where no count of GPS time brings them
/// there.
///
/// # Errors
/// A time cannot be read.
pub fn offset_of(
    points: &mut dyn TableReader,
    name: &str,
    trajectory: &Trajectory,
) -> Result<Option<Offset>, DataError> {
    let wanted = [times(points, name)?];
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    loop {
        let chunk = points.read(&wanted, CHUNK)?;
        let Some(Cells::Numbers(times)) = chunk.columns.first().filter(|_| !chunk.rows.is_empty()) else {
            break;
        };
        span = times.iter().fold(span, |[from, to], time| [from.min(*time), to.max(*time)]);
    }
    let covered = trajectory.span();
    let is_within = span[0] >= covered[0] && span[1] <= covered[1];
    Ok(if is_within { None } else { offset(span, covered) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_count_of_gps_time_is_known_by_its_difference() {
        // Week 2315, Wednesday: from 300 000 s on.
        let (week, adjusted) = ([300_010.0, 300_500.0], 2315.0 * WEEK_S - ADJUSTED_S);
        let trajectory = [300_000.0, 300_600.0];
        let plus = |by: f64| week.map(|time| time + by);
        for (points, seconds) in [
            (plus(adjusted), -adjusted),
            (plus(2315.0 * WEEK_S), -2315.0 * WEEK_S),
            (plus(-3.0 * DAY_S), 3.0 * DAY_S),
        ] {
            assert_eq!(offset(points, trajectory).map(|own| own.seconds), Some(seconds), "{points:?}");
        }
        let later = trajectory.map(|time| time + adjusted);
        assert_eq!(offset(week, later).map(|own| own.seconds), Some(adjusted));
        // Points that last longer than the trajectory belong to another.
        assert_eq!(offset([300_010.0 + adjusted, 301_000.0 + adjusted], trajectory), None);
        assert_eq!(
            apart(plus(1000.0), trajectory).as_deref(),
            Some("The first point comes 410.0 s after the last record")
        );
        assert_eq!(apart(week, trajectory), None);
    }
}
