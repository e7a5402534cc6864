//! A trajectory corrected by a calibration: that of a vehicle on which the scanner sits as the declaration has it without errors.
//!
//! With T the pose of the vehicle by the trajectory, E what the errors move the scanner by and N where it sits without them, the scanner is
//! at T E N. The corrected trajectory is T E: a program that knows N alone has the calibrated points with it.

use model_core::{SymbolId, SymbolKind};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use tables::formats::ColumnName;
use tables::formats::sbet::Record;
use tables::trajectory::{COLUMNS, Pose, moved, turned};

use crate::Instrument;
use crate::evaluation::{Evaluator, Exactness, Quantity};
use crate::export::{Difference, Subject};
use crate::refusal::Refusal;

/// What a trajectory is corrected by.
pub struct Mounted {
    /// From the trajectory's point to that of the corrected trajectory: right, forward, up.
    pub lever_m: Vector3<f64>,
    /// From the corrected axes to those of the trajectory.
    pub boresight: Rotation3<f64>,
    /// What a corrected trajectory leaves of the errors at the observable.
    pub left: String,
}

impl Mounted {
    /// By the errors of an instrument whose study joins its rows with a trajectory.
    ///
    /// # Errors
    /// It does not, or the errors of the scanner move it by what is no number.
    pub fn of(instrument: &Instrument) -> Result<Self, Refusal> {
        let six = poses(instrument)?;
        let subject = Subject::of(instrument, None)?;
        let at_zero = |values: &[f64]| pose_at_zero(&subject, values);
        let [with, without] = [at_zero(&subject.values)?, at_zero(&subject.without_errors())?];
        let boresight = with.1 * without.1.inverse();
        let lever_m = with.0 - boresight * without.0;
        if !lever_m.iter().chain(boresight.matrix().iter()).all(|number| number.is_finite()) {
            return Err(Refusal::Input(
                "where the scanner sits has no value where all readings are zero, and no trajectory can carry it: apply the instrument to points"
                    .to_owned(),
            ));
        }
        let difference = left(&subject, &six, (lever_m, boresight))?;
        let name = &subject.chain.observable(subject.observable).name;
        let size = crate::export::size(&subject, &difference);
        let left = format!(
            "At `{name}` the nominal mounting with the corrected trajectory differs from the instrument by {size}, at {} poses of the measured \
             region.",
            subject.poses.count
        );
        Ok(Self { lever_m, boresight, left })
    }

    /// A record of the corrected trajectory.
    #[must_use]
    pub fn corrected(&self, record: &Record) -> Record {
        moved(record, &self.lever_m, &self.boresight)
    }

    /// What a corrected trajectory is, in words.
    #[must_use]
    pub fn said(&self) -> String {
        let pose =
            Pose { place_m: Vector3::zeros(), turn: UnitQuaternion::from_rotation_matrix(&self.boresight) };
        let [heading, pitch, roll] = pose.angles().map(f64::to_degrees);
        let [right, forward, up] = [self.lever_m.x, self.lever_m.y, self.lever_m.z];
        format!(
            "Each position moved by {forward:.4} m forward, {right:.4} m to the right and {:.4} m down of the vehicle. Each attitude turned by \
             roll {roll:.5}°, pitch {pitch:.5}° and heading {heading:.5}°. Use the trajectory with the mounting of the declaration without errors.",
            0.0 - up
        )
    }
}

/// The joints that a trajectory gives, in the order of its columns.
fn poses(instrument: &Instrument) -> Result<[SymbolId; 6], Refusal> {
    let headings = instrument.headings.as_ref().filter(|headings| headings.trajectory.is_some());
    let headings = headings.ok_or_else(|| {
        Refusal::Input(
            "a trajectory is corrected by an instrument whose study has a [trajectory]: `trueaxis init points.csv flight.sbet` begins one"
                .to_owned(),
        )
    })?;
    let six = COLUMNS.map(|column| {
        let stem = ColumnName::parse(column).stem;
        let is_it = |id: &SymbolId| {
            headings.written(0, *id).is_some_and(|(name, ..)| ColumnName::parse(name).stem == stem)
        };
        headings.chain.symbols_of(SymbolKind::Joint).find(is_it).ok_or(stem)
    });
    let missing = six.iter().find_map(|own| own.as_ref().err());
    match missing {
        Some(stem) => Err(Refusal::Input(format!(
            "no joint of the declaration has the column `{stem}` of the trajectory: write it as motion: Tx(east), Ty(north), Tz(up), \
             Rz(-heading), Rx(pitch), Ry(roll)"
        ))),
        None => Ok(six.map(|own| own.unwrap_or_else(|_| unreachable!("none is missing")))),
    }
}

/// Where the body of the observable is, and how it is turned, where all readings are zero.
fn pose_at_zero(subject: &Subject, values: &[f64]) -> Result<(Vector3<f64>, Rotation3<f64>), Refusal> {
    let (posed, observables) = crate::apply::with_axes(&subject.chain, subject.observable);
    let evaluator = Evaluator::new(&posed, observables, Exactness::Exact, Quantity::Value, values);
    let zero = [0.0];
    let readings: Vec<(SymbolId, &[f64])> =
        evaluator.readings.iter().map(|id| (*id, zero.as_slice())).collect();
    let columns = evaluator.columns(&readings, 1)?;
    let [place, x, y, z] = [0, 3, 6, 9].map(|first| Vector3::from_fn(|axis, _| columns[first + axis][0]));
    Ok((place, Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z]))))
}

/// What is left at the observable where the poses are corrected, and nothing else.
fn left(
    subject: &Subject,
    six: &[SymbolId; 6],
    (lever_m, boresight): (Vector3<f64>, Rotation3<f64>),
) -> Result<Difference, Refusal> {
    let mut readings = subject.poses.readings.clone();
    let places: Vec<usize> =
        six.iter().filter_map(|id| readings.iter().position(|(own, _)| own == id)).collect();
    for pose in 0..subject.poses.count {
        let [east, north, up, heading, pitch, roll] =
            std::array::from_fn(|at| places.get(at).map_or(0.0, |place| readings[*place].1[pose]));
        let turn = turned(heading, pitch, roll);
        let place = Vector3::new(east, north, up) + turn * lever_m;
        let turn = UnitQuaternion::from_rotation_matrix(&(turn * boresight));
        let [heading, pitch, roll] = Pose { place_m: place, turn }.angles();
        for (at, number) in [place.x, place.y, place.z, heading, pitch, roll].into_iter().enumerate() {
            if let Some(place) = places.get(at) {
                readings[*place].1[pose] = number;
            }
        }
    }
    subject.difference(&subject.shown_at(&readings, subject.poses.count, &subject.without_errors())?)
}
