//! Studies whose columns are not what they say, from simulators that share no code with what they test.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    missing_docs,
    reason = "a test may say what it measured, and fail loudly"
)]

mod frames;
mod sky;

use std::f64::consts::PI;

use calibration::calibrate::Calibration;
use calibration::diagnose::{Caution, Verdict};
use calibration::misread::{Misread, Reading};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use study::Study;

const MOUNT: &str = include_str!("../../../examples/course/mount.chain");
const ARM: &str = "chain Arm {
    const l2: length = 0.5;
    const l3: length = 0.4;
    body shoulder on ground { position_error: Tx(x0), Ty(y0), Tz(z0); motion: Rz(q1); motion_error: Rz(i1); }
    body upper on shoulder { position_error: Rx(s2); motion: Ry(q2); motion_error: Ry(i2); position: Tx(l2); position_error: Tx(d2); }
    body fore on upper { position_error: Rx(s3); motion: Ry(q3); motion_error: Ry(i3); position: Tx(l3); position_error: Tx(d3); }
    observe tip: point(0, 0, 0) of fore;
}";

/// A uniform number.
fn between(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

/// About normal: the sum of twelve uniform numbers.
fn noise(random: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0
}

/// Rows of an alt-azimuth mount in degrees: azimuth and elevation by the encoders, then as they truly are. The axis leans, the encoders have
/// indices, the telescope is not square to its axis.
fn mount_rows(seed: u64, rows: usize) -> Vec<[f64; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let arcsec = PI / 648_000.0;
    let (lean_east, lean_north) = (30.0 * arcsec, -45.0 * arcsec);
    let (az_index, el_index, collimation) = (60.0 * arcsec, -80.0 * arcsec, 25.0 * arcsec);
    let row = |_| {
        let (azimuth, elevation) =
            (between(&mut random, 0.02, 2.0 * PI - 0.02), between(&mut random, 0.2, 1.3));
        let true_azimuth = azimuth
            + az_index
            + collimation / elevation.cos()
            + elevation.tan() * (lean_east * azimuth.cos() - lean_north * azimuth.sin());
        let true_elevation = elevation + el_index - lean_east * azimuth.sin() - lean_north * azimuth.cos();
        let spread = 5.0 * arcsec;
        let (across, along) = (noise(&mut random) * spread, noise(&mut random) * spread);
        let measured_azimuth = true_azimuth + across / elevation.cos();
        [azimuth, elevation, measured_azimuth, true_elevation + along].map(f64::to_degrees)
    };
    (0..rows).map(row).collect()
}

/// Rows of the arm: joints in degrees, the tip in metres.
fn arm_rows(seed: u64, rows: usize) -> Vec<[f64; 6]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let row = |_| {
        let joints = [
            between(&mut random, -3.0, 3.0),
            between(&mut random, -1.2, 1.2),
            between(&mut random, -1.5, 1.5),
        ];
        let [q1, q2, q3] = joints;
        // About y a positive turn brings x down; the upper arm is 0.3 mm too long, the elbow 1 mrad off.
        let (pitch, elbow) = (q2, q2 + q3 + 1e-3);
        let reach = 0.5003 * pitch.cos() + 0.4 * elbow.cos();
        let height = -0.5003 * pitch.sin() - 0.4 * elbow.sin();
        let mut spread = || 3e-5 * noise(&mut random);
        let tip = [reach * q1.cos() + spread(), reach * q1.sin() + spread(), height + spread()];
        [q1.to_degrees(), q2.to_degrees(), q3.to_degrees(), tip[0], tip[1], tip[2]]
    };
    (0..rows).map(row).collect()
}

fn table<const N: usize>(header: &str, rows: &[[f64; N]]) -> String {
    let line = |row: &[f64; N]| row.map(|number| format!("{number:.12}")).join(",");
    rows.iter().map(line).fold(header.to_owned(), |text, line| text + "\n" + &line) + "\n"
}

fn calibrated(chain: &str, study: &str, data: &str) -> Calibration {
    let study = Study::from_text(study).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut open = |_: &str| Ok(data.to_owned().into_bytes().into());
    Calibration::of(chain, &study, &mut open, "2026-11-27").unwrap()
}

