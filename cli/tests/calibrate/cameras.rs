//! Sights from points of the chain: a camera on an arm by its pixels, and what is wrong with such studies. What was planted stands
//! in `examples/eye-in-hand/simulate.py`, which shares no code with ours.

use serde_json::Value;

use crate::figures::{calibrated, error, first_effect, holds};
use crate::support::{Folder, run_in};

const FOLDER: &str = "examples/eye-in-hand";

/// Error by error what was planted, rad, m, or a share.
const PLANTED: [(&str, f64); 10] = [
    ("zero2", 0.9e-3),
    ("zero3", -1.3e-3),
    ("length3", 0.6e-3),
    ("focal", 1.5e-3),
    ("eye_x", 0.8e-3),
    ("eye_y", -1.2e-3),
    ("eye_z", 0.5e-3),
    ("turn_x", 2.1e-3),
    ("turn_y", -1.4e-3),
    ("turn_z", 1.0e-3),
];

fn example(name: &str) -> Folder {
    let folder = Folder::new(name);
    for file in ["arm.chain", "marks.toml", "marks.csv"] {
        folder.copy(&format!("{FOLDER}/{file}"));
    }
    folder
}

#[test]
fn a_camera_on_an_arm_shows_its_mounting_and_the_encoder_off_centre() {
    let report = calibrated(&example("eye-in-hand"), "marks.toml");
    assert!(first_effect(&report).contains("encoder eccentricity of q3"), "{}", first_effect(&report));
    holds(&report, &PLANTED);
    // The noise is 0.12 of 1180 pixels in each direction, and less in the corners of the image.
    let held_out = report["after"]["held_out_rms"].as_f64().expect("a number");
    assert!(held_out < 1.05 * 2.0_f64.sqrt() * 0.12 / 1180.0, "{held_out}");
}

/// Three views of each mark leave 32 degrees of freedom; that is enough for what is there.
#[test]
fn three_views_of_a_mark_are_enough() {
    let folder = example("eye-in-hand-few");
    let text = folder.read("marks.csv");
    let mut views = std::collections::BTreeMap::new();
    let few: Vec<&str> = text
        .lines()
        .filter(|line| {
            let seen = views.entry(line.split(',').next().expect("a label").to_owned()).or_insert(0);
            *seen += 1;
            *seen <= 3
        })
        .collect();
    folder.write("marks.csv", few.join("\n") + "\n");
    let report = calibrated(&folder, "marks.toml");
    assert_eq!(report["fit"]["declared"]["how"], "converged");
    assert!(first_effect(&report).contains("encoder eccentricity of q3"), "{}", first_effect(&report));
}

/// A theodolite whose beam is a point at a range that nobody measures is one whose beam is a direction.
#[test]
fn a_beam_from_the_station_is_a_direction() {
    let folder = Folder::new("theodolite-beam");
    for file in ["theodolite.chain", "sights.toml", "sights.csv"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    let one = calibrated(&folder, "sights.toml");
    let chain = folder.read("theodolite.chain");
    let from = "observe sight: direction(0, 1, 0) of sight;";
    let to = "input range: length;\n    observe sight: point(0, range, 0) of sight;";
    assert!(chain.contains(from));
    folder.write("theodolite.chain", chain.replace(from, to));
    let other = calibrated(&folder, "sights.toml");
    for report in [&one, &other] {
        assert!(first_effect(report).contains("encoder eccentricity of azimuth"), "{}", first_effect(report));
    }
    for own in one["errors"].as_array().expect("a list") {
        let name = own["name"].as_str().expect("a name");
        let [[a, sigma], [b, _]] = [error(&one, name), error(&other, name)];
        assert!((a - b).abs() < 0.02 * sigma, "{name}: {a} and {b} ± {sigma}");
    }
}

/// The ranges of a scanner left unread: its lengths grow with a room of which no length is known.
#[test]
fn directions_of_a_scanner_show_no_length() {
    let folder = Folder::new("scanner-sights");
    for file in ["scanner.chain", "targets.toml", "targets.csv", "walls.toml"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    let walls = folder.read("walls.toml");
    let (_, stations) = walls.split_once("[stations]").expect("rough poses");
    let study = folder.read("targets.toml").replace("\"target\"", "\"sight\"") + "\n[stations]" + stations;
    folder.write("sights.toml", &study);
    let run = run_in(&folder.0, &["calibrate", "sights.toml"], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("nothing holds the scale: `axes_apart`, `beam_aside`"), "{run}");
}

/// The amended declaration, calibrated again, is the same fit; a mark to be added is told with the range that it would be at.
#[test]
fn an_amended_camera_calibrated_again_finds_nothing_new() {
    let folder = example("eye-in-hand-again");
    let run = run_in(&folder.0, &["calibrate", "marks.toml", "--format", "json", "--out", "first"], "");
    let first: Value = serde_json::from_str(&run.stdout).expect("JSON");
    folder.write("arm.chain", folder.read("first/amended.chain"));
    folder.write("marks.toml", folder.read("marks.toml") + "\n[next]\nobjects = { sight = 1 }\nposes = 4\n");
    let again = calibrated(&folder, "marks.toml");
    assert_eq!(again["effects"].as_array().map(Vec::len), Some(0), "{}", again["effects"]);
    let [was, is] = [&first["after"], &again["before"]].map(|of| of["rms"].as_f64().expect("a number"));
    assert!((is / was - 1.0).abs() < 1e-5, "{was} and {is}");
    let readings = again["next_places"][0]["readings"].to_string();
    assert!(readings.contains("range") && readings.contains("q5"), "{readings}");
}

#[test]
fn what_is_wrong_with_a_camera_study_is_named() {
    let folder = example("eye-in-hand-wrong");
    let (chain, study) = (folder.read("arm.chain"), folder.read("marks.toml"));
    let refused = |chain: &str, study: &str, told: [&str; 2]| {
        folder.write("arm.chain", chain).write("marks.toml", study);
        let run = run_in(&folder.0, &["calibrate", "marks.toml"], "");
        assert_eq!(run.code, 2, "{run}");
        assert!(told.iter().all(|told| run.stderr.contains(told)), "{run}");
    };
    let ranged = study.replace("[observed]", "range = { column = \"u [px]\" }\n[observed]");
    refused(&chain, &ranged, ["a sight reads no `range`", "kind = \"target\""]);
    let (before, _) = chain.split_once("    observe sight").expect("it observes");
    let bare = format!("{before}    observe sight: point(0, 0, 0) of image;\n}}\n");
    let bare = bare
        .replace("*range), Tz(", "), Tz(")
        .replace("*range);", ");")
        .replace("    input range: length;\n", "");
    refused(&bare, &study, ["`sight` has no beam", "input range: length"]);
    let longer =
        chain.replace("position: Ty(0.6);", "position: Ty(0.6);\n        position_error: Ty(length2);");
    refused(&longer, &study, ["nothing holds the scale: `length2`, `length3`", "fix = { length2 = 0 }"]);
    // One view of each mark.
    let mut seen = std::collections::BTreeSet::new();
    let text = folder.read("marks.csv");
    let once: Vec<&str> =
        text.lines().filter(|line| seen.insert(line.split(',').next().map(str::to_owned))).collect();
    folder.write("marks.csv", once.join("\n") + "\n");
    refused(&chain, &study, ["`M1` do not say where it is", "beams do not cross"]);
}
