//! Where a vehicle was at a time, and how it was turned: a table of latitude, longitude, altitude, roll, pitch and heading (SBET is one),
//! as poses in the frame of east, north and up about one place.
//!
//! The vehicle's axes here are right, forward and up. Its turn is Rz(−heading) Rx(pitch) Ry(roll), which with the axes forward, right and
//! down is the usual Rz(heading) Ry(pitch) Rx(roll) from north, east and down.

mod earth;
mod joined;
mod overlap;
#[cfg(test)]
mod tests;

use std::f64::consts::{PI, TAU};

use model_core::unit::Measures;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use crate::formats::sbet::Record;
use crate::formats::{Cells, DataError, Form, Options, ReadAs, TableReader, Wanted, find_column};
pub use earth::Geodetic;
pub use joined::{COLUMNS, GAP_S, Join, Joined};
pub use overlap::{Offset, offset_of, time_column};

/// Records that are read at a time.
const CHUNK: usize = 1 << 14;
/// Bytes that a record takes while it is held.
const HELD: usize = 8 * size_of::<f64>();

/// A record of SBET whose position moves so far to the right, forward and up of the vehicle, and whose attitude turns by a rotation of the
/// vehicle's axes. All other numbers stay.
#[must_use]
pub fn moved(record: &Record, lever_m: &Vector3<f64>, boresight: &Rotation3<f64>) -> Record {
    let [latitude_rad, longitude_rad, height_m] = [record[1], record[2], record[3]];
    let [roll, pitch, heading] = [record[7], record[8], record[9] - record[10]];
    let here = Geodetic { latitude_rad, longitude_rad, height_m };
    let (axes, turn) = (here.east_north_up(), turned(heading, pitch, roll));
    let point = here.geocentric() + axes.transpose() * (turn * lever_m);
    let there = Geodetic::of_geocentric(&point);
    let turn = there.east_north_up() * axes.transpose() * (turn * boresight).matrix();
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    let [new_heading, pitch, roll] = Pose { place_m: Vector3::zeros(), turn }.angles();
    // Where whole turns were counted, or begin elsewhere, they stay so.
    let by = |from: f64, to: f64| from + (to - from + PI).rem_euclid(TAU) - PI;
    let mut moved = *record;
    moved[1] = there.latitude_rad;
    moved[2] = by(longitude_rad, there.longitude_rad);
    moved[3] = there.height_m;
    moved[7] = by(record[7], roll);
    moved[8] = pitch;
    moved[9] = by(heading, new_heading) + record[10];
    moved
}

/// Poses by time.
#[derive(Debug, Clone)]
pub struct Trajectory {
    source: String,
    times_s: Vec<f64>,
    places_m: Vec<Vector3<f64>>,
    turns: Vec<UnitQuaternion<f64>>,
    /// The place that is zero east, north and up.
    pub origin: Geodetic,
}

/// Where a vehicle was, and how it was turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// East, north and up.
    pub place_m: Vector3<f64>,
    /// From its right, forward and up to east, north and up.
    pub turn: UnitQuaternion<f64>,
}

/// Why there is no pose at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotThere {
    /// It is before the first record or after the last.
    Outside,
    /// The records about it are farther apart than is allowed: from one time to the other, s.
    Gap(f64, f64),
}

impl Pose {
    /// Heading, pitch and roll, rad.
    #[must_use]
    pub fn angles(&self) -> [f64; 3] {
        let turn = self.turn.to_rotation_matrix();
        let m = turn.matrix();
        let pitch = m[(2, 1)].clamp(-1.0, 1.0).asin();
        [m[(0, 1)].atan2(m[(1, 1)]), pitch, (-m[(2, 0)]).atan2(m[(2, 2)])]
    }
}

/// The turn of a vehicle from right, forward and up to east, north and up where it is.
#[must_use]
pub fn turned(heading: f64, pitch: f64, roll: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), -heading)
        * Rotation3::from_axis_angle(&Vector3::x_axis(), pitch)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), roll)
}

/// A row of a table of poses.
struct Row {
    time_s: f64,
    place: Geodetic,
    turn: Rotation3<f64>,
}

/// The columns of a table of poses, by the names that they may have.
const READ: [(&[&str], Measures); 7] = [
    (&["time", "gps_time"], Measures::Time),
    (&["latitude", "lat"], Measures::Angle),
    (&["longitude", "lon"], Measures::Angle),
    (&["altitude", "height"], Measures::Length),
    (&["roll"], Measures::Angle),
    (&["pitch"], Measures::Angle),
    (&["platform_heading", "heading"], Measures::Angle),
];
/// What a platform heading is more than a heading.
const WANDER: &str = "wander_angle";

