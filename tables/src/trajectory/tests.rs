//! Poses by time, rows that they join, and records that move.

use std::sync::Arc;

use approx::assert_abs_diff_eq;
use nalgebra::{Rotation3, Vector3};

use super::{COLUMNS, Geodetic, Join, Joined, NotThere, Trajectory, moved, turned};
use crate::formats::sbet::{Record, encoded};
use crate::formats::{Cells, DataError, Form, Options, TableReader, Wanted, open};

/// A record at a time, at an angle of latitude from 48°, with roll, pitch and heading.
fn record(time: f64, latitude: f64, angles: [f64; 3]) -> Record {
    let [roll, pitch, heading] = angles;
    let wander = 0.01;
    let mut record = [0.5; 17];
    record[..4].copy_from_slice(&[time, 48_f64.to_radians() + latitude, 0.2, 300.0]);
    record[7..11].copy_from_slice(&[roll, pitch, heading + wander, wander]);
    record
}

fn bytes(records: &[Record]) -> Vec<u8> {
    records.iter().flat_map(encoded).collect()
}

fn trajectory(records: &[Record]) -> Result<Trajectory, DataError> {
    let mut reader = open(bytes(records), "drive.sbet", &Options::default())?;
    Trajectory::read(&mut *reader, None, &Options::default())
}

#[test]
fn between_two_records_go_straight_and_turn_the_short_way() {
    let records = [record(10.0, 0.0, [0.0, 0.0, 3.1]), record(10.1, 1e-6, [0.2, 0.0, -3.1])];
    let trajectory = trajectory(&records).expect("two records");
    let halfway = trajectory.at(10.05, 0.1).expect("between");
    // The radius of curvature along the meridian at 48° is 6 370 734 m, and 300 m above.
    assert_abs_diff_eq!(halfway.place_m, Vector3::new(0.0, 3.185_5, 0.0), epsilon = 1e-3);
    let [heading, pitch, roll] = halfway.angles();
    assert_abs_diff_eq!(heading.abs(), std::f64::consts::PI, epsilon = 1e-2);
    assert_abs_diff_eq!(pitch, 0.0, epsilon = 1e-2);
    assert_abs_diff_eq!(roll, 0.1, epsilon = 1e-2);
    assert_eq!(trajectory.at(10.05, 0.05), Err(NotThere::Gap(10.0, 10.1)));
    for time in [9.999, 10.100_001, f64::NAN] {
        assert_eq!(trajectory.at(time, 0.1), Err(NotThere::Outside));
    }
}

/// At 1 km to the north, level there is not level here: by 1 km over the radius of curvature.
#[test]
fn attitudes_are_those_of_the_place_and_come_in_the_frame_of_the_origin() {
    let records = [record(1.0, 0.0, [0.0; 3]), record(1.1, 1e-3, [0.0; 3])];
    let trajectory = trajectory(&records).expect("two records");
    let [_, pitch, _] = trajectory.at(1.1, 1.0).expect("the last record").angles();
    assert_abs_diff_eq!(pitch, -1e-3, epsilon = 1e-9);
}

