//! Measured orientations, from the tables of a tracker and of `simulate`, through the whole loop.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::figures::number;
use crate::support::{Folder, root};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// The example with its data.
fn example(name: &str) -> Folder {
    let folder = Folder::new(name);
    for file in ["arm.chain", "arm.toml", "poses.csv"] {
        folder.copy(&format!("examples/probed-arm/{file}"));
    }
    folder
}

/// What the example's simulator planted, by the names of the declaration, SI.
fn planted() -> BTreeMap<String, f64> {
    let script =
        std::fs::read_to_string(root().join("examples/probed-arm/simulate.py")).expect("the simulator");
    let (_, table) = script.split_once("ERRORS = {").expect("a table");
    let (table, rest) = table.split_once('}').expect("its end");
    let value = |text: &str| -> f64 {
        let (number, unit) = text.split_once('*').map_or((text, 1.0), |(number, _)| (number, ARCSEC));
        number.trim().parse::<f64>().expect("a number") * unit
    };
    let entries = table.split(',').filter_map(|entry| entry.split_once(':'));
    let mut planted: BTreeMap<String, f64> =
        entries.map(|(name, text)| (name.trim().trim_matches('"').to_owned(), value(text))).collect();
    let (_, rest) = rest.split_once("ECCENTRIC, PHASE = ").expect("the effect");
    let (eccentric, phase) = rest.lines().next().and_then(|line| line.split_once(',')).expect("two numbers");
    let (eccentric, phase) = (value(eccentric), value(phase));
    // A sin(q − φ) = A cos φ sin q − A sin φ cos q.
    planted.insert("ecc_sin_q4".to_owned(), eccentric * phase.cos());
    planted.insert("ecc_cos_q4".to_owned(), -eccentric * phase.sin());
    planted
}

