//! Points that stay on circles and spheres that nobody surveyed. What was planted stands in
//! `examples/objects/simulate_wires_and_sights.py`, which shares no code with ours.

use std::fmt::Write;

use crate::figures::{calibrated, holds};
use crate::support::{Folder, run_in};

/// The arm's errors.
const PLANTED: [(&str, f64); 5] =
    [("zero2", 0.8e-3), ("length2", 0.7e-3), ("zero3", -1.1e-3), ("length3", -0.5e-3), ("aside", 0.9e-3)];

fn cranks(name: &str) -> Folder {
    let folder = Folder::new(name);
    for file in ["arm.chain", "rings.toml", "rings.csv"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    folder
}

/// Circles of known radius hold the scale: every length of the arm is estimated. Which of three causes turns the shoulder they do not
/// say, and the report does not either.
#[test]
fn cranks_of_known_radius_show_the_arm_with_its_lengths() {
    let report = calibrated(&cranks("cranks"), "rings.toml");
    let causes = report["effects"][0].to_string();
    assert!(causes.contains("encoder eccentricity of q2") && causes.contains("gravity"), "{causes}");
    assert_eq!(report["effects"].as_array().map(Vec::len), Some(1));
    holds(&report, &PLANTED);
}

/// Circles whose radius nobody knows show no scale: with the upper arm taken as declared, 0.6 m in place of 0.6007 m, the forearm
/// comes out as much too short.
#[test]
fn cranks_of_unknown_radius_show_the_arm_but_for_its_scale() {
    let folder = cranks("cranks-free");
    let study = folder.read("rings.toml");
    let (free, _) = study.split_once("radius = {").expect("it names the radius");
    folder.write("free.toml", free);
    let run = run_in(&folder.0, &["calibrate", "free.toml"], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("nothing holds the scale: `length2`, `length3`, `aside`"), "{run}");
    folder.write("held.toml", format!("{free}[fit]\nfix = {{ length2 = 0 }}\n"));
    let report = calibrated(&folder, "held.toml");
    let scale = 0.6 / 0.6007;
    holds(&report, &[("length3", 0.4995 * scale - 0.5), ("aside", 0.9e-3 * scale), ("zero3", -1.1e-3)]);
}

/// Diameters for radii, and radii in another unit than is written, are told, and nothing is corrected with what comes of them.
#[test]
fn radii_that_are_read_wrongly_are_told() {
    let folder = cranks("cranks-radii");
    let rows = folder.read("rings.csv");
    let (head, rows) = rows.split_once('\n').expect("a heading");
    for (factor, told) in [(2.0, "the radii are doubled"), (1e-3, "the radii are in m and read as mm")] {
        let mut wrong = format!("{head}\n");
        for row in rows.lines() {
            let (readings, radius) = row.rsplit_once(',').expect("a radius");
            let radius = factor * radius.parse::<f64>().expect("a number");
            writeln!(wrong, "{readings},{radius}").expect("a string");
        }
        folder.write("rings.csv", wrong);
        let run = run_in(&folder.0, &["calibrate", "rings.toml"], "");
        let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(told) && !text.contains("Correct with it now"), "{run}");
    }
}

/// A sphere of known radius is a distance from its centre; of an unknown one it shows no scale.
#[test]
fn a_sphere_is_a_distance_from_its_centre() {
    let folder = Folder::new("spheres");
    for file in ["arm.chain", "bars.toml", "bars.csv"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    let study = folder.read("bars.toml");
    let sphere = study.replace("\"distance\"", "\"sphere\"").replace("length = ", "radius = ");
    folder.write("sphere.toml", &sphere);
    let [one, other] = ["bars.toml", "sphere.toml"].map(|study| calibrated(&folder, study));
    assert_eq!(one["errors"], other["errors"]);
    let free: String =
        sphere.lines().filter(|line| !line.starts_with("radius")).map(|line| format!("{line}\n")).collect();
    folder.write("free.toml", free.split("[objects]").next().expect("a part"));
    let run = run_in(&folder.0, &["calibrate", "free.toml"], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("nothing holds the scale"), "{run}");
}

/// Where nobody knows the objects, a scale may be of the joints or of the lengths: rows fit either, and points lie elsewhere.
#[test]
fn causes_that_fit_alike_are_not_said_to_correct_alike() {
    let run = run_in(&cranks("cranks-causes").0, &["calibrate", "rings.toml"], "");
    assert_eq!(run.code, 0, "{run}");
    let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("place and size of everything may differ: nobody knows those of the objects"),
        "{run}"
    );
    assert!(!text.contains("same correction") && !text.contains("The correction is the same"), "{run}");
}

#[test]
fn what_is_wrong_with_a_study_of_circles_is_named() {
    let folder = cranks("cranks-wrong");
    let (study, table) = (folder.read("rings.toml"), folder.read("rings.csv"));
    let refused = |study: &str, table: &str, told: [&str; 2]| {
        folder.write("rings.toml", study).write("rings.csv", table);
        let run = run_in(&folder.0, &["calibrate", "rings.toml"], "");
        assert_eq!(run.code, 2, "{run}");
        assert!(told.iter().all(|told| run.stderr.contains(told)), "{run}");
    };
    let start: Vec<&str> = table.lines().take(3).collect();
    refused(&study, &(start.join("\n") + "\n"), ["`C1` do not say where it is", "spread along the circle"]);
    refused(&study, &table.replacen(",250\n", ",-250\n", 1), ["is negative", "line 2"]);
    let next = format!("{study}\n[next]\nposes = 4\n");
    refused(&next, &table, ["where to measure next is not told", "kind \"circle\""]);
    refused(
        &study.replace("radius = {", "length = {"),
        &table,
        ["`length` is no column of this kind", "write another kind"],
    );
}