#[test]
fn rows_have_the_poses_of_their_times_beside_their_own_columns() {
    let records = [record(10.0, 0.0, [0.1, 0.2, 0.3]), record(10.1, 0.0, [0.1, 0.2, 0.3])];
    let trajectory = Arc::new(trajectory(&records).expect("two records"));
    let join = |offset_s| Join { time: "t".to_owned(), offset_s, gap_s: 0.1 };
    let text = "t [ms],wall\n20,a\n70,b\n";
    let points = || open(text.as_bytes().to_vec(), "points.csv", &Options::default()).expect("a table");
    let mut joined = Joined::new(points(), Arc::clone(&trajectory), join(10.0)).expect("joined");
    assert_eq!(joined.header().len(), 2 + COLUMNS.len());
    let wanted = [(5, Form::Number(1.0)), (1, Form::Label), (6, Form::Number(1.0)), (7, Form::Number(1.0))];
    let chunk = joined.read(&wanted.map(|(column, form)| Wanted { column, form }), 100).expect("two rows");
    let Cells::Labels(walls) = &chunk.columns[1] else { unreachable!("labels were wanted") };
    assert_eq!(walls, &["a", "b"]);
    for (column, expected) in [(0, 0.3), (2, 0.2), (3, 0.1)] {
        let Cells::Numbers(numbers) = &chunk.columns[column] else { unreachable!("numbers were wanted") };
        assert_abs_diff_eq!(numbers[..], [expected; 2][..], epsilon = 1e-12);
    }
    let mut apart = Joined::new(points(), Arc::clone(&trajectory), join(0.0)).expect("joined");
    let said = apart.read(&[Wanted { column: 2, form: Form::Number(1.0) }], 100).expect_err("no overlap");
    let said = said.to_string();
    assert!(
        said.starts_with("points.csv: line 2, row 1: its time 0.02 s is outside of drive.sbet."),
        "{said}"
    );
    assert!(
        said.contains("2 of 2 rows are outside. The last point comes 9.93 s before the first record."),
        "{said}"
    );
    let twice = open(b"t,roll\n1,2\n".to_vec(), "points.csv", &Options::default()).expect("a table");
    let refused = Joined::new(twice, trajectory, join(0.0)).err().map(|error| error.to_string());
    assert!(
        refused.is_some_and(|said| said.contains("column `roll` has the name of one that drive.sbet brings"))
    );
}

/// A trajectory as separated values with the same columns reads as its records do.
#[test]
fn a_trajectory_may_be_a_table_of_texts() {
    let text = "time [s],latitude [deg],longitude [deg],height [m],roll [deg],pitch [deg],heading [deg]\n1,48,11,300,0,0,90\n1.1,48,11,301,0,0,90\n";
    let mut reader = open(text.as_bytes().to_vec(), "drive.csv", &Options::default()).expect("a table");
    let read = Trajectory::read(&mut *reader, None, &Options::default()).expect("two rows");
    let [latitude_rad, longitude_rad] = [48_f64, 11.0].map(f64::to_radians);
    assert_eq!(read.origin, Geodetic { latitude_rad, longitude_rad, height_m: 300.0 });
    assert_eq!(read.span(), [1.0, 1.1]);
}

#[test]
fn what_is_no_record_is_named() {
    let good = [record(1.0, 0.0, [0.0; 3]), record(2.0, 0.0, [0.0; 3])];
    let mut degrees = good;
    degrees[1][2] = 11.5;
    let mut none = good;
    none[0][8] = f64::NAN;
    let back = [good[1], good[0]];
    for (records, said) in [
        (&degrees, "drive.sbet: record 2: its longitude is 11.5, and SBET has radians"),
        (&none, "drive.sbet: record 1: its pitch is NaN"),
        (&back, "drive.sbet: record 2: its time 1.0 s is not later than 2.0 s"),
    ] {
        let error = trajectory(records).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.starts_with(said), "{error}");
    }
    let mut cut = bytes(&good);
    cut.truncate(200);
    let mut reader = open(cut, "drive.out", &Options::default()).expect("it begins as SBET");
    let error =
        Trajectory::read(&mut *reader, None, &Options::default()).err().map(|error| error.to_string());
    assert!(error.is_some_and(|error| error.contains("record 2: it has 64 of 136 bytes")));
}

#[test]
fn a_record_that_moves_there_and_back_is_the_same() {
    let given = record(5.0, 0.3, [0.1, -0.4, 3.0]);
    let (lever, boresight) = (Vector3::new(0.4, -1.2, 0.7), turned(0.02, -0.01, 0.03));
    let there = moved(&given, &lever, &boresight);
    let back: Rotation3<f64> = boresight.inverse();
    let again = moved(&there, &-(back * lever), &back);
    for (at, (given, again)) in given.iter().zip(&again).enumerate() {
        assert_abs_diff_eq!(given, again, epsilon = if at == 3 { 1e-8 } else { 1e-14 });
    }
    assert!((there[1] - given[1]).abs() > 1e-8 && there[10] == given[10]);
}