impl Trajectory {
    /// Reads poses; zero is at `origin`, or where the first of them is.
    ///
    /// # Errors
    /// What is wrong with the table, with its place; too many rows for the memory that they may take.
    pub fn read(
        reader: &mut dyn TableReader,
        origin: Option<Geodetic>,
        options: &Options,
    ) -> Result<Self, DataError> {
        let source = reader.source().to_owned();
        let wanted = wanted(reader)?;
        let (mut origin, mut frame) = (origin, Frame::default());
        let (mut times_s, mut places_m, mut turns) = (Vec::new(), Vec::new(), Vec::new());
        loop {
            let chunk = reader.read(&wanted, CHUNK)?;
            if chunk.rows.is_empty() {
                break;
            }
            let columns: Vec<&[f64]> = chunk.columns.iter().map(numbers).collect();
            for (at, row_number) in chunk.rows.iter().enumerate() {
                let row = row(&columns, at);
                if times_s.last().is_some_and(|last| row.time_s <= *last) {
                    return Err(DataError::Impossible {
                        file: source,
                        line: chunk.lines.get(at).copied(),
                        row: *row_number,
                        why: "its time is not later than that of the row before: take it out".to_owned(),
                    });
                }
                if times_s.is_empty() {
                    frame = Frame::about(origin.get_or_insert(row.place));
                }
                let pose = frame.pose(&row);
                times_s.push(row.time_s);
                places_m.push(pose.place_m);
                turns.push(pose.turn);
            }
            options.holds(times_s.len() * HELD, &source)?;
        }
        match origin {
            Some(origin) if !times_s.is_empty() => Ok(Self { source, times_s, places_m, turns, origin }),
            _ => Err(DataError::NoRows { file: source }),
        }
    }

    /// Its name, for messages.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The first time and the last, s.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        [self.times_s.first(), self.times_s.last()].map(|time| time.copied().unwrap_or(f64::NAN))
    }

    /// The pose at a time: on the straight way between the two records about it, turned by the shortest rotation.
    ///
    /// # Errors
    /// There is none.
    pub fn at(&self, time_s: f64, gap_s: f64) -> Result<Pose, NotThere> {
        let [first, last] = self.span();
        if !(first..=last).contains(&time_s) {
            return Err(NotThere::Outside);
        }
        let after = self.times_s.partition_point(|own| *own <= time_s);
        let before = after - 1;
        let held = Pose { place_m: self.places_m[before], turn: self.turns[before] };
        let Some(next) = self.times_s.get(after).copied().filter(|_| self.times_s[before] < time_s) else {
            return Ok(held);
        };
        let step = next - self.times_s[before];
        // The last bits of large times make steps longer.
        if step > gap_s + 4.0 * f64::EPSILON * next.abs() {
            return Err(NotThere::Gap(self.times_s[before], next));
        }
        let share = (time_s - self.times_s[before]) / step;
        Ok(Pose {
            place_m: held.place_m.lerp(&self.places_m[after], share),
            turn: held.turn.slerp(&self.turns[after], share),
        })
    }
}

/// East, north and up about a place.
#[derive(Default)]
struct Frame {
    centre: Vector3<f64>,
    axes: Matrix3<f64>,
}

impl Frame {
    fn about(origin: &Geodetic) -> Self {
        Self { centre: origin.geocentric(), axes: origin.east_north_up() }
    }

    fn pose(&self, row: &Row) -> Pose {
        // Up there is not up here: the Earth is round.
        let turn = self.axes * row.place.east_north_up().transpose() * row.turn.matrix();
        Pose {
            place_m: self.axes * (row.place.geocentric() - self.centre),
            turn: UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn)),
        }
    }
}

/// Which columns of a table are read.
fn wanted(reader: &dyn TableReader) -> Result<Vec<Wanted>, DataError> {
    let (header, file) = (reader.header(), reader.source());
    let of = |name: &str, measures: Measures| {
        let column = find_column(header, name, file)?;
        let declared = Some(name).filter(|_| measures != Measures::Angle);
        let factor = header[column].factor(ReadAs { measures, stated: None, declared }, file)?;
        Ok(Wanted { column, form: Form::Number(factor) })
    };
    let mut wanted = READ
        .iter()
        .map(|(names, measures)| {
            let there = names.iter().find(|name| header.iter().any(|column| column.means(name, &[])));
            of(there.unwrap_or(&names[0]), *measures)
        })
        .collect::<Result<Vec<_>, DataError>>()?;
    if header.iter().any(|column| column.means(WANDER, &[])) {
        wanted.push(of(WANDER, Measures::Angle)?);
    }
    Ok(wanted)
}

fn numbers(cells: &Cells) -> &[f64] {
    match cells {
        Cells::Numbers(numbers) => numbers,
        Cells::Labels(_) | Cells::Kept(_) => unreachable!("numbers were wanted"),
    }
}

fn row(columns: &[&[f64]], at: usize) -> Row {
    let number =
        |column: usize| columns.get(column).and_then(|column| column.get(at)).copied().unwrap_or(0.0);
    let [time_s, latitude_rad, longitude_rad, height_m, roll, pitch, platform_heading, wander] =
        std::array::from_fn(number);
    Row {
        time_s,
        place: Geodetic { latitude_rad, longitude_rad, height_m },
        turn: turned(platform_heading - wander, pitch, roll),
    }
}
