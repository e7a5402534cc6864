//! Robot arms whose ball sits in unknown sockets: measured data, each robot's rows by themselves.

use std::fmt::Write;

use serde_json::Value;

use crate::figures::{calibrated, cautions};
use crate::support::{Folder, run_in};
use testkit::Random;

const STUDY: &str = "examples/ball-sockets/panda.toml";

/// A folder with the example and the rows of one robot under the name that the study asks for; `None` where the data are missing.
fn robot(name: &str, folder: &str) -> Option<Folder> {
    let text = std::fs::read_to_string(testkit::measured("ball-sockets.csv")?).expect("text");
    let mut lines = text.lines();
    let header = lines.next().expect("a header");
    let own: Vec<&str> = lines.filter(|line| line.split(',').next() == Some(name)).collect();
    let folder = Folder::new(folder);
    let rows: Vec<&str> = std::iter::once(header).chain(own.iter().copied()).collect();
    // The sockets of a stand are 50 mm apart: what is in the second is that far from the first.
    let apart = own.iter().filter_map(|line| {
        let mut cells: Vec<&str> = line.split(',').collect();
        (cells[2] == "1").then(|| {
            cells[2] = "0";
            format!("{},0.05", cells.join(","))
        })
    });
    let apart: Vec<String> = std::iter::once(format!("{header},apart [m]")).chain(apart).collect();
    folder.copy(STUDY).copy("examples/ball-sockets/scale.toml").copy("examples/ball-sockets/panda.chain");
    folder.write("robot.csv", rows.join("\n") + "\n").write("apart.csv", apart.join("\n") + "\n");
    Some(folder)
}

fn number(report: &Value, path: &str) -> f64 {
    report.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {path}"))
}

/// Bounds in mm on placements never seen, of every row: those of an independent analysis of the same rows, for declared errors by
/// least squares and with what a search adds.
#[test]
fn an_arm_is_calibrated_by_sockets_that_nobody_measured() {
    for (name, rows, declared_mm, amended_mm) in
        [("panda_1", 182.0, 0.869, 0.582), ("panda_4", 269.0, 0.261, 0.244)]
    {
        let Some(folder) = robot(name, &format!("sockets-{name}")) else { return };
        let report = calibrated(&folder, "panda.toml");
        assert_eq!(number(&report, "/observations/rows"), rows, "{name}");
        folder.write("squares.toml", folder.read("panda.toml").replace("[fit]\n", "[fit]\nrobust = false\n"));
        let squares = calibrated(&folder, "squares.toml");
        let before = number(&squares, "/before/held_out_rms") * 1e3;
        let after = number(&report, "/after/held_out_rms") * 1e3;
        assert!(before <= declared_mm && after <= amended_mm, "{name}: {before} and {after} mm");
    }
}

/// What is found is declared as large as errors may be: the amended declaration, calibrated again, is the same fit, and nothing new is
/// found.
#[test]
fn an_amended_arm_calibrated_again_is_the_same_fit() {
    let Some(folder) = robot("panda_4", "sockets-again") else { return };
    folder.write("squares.toml", folder.read("panda.toml").replace("[fit]\n", "[fit]\nrobust = false\n"));
    let run = run_in(&folder.0, &["calibrate", "squares.toml", "--format", "json", "--out", "first"], "");
    let first: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert!(first["effects"].as_array().is_some_and(|found| !found.is_empty()), "{run}");
    folder.write("panda.chain", folder.read("first/amended.chain"));
    let again = calibrated(&folder, "squares.toml");
    let [was, is] = [(&first, "/after/rms"), (&again, "/before/rms")].map(|(of, at)| number(of, at));
    assert!((is / was - 1.0).abs() < 1e-6, "{was} and {is}");
    assert_eq!(first.pointer("/fit/rank"), again.pointer("/fit/rank"));
    assert_eq!(again["effects"].as_array().map(Vec::len), Some(0));
}

/// The stand's known distance shows the length of the upper arm, which all others are measured by without it.
#[test]
fn sockets_at_a_known_distance_hold_the_scale() {
    let Some(folder) = robot("panda_4", "sockets-scale") else { return };
    let report = calibrated(&folder, "scale.toml");
    let errors = report["errors"].as_array().expect("a list");
    let d3 = errors.iter().find(|error| error["name"] == "d3").expect("it is estimated");
    let [value, sigma] = ["value", "standard_uncertainty"].map(|key| d3[key].as_f64().expect("a number"));
    // The maker's 316 mm, to within a hundredth and what the rows say that they show.
    assert!(value.abs() < 4.0 * sigma && sigma < 2e-3, "{d3}");
}

/// A joint that runs the other way and two that are exchanged: named as that, and not as degrees, which leave small residuals of an arm that
/// hardly moves.
#[test]
fn what_is_read_wrongly_of_an_arm_is_named() {
    let Some(folder) = robot("panda_4", "sockets-misread") else { return };
    let rows = folder.read("robot.csv");
    type Change = fn(&mut [f64]);
    let changes: [(Change, Value); 2] = [
        (|q| q[2] = -q[2], serde_json::json!({ "what": "reversed", "column": "q3" })),
        (|q| q.swap(3, 4), serde_json::json!({ "what": "exchanged", "columns": ["q4", "q5"] })),
    ];
    for (change, expected) in changes {
        let mut text = String::new();
        for line in rows.lines() {
            let cells: Vec<&str> = line.split(',').collect();
            let mut joints: Vec<f64> = cells[3..10].iter().filter_map(|cell| cell.parse().ok()).collect();
            if joints.len() < 7 {
                writeln!(text, "{line}").expect("a string");
                continue;
            }
            change(&mut joints);
            let mut cells: Vec<String> = cells.iter().map(ToString::to_string).collect();
            cells.iter_mut().skip(3).zip(joints).for_each(|(cell, q)| *cell = format!("{q:.15}"));
            writeln!(text, "{}", cells.join(",")).expect("a string");
        }
        folder.write("robot.csv", text);
        let run = run_in(&folder.0, &["calibrate", "panda.toml", "--format", "json"], "");
        let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
        let own = cautions(&report, "column misread");
        let found = own.first().map(|own| &own["readings"][0]["reading"]);
        assert_eq!(found, Some(&expected), "{}", report["cautions"]);
    }
}