fn mount_study(columns: &str, observed: &str) -> String {
    format!(
        "chain = 'mount.chain'\ndata = 'rows.csv'\n[columns]\n{columns}\n[observed]\nkind = 'spherical'\n{observed}\n[hold_out]\nfolds = 2\n"
    )
}

fn plain_mount() -> String {
    mount_study(
        "azimuth = { column = 'a', unit = 'deg' }\nelevation = { column = 'e', unit = 'deg' }",
        "azimuth = { column = 'ta', unit = 'deg' }\nelevation = { column = 'te', unit = 'deg' }",
    )
}

fn arm_study(unit: &str, joints: &str) -> String {
    format!(
        "chain = 'arm.chain'\ndata = 'rows.csv'\n[columns]\n{joints}\n[observed]\nkind = 'point'\nx = {{ column = 'x', unit = '{unit}' }}\ny = {{ column = 'y', unit = '{unit}' }}\nz = {{ column = 'z', unit = '{unit}' }}\n[hold_out]\nfolds = 2\n"
    )
}

const DEGREES: &str = "q1 = { column = 'q1', unit = 'deg' }\nq2 = { column = 'q2', unit = 'deg' }\nq3 = { column = 'q3', unit = 'deg' }";

/// The misread columns of a calibration, held to what follows from them: no declaration is written, and nothing is found.
fn misread(calibration: &Calibration) -> &Misread {
    let diagnosis = &calibration.diagnosis;
    assert_eq!(diagnosis.verdict, Verdict::ColumnMisread, "{:?}", diagnosis.cautions);
    assert!(calibration.amended.is_none() && diagnosis.effects.is_empty());
    let found = diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::ColumnMisread(misread) => Some(misread),
        _ => None,
    });
    let found = found.unwrap();
    assert!(found.after < found.before, "{found:?}");
    found
}

#[test]
fn columns_that_are_right_are_not_called_misread() {
    let right = calibrated(MOUNT, &plain_mount(), &table("a,e,ta,te", &mount_rows(501, 120)));
    assert!(right.diagnosis.verdict.is_usable(), "{:?}", right.diagnosis.cautions);
    let right = calibrated(ARM, &arm_study("m", DEGREES), &table("q1,q2,q3,x,y,z", &arm_rows(502, 60)));
    assert!(right.diagnosis.verdict.is_usable(), "{:?}", right.diagnosis.cautions);
}

#[test]
fn millimetres_taken_for_metres_are_told() {
    let mut rows = arm_rows(511, 60);
    rows.iter_mut().for_each(|row| row[3..].iter_mut().for_each(|length| *length *= 1e3));
    let made = calibrated(ARM, &arm_study("m", DEGREES), &table("q1,q2,q3,x,y,z", &rows));
    let Reading::Unit { columns, is, read } = &misread(&made).readings[0].reading else { panic!("a unit") };
    assert_eq!((columns.join(" ").as_str(), *is, *read), ("x y z", "mm", Some("m")));
}

#[test]
fn gon_taken_for_degrees_are_told_and_the_line_to_write_mends_it() {
    let mut rows = mount_rows(521, 120);
    rows.iter_mut().for_each(|row| row[..2].iter_mut().for_each(|angle| *angle /= 0.9));
    let data = table("a,e,ta,te", &rows);
    let made = calibrated(MOUNT, &plain_mount(), &data);
    let found = misread(&made);
    let lines: Vec<&str> = found.readings[0].lines.iter().map(|line| line.text.as_str()).collect();
    assert_eq!(
        lines,
        ["azimuth = { column = \"a\", unit = \"gon\" }", "elevation = { column = \"e\", unit = \"gon\" }"]
    );
    let mended = mount_study(
        &lines.join("\n"),
        "azimuth = { column = 'ta', unit = 'deg' }\nelevation = { column = 'te', unit = 'deg' }",
    );
    assert!(calibrated(MOUNT, &mended, &data).diagnosis.verdict.is_usable());
}