/// The probe's centre lies on the axis of the wrist: the orientation alone shows that the wrist's circle sits off centre.
#[test]
fn a_probe_on_the_axis_shows_the_wrist_by_how_it_is_turned() {
    let folder = example("probed-arm");
    let run = folder.trueaxis(&["calibrate", "arm.toml", "--out", "result"]);
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    let [effect] = report["effects"].as_array().expect("a list").as_slice() else {
        panic!("{:#?}", report["effects"])
    };
    assert_eq!((&effect["body"], &effect["dof"]), (&"wrist".into(), &"Ry".into()));
    assert!(
        effect["names"].as_array().expect("a list").contains(&"encoder eccentricity of q4".into()),
        "{effect:#}"
    );

    let planted = planted();
    let mut covered = 0;
    for error in report["errors"].as_array().expect("a list") {
        let name = error["name"].as_str().expect("a name");
        let off = (number(&error["value"]) - planted[name]) / number(&error["standard_uncertainty"]);
        assert!(off.abs() < 4.0, "{name}: {off} standard uncertainties off");
        covered += 1;
    }
    assert_eq!(covered, planted.len());

    // The points alone say nothing of it.
    let study = folder.read("arm.toml");
    let (points, _) = study.split_once("[[also]]").expect("two observations");
    folder.write("points.toml", points);
    let alone = folder.trueaxis(&["calibrate", "points.toml", "--format", "json"]);
    let alone: Value = serde_json::from_str(&alone.stdout).unwrap_or_else(|error| panic!("{error}: {alone}"));
    assert_eq!(alone["effects"], Value::Array(Vec::new()), "nothing on the axis shows the wrist");

    // 30 µm along each of three axes, and 12″ about each: points and orientations have figures of their own.
    assert_eq!(
        (&report["unit"], &effect["amplitude_unit"], &effect["amplitude_of"]),
        (&"m".into(), &"rad".into(), &"turned".into())
    );
    let points = (number(&report["before"]["rms"]), number(&report["after"]["rms"]));
    assert!((points.0 / points.1 - 1.0).abs() < 0.02 && (46e-6..58e-6).contains(&points.1), "{points:?}");
    let turned = &report["beside"][0];
    assert_eq!((&turned["unit"], &turned["observed"][0]), (&"rad".into(), &"turned".into()));
    let (before, after) =
        (number(&turned["before"]["rms"]) / ARCSEC, number(&turned["after"]["rms"]) / ARCSEC);
    assert!(before > 2.5 * after && (17.0..24.0).contains(&after), "{before} {after}");
    assert!((80.0..90.0).contains(&(number(&effect["amplitude"]) / ARCSEC)), "{effect:#}");
    assert!(run.stdout.contains("″ about y, once per turn of q4"), "{run}");
    assert!(run.stdout.contains("Residual of turned (RMS)"), "{run}");

    let residuals = folder.read("result/residuals.csv");
    let header = residuals.lines().next().expect("a header");
    assert!(header.contains("z_after [m],rotation_x_before [rad],rotation_x_after [rad]"), "{header}");
    let page = folder.read("result/report.html");
    assert!(
        page.contains("<h3>tip</h3>") && page.contains("<h3>turned</h3>"),
        "each unit has bars of its own"
    );
    assert!(page.contains("rotation_z, ″"), "an axis of pictures");

    // The amended declaration writes what it expects in the columns that a study reads without naming any.
    let evaluated = folder.trueaxis(&[
        "eval",
        "result/amended.chain",
        "--errors",
        "result/errors.toml",
        "--data",
        "poses.csv",
        "--observable",
        "turned",
        "--out",
        "expected.csv",
    ]);
    assert_eq!(evaluated.code, 0, "{evaluated}");
    let again = "chain = \"result/amended.chain\"\nobservable = \"turned\"\ndata = \"expected.csv\"\n[observed]\nkind = \"orientation\"\n";
    folder.write("again.toml", again);
    let run = folder.trueaxis(&["calibrate", "again.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    let again: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert!(number(&again["after"]["rms"]) < 1e-12, "{}", again["after"]);
    let value = |report: &Value, name: &str| -> f64 {
        let errors = report["errors"].as_array().expect("a list");
        number(&errors.iter().find(|error| error["name"] == name).expect("the error")["value"])
    };
    for name in ["ecc_cos_q4", "ecc_sin_q4", "mount_x", "mount_z", "skew2"] {
        let (found, expected) = (value(&again, name), value(&report, name));
        assert!((found - expected).abs() < 1e-11, "{name}: {found} {expected}");
    }
}

const FIVE: &str = "chain Five {
    const lean: angle = 3.0;
    body bed on ground { position: Ry(lean); }
    body table on bed { position_error: Ry(table_y); motion: Rz(c); motion_error: Rx(wobble*cos(c)); }
    body head on ground { position_error: Rz(head_z); motion: Rx(a); motion_error: Rx(zero_a); }
    body spindle on head { position: Rx(pi); position_error: Ry(spindle_y); }
    observe turned: orientation of spindle in table;
    observe part: rotation_z of orientation of spindle;
    observe tip: point(0, 0, 0.1) of spindle;
}
";

const FIVE_STUDY: &str = "chain = \"five.chain\"
observable = \"turned\"
data = \"five.csv\"

[observed]
kind = \"orientation\"

[noise]
sigma = \"5 arcsec\"

[next]
poses = 4
";

/// What `simulate` writes is read without a word about columns, in the frame of a body that moves too.
#[test]
fn what_simulate_writes_is_read_as_it_is() {
    let folder = Folder::new("five-axes");
    let truth =
        [("table_y", -30.0), ("wobble", 40.0), ("head_z", 20.0), ("zero_a", 60.0), ("spindle_y", -45.0)];
    let errors: String = truth.iter().map(|(name, value)| format!("{name} = \"{value} arcsec\"\n")).collect();
    folder.write("five.chain", FIVE).write("five.toml", FIVE_STUDY).write("errors.toml", errors);
    let run = folder.trueaxis(&[
        "simulate",
        "five.chain",
        "--observable",
        "turned",
        "--errors",
        "errors.toml",
        "--poses",
        "150",
        "--noise",
        "5 arcsec",
        "--seed",
        "7",
        "--out",
        "five.csv",
    ]);
    assert_eq!(run.code, 0, "{run}");
    assert!(
        folder.read("five.csv").starts_with("c,a,turned_rotation_x,turned_rotation_y,turned_rotation_z\n")
    );
    let run = folder.trueaxis(&["calibrate", "five.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["effects"], Value::Array(Vec::new()), "nothing is missing");
    assert!(report.get("beside").is_none(), "there is one unit");
    assert_eq!(report["instrument"]["observed"][0]["components"][2], "rotation_z");
    assert_eq!(report["next_poses"][0]["poses"].as_array().map(Vec::len), Some(4));
    let errors = report["errors"].as_array().expect("a list");
    for (name, value) in truth {
        let error = errors.iter().find(|error| error["name"] == name).unwrap_or_else(|| panic!("no {name}"));
        assert_eq!(error["separable"], true, "{name}");
        let off = (number(&error["value"]) - value * ARCSEC) / number(&error["standard_uncertainty"]);
        assert!(off.abs() < 4.0, "{name}: {off} standard uncertainties off");
    }
}

/// What is said of a study of orientations with one place changed, and of its data.
fn refused(from: &str, to: &str, data: &str) -> String {
    let folder = Folder::new("orientations-refused");
    assert!(FIVE_STUDY.contains(from), "{from}");
    folder
        .write("five.chain", FIVE)
        .write("five.toml", FIVE_STUDY.replacen(from, to, 1))
        .write("five.csv", data);
    let run = folder.trueaxis(&["calibrate", "five.toml", "--out", "result"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
    assert!(!folder.names().contains(&"result".to_owned()), "nothing is written");
    run.stderr
}

#[track_caller]
fn says(message: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(message.contains(part), "{part}\n{message}"));
}

#[test]
fn what_is_no_orientation_is_told() {
    let kind = "kind = \"orientation\"";
    let keys = |keys: &str| format!("{kind}\n{keys}");
    let of = |own: &str| refused(kind, &keys(own), "c,a\n0,0\n");
    says(
        &of("yaw = \"psi\""),
        &["unknown key `yaw`", "three angles turn about other axes", "`rx`, `ry`, `rz`"],
    );
    says(&of("rotaton_x = \"wx\""), &["did you mean `rotation_x`?"]);
    says(&of("x = \"qx\""), &["no column is named for `w`"]);
    says(&of("w = \"qw\"\nr11 = \"m11\""), &["`w` and `r11` are of two ways to write an orientation"]);
    says(
        &refused(kind, "kind = \"direction\"", ""),
        &["`turned` is an orientation", "kind = \"orientation\""],
    );
    says(&refused("\"turned\"", "\"tip\"", ""), &["`tip` is a point"]);
    says(
        &refused("\"turned\"", "\"part\"", ""),
        &["`part` shows a part of how a body is turned", "`orientation of …`"],
    );
    let named = "w = \"qw\"\nx = \"qx\"\ny = \"qy\"\nz = \"qz\"";
    let table = "c,a,qw,qx,qy,qz\n0,0,1,0,0,0\n0.1,0.2,0.6,0.0,0.8,0.1\n";
    says(
        &refused(kind, &keys(named), table),
        &["five.csv: line 3, row 2", "w, x, y, z is no unit quaternion: its length is 1.004988"],
    );
    let cells = ["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"];
    let named: String = cells.iter().map(|cell| format!("{cell} = \"{cell}\"\n")).collect();
    let table =
        |last: &str| format!("c,a,{}\n0,0,1,0,0,0,1,0,0,0,1\n0,0,1,0,0,0,1,0,0,0,{last}\n", cells.join(","));
    says(&refused(kind, &keys(&named), &table("-1")), &["row 2", "it mirrors"]);
    says(&refused(kind, &keys(&named), &table("0.95")), &["row 2", "0.050000 off the nearest one"]);
    says(
        &refused(kind, &keys("rx = \"rx\"\nry = \"ry\"\nrz = \"rz\""), "c,a,rx,ry,rz\n0,0,0,0,0\n"),
        &["`rx` is an angle without a unit"],
    );
    says(&refused(kind, kind, "c,a,q\n0,0,1\n"), &["no column `turned_rotation_x`"]);
}