/// Two sockets under one label are 50 mm apart, as those of every stand. What that leaves is no residual of small errors: nothing is written.
#[test]
fn two_sockets_under_one_label_are_told() {
    let Some(folder) = robot("panda_4", "sockets-merged") else { return };
    let study = folder.read("panda.toml");
    assert!(study.contains("[\"placement\", \"socket\"]"));
    folder.write("panda.toml", study.replace("[\"placement\", \"socket\"]", "\"placement\""));
    let run = run_in(&folder.0, &["calibrate", "panda.toml", "--format", "json"], "");
    assert_eq!(run.code, 1, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let own = cautions(&report, "rows at two places");
    assert_eq!(own.len(), 1, "{}", report["cautions"]);
    let apart_m = number(own[0], "/apart_m");
    assert!((apart_m - 0.05).abs() < 0.002, "{apart_m}");
    assert_eq!(own[0]["objects"][0], own[0]["objects"][1]);
    let told = run_in(&folder.0, &["calibrate", "panda.toml"], "").stdout;
    assert!(told.starts_with("LIKELY READ WRONGLY"), "{told}");
}

/// Three links that turn in an upright plane, the plane about the vertical. The hand's height is no error: its zero makes up for it.
const ARM: &str = "
chain Arm {
    body turret on ground { motion: Rz(q1); }
    body upper on turret { motion: Rx(q2); }
    body fore on upper { position: Ty(0.6); position_error: Ty(longer1); motion: Rx(q3); motion_error: Rx(zero3); }
    body wrist on fore { position: Ty(0.5); position_error: Ty(longer2); motion: Rx(q4); motion_error: Rx(zero4); }
    body hand on wrist { position: Ty(0.25), Tz(0.1); position_error: Ty(longer3); }
    observe ball: point(0, 0, 0) of hand;
}
";

/// Rows in six sockets of an arm as it is, its joints read with noise: at each the ball is held from all sides.
fn in_sockets(random: &mut Random, each: usize) -> String {
    const LONGER: [f64; 3] = [0.8e-3, -0.5e-3, 0.3e-3];
    const ZEROS: [f64; 2] = [1e-3, -2e-3];
    let [upper, fore, hand] = [0.6 + LONGER[0], 0.5 + LONGER[1], 0.25 + LONGER[2]];
    let mut rows = String::from("socket,q1 [rad],q2 [rad],q3 [rad],q4 [rad]\n");
    for socket in 0..6 {
        let along = f64::from(socket);
        let (turn, out, up) = (0.9 * along - 2.0, 0.5 + 0.04 * along, 0.1 * (along - 2.0));
        for _ in 0..each {
            // Of the hand, then of the two links behind it, whose elbow is up.
            let pitch = -0.6 + 1.2 * random.even();
            let wrist =
                [out - hand * pitch.cos() + 0.1 * pitch.sin(), up - hand * pitch.sin() - 0.1 * pitch.cos()];
            let square = wrist[0].powi(2) + wrist[1].powi(2);
            let bend = -((square - upper.powi(2) - fore.powi(2)) / (2.0 * upper * fore)).acos();
            let raised = wrist[1].atan2(wrist[0]) - (fore * bend.sin()).atan2(upper + fore * bend.cos());
            let joints = [turn, raised, bend - ZEROS[0], pitch - raised - bend - ZEROS[1]];
            let read = joints.map(|joint| format!("{:.9}", joint + 2e-4 * random.normal()));
            writeln!(rows, "{socket},{}", read.join(",")).expect("a string");
        }
    }
    rows
}

/// No length is measured, and all together are as long as they are declared to within what errors may be: many rows, whose residuals are
/// smaller where the arm is, do not shrink it. What is no length comes out all the same.
#[test]
fn many_rows_do_not_shrink_an_arm() {
    let folder = Folder::new("sockets-many");
    folder.write("arm.chain", ARM).write(
        "study.toml",
        "chain = \"arm.chain\"\ndata = \"rows.csv\"\n[observed]\nkind = \"fixed\"\nobject = \"socket\"\n",
    );
    for (seed, each) in [(1, 30), (2, 300), (3, 1500)] {
        folder.write("rows.csv", in_sockets(&mut Random::new(seed), each));
        let report = calibrated(&folder, "study.toml");
        assert_eq!(report["verdict"], "nothing detectable", "{each}: {report}");
        let errors = report["errors"].as_array().expect("a list");
        let lengths = errors.iter().filter(|error| error["unit"] == "m");
        assert!(lengths.clone().count() == 3, "{report}");
        for length in lengths {
            assert!(number(length, "/value").abs() < 3e-3, "{each}: {length}");
        }
        let elbow = errors.iter().find(|error| error["name"] == "zero3");
        let elbow = number(elbow.expect("it is estimated"), "/value");
        assert!((elbow - 1e-3).abs() < 3e-4, "{each}: {elbow}");
    }
}