#[test]
fn headings_that_state_another_unit_are_what_is_to_be_mended() {
    let study = mount_study(
        "azimuth = { column = 'a [deg]' }\nelevation = { column = 'e [deg]' }",
        "azimuth = { column = 'ta', unit = 'deg' }\nelevation = { column = 'te', unit = 'deg' }",
    );
    let rows = mount_rows(521, 80);
    let right = calibrated(MOUNT, &study, &table("a [deg],e [deg],ta,te", &rows));
    assert!(right.diagnosis.verdict.is_usable(), "{:?}", right.diagnosis.cautions);
    let in_gon: Vec<[f64; 4]> = rows.iter().map(|[a, e, ta, te]| [a / 0.9, e / 0.9, *ta, *te]).collect();
    let made = calibrated(MOUNT, &study, &table("a [deg],e [deg],ta,te", &in_gon));
    let first = &misread(&made).readings[0];
    assert!(matches!(&first.reading, Reading::Unit { is: "gon", .. }), "{first:?}");
    assert!(first.lines.is_empty(), "{first:?}");
    let wanted = ["a [deg]", "e [deg]"].map(|heading| (heading, "gon"));
    let headings: Vec<_> = first.headings.iter().map(|own| (own.heading.as_str(), own.is)).collect();
    assert_eq!(headings, wanted);
}

#[test]
fn packed_minutes_and_seconds_are_told_and_the_line_to_write_mends_them() {
    let packed = |degrees: f64| {
        let hundredths = (degrees.abs() * 360_000.0).round();
        let (whole, rest) = ((hundredths / 360_000.0).floor(), hundredths % 360_000.0);
        let (minutes, seconds) = ((rest / 6_000.0).floor(), rest % 6_000.0 / 100.0);
        (whole + minutes / 100.0 + seconds / 10_000.0).copysign(degrees)
    };
    let rows: Vec<[f64; 4]> = mount_rows(531, 120).iter().map(|row| row.map(packed)).collect();
    let data = table("a,e,ta,te", &rows);
    let made = calibrated(MOUNT, &plain_mount(), &data);
    let Reading::Packed { columns, notation } = &misread(&made).readings[0].reading else { panic!("packed") };
    assert_eq!((columns.len(), *notation), (4, "ddd.mmss"));
    let mended = mount_study(
        "azimuth = { column = 'a', notation = 'ddd.mmss' }\nelevation = { column = 'e', notation = 'ddd.mmss' }",
        "azimuth = { column = 'ta', notation = 'ddd.mmss' }\nelevation = { column = 'te', notation = 'ddd.mmss' }",
    );
    assert!(calibrated(MOUNT, &mended, &data).diagnosis.verdict.is_usable());
}

#[test]
fn exchanged_reversed_and_shifted_columns_are_told_and_their_lines_mend_them() {
    let rows = mount_rows(541, 120);
    let observed = "azimuth = { column = 'ta', unit = 'deg' }\nelevation = { column = 'te', unit = 'deg' }";
    let exchanged: Vec<[f64; 4]> = rows.iter().map(|&[a, e, ta, te]| [e, a, ta, te]).collect();
    let reversed: Vec<[f64; 4]> = rows.iter().map(|&[a, e, ta, te]| [-a, e, ta, te]).collect();
    let shifted: Vec<[f64; 4]> =
        rows.windows(2).map(|pair| [pair[1][0], pair[1][1], pair[0][2], pair[0][3]]).collect();
    for (what, rows) in [("exchanged", exchanged), ("reversed", reversed), ("shifted", shifted)] {
        let data = table("a,e,ta,te", &rows);
        let made = calibrated(MOUNT, &plain_mount(), &data);
        let found = misread(&made);
        let said = match &found.readings[0].reading {
            Reading::Exchanged { .. } => "exchanged",
            Reading::Reversed { column } if column == "a" => "reversed",
            Reading::Shifted { by: 1, .. } => "shifted",
            other => panic!("{what}: {other:?}"),
        };
        assert_eq!(said, what);
        let own: Vec<&str> = found.readings[0].lines.iter().map(|line| line.text.as_str()).collect();
        let kept = ["azimuth", "elevation"].iter().zip(["a", "e"]);
        let kept = kept.filter(|(key, _)| !own.iter().any(|line| line.starts_with(**key)));
        let kept: Vec<String> =
            kept.map(|(key, column)| format!("{key} = {{ column = '{column}', unit = 'deg' }}")).collect();
        let columns = format!("{}\n{}", own.join("\n"), kept.join("\n"));
        let mended = calibrated(MOUNT, &mount_study(&columns, observed), &data);
        assert!(mended.diagnosis.verdict.is_usable(), "{what}: {:?}", mended.diagnosis.cautions);
    }
}

