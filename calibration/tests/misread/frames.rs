//! Measured directions that stand in another frame, and instruments that only stand turned.

use calibration::diagnose::Verdict;
use calibration::misread::Reading;

use super::{MOUNT, calibrated, misread, mount_rows, plain_mount, table};

/// A direction turned about an axis: Rodrigues' formula.
fn turned(vector: [f64; 3], axis: [f64; 3], by_deg: f64) -> [f64; 3] {
    let (sin, cos) = by_deg.to_radians().sin_cos();
    let along: f64 = (0..3).map(|at| vector[at] * axis[at]).sum();
    std::array::from_fn(|at| {
        let (next, last) = ((at + 1) % 3, (at + 2) % 3);
        let beside = axis[next] * vector[last] - axis[last] * vector[next];
        vector[at] * cos + beside * sin + axis[at] * along * (1.0 - cos)
    })
}

/// The rows of the mount as someone has them whose sky is turned.
fn in_turned_sky(seed: u64, rows: usize, axis: [f64; 3], by_deg: f64) -> String {
    let mut all = mount_rows(seed, rows);
    for row in &mut all {
        let (azimuth, elevation) = (row[2].to_radians(), row[3].to_radians());
        let sight = [elevation.cos() * azimuth.sin(), elevation.cos() * azimuth.cos(), elevation.sin()];
        let [x, y, z] = turned(sight, axis, by_deg);
        [row[2], row[3]] = [x.atan2(y).to_degrees(), z.asin().to_degrees()];
    }
    table("a,e,ta,te", &all)
}

#[test]
fn a_clock_that_is_three_hours_off_turns_the_sky_about_the_pole() {
    let latitude = 48.0_f64.to_radians();
    let pole = [0.0, latitude.cos(), latitude.sin()];
    let made = calibrated(MOUNT, &plain_mount(), &in_turned_sky(541, 40, pole, 45.0));
    let found = misread(&made);
    let Reading::Frame { by_deg, axis, hours: Some(3) } = &found.readings[0].reading else {
        panic!("{found:?}")
    };
    assert!(found.readings.len() == 1 && found.readings[0].lines.is_empty());
    assert!((by_deg - 45.0).abs() < 0.1, "{by_deg}");
    // It turns back.
    let off: f64 = axis.iter().zip(pole).map(|(own, pole)| (own + pole).powi(2)).sum();
    assert!(off.sqrt() < 3e-3, "{axis:?}");
}

#[test]
fn an_instrument_whose_zero_is_declared_may_stand_turned() {
    let made = calibrated(MOUNT, &plain_mount(), &in_turned_sky(542, 40, [0.0, 0.0, 1.0], 37.0));
    assert!(made.diagnosis.verdict.is_usable(), "{:?}", made.diagnosis.cautions);
    let index = made.chain.find_symbol("azimuth_index").unwrap();
    let degrees = made.after.values[index.index()].to_degrees();
    assert!((degrees - 37.0).abs() < 0.1, "{degrees}");
}

#[test]
fn a_sky_that_is_turned_and_scrambled_is_not_explained_by_a_turn() {
    // Every other row is of another sky.
    let one = in_turned_sky(543, 40, [1.0, 0.0, 0.0], 60.0);
    let other = in_turned_sky(543, 40, [0.6, 0.0, 0.8], -50.0);
    let lines = one.lines().zip(other.lines()).enumerate();
    let mixed: Vec<&str> = lines.map(|(at, (one, other))| if at % 2 == 0 { one } else { other }).collect();
    let made = calibrated(MOUNT, &plain_mount(), &(mixed.join("\n") + "\n"));
    assert!(!made.diagnosis.verdict.is_usable(), "{:?}", made.diagnosis.verdict);
    assert_ne!(made.diagnosis.verdict, Verdict::ColumnMisread, "{:?}", made.diagnosis.cautions);
}

/// Who says that a tilt of 40 degrees is plausible is shown it.
#[test]
fn a_tilt_that_the_study_takes_for_plausible_is_one() {
    let tilted = in_turned_sky(544, 40, [1.0, 0.0, 0.0], 20.0);
    let told = calibrated(MOUNT, &plain_mount(), &tilted);
    // The tilt fits as well as the turn does.
    assert_eq!(told.diagnosis.verdict, Verdict::ColumnMisread, "{:?}", told.diagnosis.cautions);
    assert!(told.amended.is_none());
    let allowed = plain_mount() + "[fit]\nplausible = { tilt_x = '40 deg', tilt_y = '40 deg' }\n";
    let made = calibrated(MOUNT, &allowed, &tilted);
    assert!(made.diagnosis.verdict.is_usable(), "{:?}", made.diagnosis.cautions);
    let tilt = made.chain.find_symbol("tilt_x").unwrap();
    assert!((made.after.values[tilt.index()].to_degrees() - 20.0).abs() < 0.1);
}
