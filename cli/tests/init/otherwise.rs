//! Columns that are not what their headers say: the study that is begun reads them as the rows ask for, and says so.

use std::f64::consts::PI;
use std::fmt::Write as _;

use testkit::Random;

use crate::support::Folder;

/// Directions of a telescope in azimuth and elevation, rad, with tilts and noise of arcseconds.
fn rows(mut each: impl FnMut(f64, f64) -> [f64; 2]) -> String {
    let random = &mut Random::new(411);
    let mut text = String::from("azimuth,elevation,x,y,z\n");
    for _ in 0..60 {
        let (azimuth, elevation) = (PI * (2.0 * random.even() - 1.0), 0.3 + random.even());
        let [read_azimuth, read_elevation] = each(azimuth, elevation);
        let (lifted, turned) = (elevation + 2e-4 * azimuth.cos(), azimuth + 1e-4);
        let mut aim = [lifted.cos() * turned.sin(), lifted.cos() * turned.cos(), lifted.sin()];
        aim.iter_mut().for_each(|value| *value += 1e-5 * random.normal());
        let [x, y, z] = aim;
        writeln!(text, "{read_azimuth:.6},{read_elevation:.6},{x:.9},{y:.9},{z:.9}").expect("a string");
    }
    text
}

#[test]
fn gon_in_columns_without_a_unit_is_read_as_gon_and_said() {
    let folder = Folder::new("init-gon");
    folder.write(
        "d.csv",
        rows(|azimuth, elevation| [azimuth.to_degrees() / 0.9, elevation.to_degrees() / 0.9]),
    );
    let run = folder.trueaxis(&["init", "d.csv"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("gon, not deg") && run.stderr.contains("The study is written so."), "{run}");
    let study = folder.read("d.toml");
    let comment = study.lines().find(|line| line.starts_with("# ") && line.contains("gon, not deg"));
    assert!(comment.is_some(), "{study}");
    assert_eq!(study.matches("unit = \"gon\"").count(), 2, "{study}");
    let run = folder.trueaxis(&["calibrate", "d.toml"]);
    assert!(run.code == 0 && !run.stdout.contains("COLUMN"), "{run}");
}

#[test]
fn columns_that_are_what_they_say_are_left_alone() {
    let folder = Folder::new("init-degrees");
    folder.write("d.csv", rows(|azimuth, elevation| [azimuth, elevation].map(f64::to_degrees)));
    let run = folder.trueaxis(&["init", "d.csv"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(!run.stderr.contains("written so") && !folder.read("d.toml").contains("gon"), "{run}");
}

#[test]
fn exchanged_headings_are_read_right_though_directions_do_not_follow_them() {
    let folder = Folder::new("init-exchanged");
    folder.write("d.csv", rows(|azimuth, elevation| [elevation, azimuth].map(f64::to_degrees)));
    let run = folder.trueaxis(&["init", "d.csv"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("exchanged") && run.stderr.contains("The study is written so."), "{run}");
    let run = folder.trueaxis(&["calibrate", "d.toml"]);
    assert!(run.code == 0 && !run.stdout.contains("COLUMN"), "{run}");
}

#[test]
fn directions_that_follow_the_readings_in_no_way_begin_nothing() {
    let folder = Folder::new("init-scattered");
    let random = &mut Random::new(97);
    folder.write("d.csv", rows(|_, _| [360.0 * random.even(), 80.0 * random.even()]));
    let run = folder.trueaxis(&["init", "d.csv"]);
    assert!(run.code == 2 && run.stderr.contains("do not follow"), "{run}");
    assert_eq!(folder.names(), ["d.csv"]);
}