#[test]
fn values_that_no_small_error_has_withhold_the_correction() {
    // A mount whose telescope is 12 degrees off its axis: no declaration of small errors means that.
    let mut rows = mount_rows(551, 120);
    rows.iter_mut().for_each(|row| row[2] += 12.0 / row[1].to_radians().cos());
    let rows: Vec<[f64; 4]> = rows.into_iter().filter(|row| row[1] < 60.0).collect();
    let data = table("a,e,ta,te", &rows);
    let made = calibrated(MOUNT, &plain_mount(), &data);
    assert!(!made.diagnosis.verdict.is_usable());
    assert!(made.amended.is_none());
    let is_told =
        |caution: &Caution| matches!(caution, Caution::Implausible { .. } | Caution::ColumnMisread(_));
    assert!(made.diagnosis.cautions.iter().any(is_told), "{:?}", made.diagnosis.cautions);
}

/// Walls seen by a scanner whose declaration turns its trunnion axis by eight degrees, which the scanner of these data does not.
#[test]
fn a_tilt_that_nobody_makes_is_withheld_beside_unknown_walls_too() {
    let text = |name: &str| std::fs::read_to_string(format!("../examples/objects/{name}")).unwrap();
    let chain = text("scanner.chain");
    let turned =
        chain.replacen("body mirror on alidade {", "body mirror on alidade {\n position: Ry(-8 deg);", 1);
    let [study, data] = ["walls.toml", "walls.csv"].map(text);
    let as_it_is = calibrated(&chain, &study, &data);
    assert!(as_it_is.diagnosis.verdict.is_usable(), "{:?}", as_it_is.diagnosis.cautions);
    let made = calibrated(&turned, &study, &data);
    assert!(!made.diagnosis.verdict.is_usable() && made.amended.is_none());
    let names = |caution: &Caution| match caution {
        Caution::Implausible { values } => format!("{values:?}"),
        _ => String::new(),
    };
    let told: String = made.diagnosis.cautions.iter().map(names).collect();
    assert!(told.contains("trunnion"), "{:?}", made.diagnosis.cautions);
}

#[test]
fn keys_that_say_how_a_column_is_written_are_checked() {
    for (column, complaint) in [
        ("{ column = 'a', unit = 'deg', sign = 2 }", "`sign` is 2"),
        ("{ column = 'a', notation = 'dms' }", "`dms` is an unknown notation"),
        ("{ column = 'a', unit = 'deg', notation = 'ddd.mmss' }", "is a unit already"),
        ("{ column = 'a', unit = 'deg', shift = 100000 }", "`shift` is 100000"),
    ] {
        let columns = format!("azimuth = {column}\nelevation = {{ column = 'e', unit = 'deg' }}");
        let study = Study::from_text(&mount_study(&columns, "azimuth = 'ta'\nelevation = 'te'")).unwrap();
        let chain = model_core::Chain::from_text(MOUNT).unwrap();
        let mistakes = match study.plan(&chain) {
            Err(mistakes) => mistakes.to_string(),
            Ok(_) => panic!("{column} is accepted"),
        };
        assert!(mistakes.contains(complaint), "{column}: {mistakes}");
    }
    let derived =
        "azimuth = { derive = 'direction(e)', sign = -1 }\nelevation = { column = 'e', unit = 'deg' }";
    let mistakes = Study::from_text(&mount_study(derived, "azimuth = 'ta'\nelevation = 'te'")).unwrap_err();
    assert!(mistakes.to_string().contains("no sign, offset, notation or shift"), "{mistakes}");
}
