//! More rows than the search reads: what it finds in some, every row bears out or not.

use std::f64::consts::PI;
use std::fmt::Write as _;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use serde_json::Value;
use testkit::turned;
use trueaxis_cli::library::stretches;

use crate::support::{Folder, trueaxis};

const ARCSEC: f64 = PI / 648_000.0;
const NOISE: f64 = 2.0 * ARCSEC;
const TILT: f64 = 25.0 * ARCSEC;
const FILES: [&str; 3] = ["a.csv", "b.csv", "c.csv"];
const ROWS: u64 = 8000;
const SEARCHED: u64 = 6000;

const TABLE: &str = "
chain Table {
    body table on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(alpha); }
    body arm on table { position_error: Ry(skew); motion: Rx(beta); }
    observe sight: direction(0, 1, 0) of arm;
}
";
const STUDY: &str = r#"
chain = "table.chain"
data = ["a.csv", "b.csv", "c.csv"]
[observed]
kind = "direction"
x = "x"
y = "y"
z = "z"
[hold_out]
folds = 3
seed = 4
"#;

/// A turntable whose circle sits off centre by `off_centre` of a row, in files; the sight by rotations written down here.
fn folder(name: &str, off_centre: impl Fn(u64) -> f64) -> Folder {
    let folder = Folder::new(name);
    folder.write("table.chain", TABLE);
    folder.write("study.toml", STUDY);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for (number, file) in (0..).zip(FILES) {
        let mut text = String::from("alpha,beta,x,y,z\n");
        for row in number * ROWS..(number + 1) * ROWS {
            let (alpha, beta): (f64, f64) = (random.random_range(-3.0..3.0), random.random_range(-0.7..0.7));
            let circle = alpha + off_centre(row) * alpha.sin();
            let mut sight = turned(0, beta, [0.0, 1.0, 0.0]);
            sight = turned(0, TILT, turned(2, circle, sight));
            sight.iter_mut().for_each(|value| *value += NOISE * random.sample::<f64, _>(StandardNormal));
            let length = sight.iter().map(|value| value * value).sum::<f64>().sqrt();
            let [x, y, z] = sight.map(|value| value / length);
            let _ = writeln!(text, "{alpha},{beta},{x},{y},{z}");
        }
        folder.write(file, &text);
    }
    folder
}

fn calibrated(folder: &Folder) -> (String, Value) {
    let [study, out] = ["study.toml", "out"].map(|name| folder.0.join(name).display().to_string());
    let run = trueaxis(&["calibrate", &study, "--out", &out, "--search-rows", "6_000", "-q"]);
    assert_eq!(run.code, 0, "{run}");
    let report = serde_json::from_str(&folder.read("out/report.json")).expect("JSON");
    (run.stdout.split_whitespace().collect::<Vec<_>>().join(" "), report)
}

#[test]
fn every_row_says_the_errors_and_the_others_judge_the_effect() {
    let off_centre = 30.0 * ARCSEC;
    let folder = folder("many", |_| off_centre);
    let (text, report) = calibrated(&folder);
    assert_eq!(
        (&report["effects"][0]["body"], &report["effects"][0]["driver"]),
        (&"table".into(), &"alpha".into())
    );
    assert!(
        text.contains(
            "The search used 6000 of 24000 rows from 3 files. The errors are estimated from every row."
        ),
        "{text}"
    );

    let every = &report["every_row"];
    assert_eq!(
        (&every["rows"], &every["files"], &every["converged"]),
        (&24_000.into(), &3.into(), &true.into())
    );
    let left = &every["validation"];
    let of = |key: &str| left[key].as_f64().expect("a number");
    // Two components a row; and the off-centre circle moves the sight by its sine, by cos(beta).
    assert_eq!(left["rows"], 18_000);
    assert!((of("after") / (NOISE * 2.0_f64.sqrt()) - 1.0).abs() < 0.03, "{left}");
    assert!(of("before") > 3.0 * of("after"), "{left}");

    let errors = report["errors"].as_array().expect("a list");
    let error = |name: &str| {
        let found = errors.iter().find(|error| error["name"] == name).expect(name);
        let number = |key: &str| found[key].as_f64().expect("a number");
        (number("value"), number("standard_uncertainty"))
    };
    for (name, truth) in [("tilt_x", TILT), ("tilt_y", 0.0)] {
        let (value, uncertainty) = error(name);
        assert!((value - truth).abs() < 4.5 * uncertainty, "{name}: {value} ± {uncertainty}");
        // Of 24,000 rows, whose sights show a tilt in one direction in two.
        assert!(
            (0.4..2.0).contains(&(uncertainty / (NOISE / 24_000.0_f64.sqrt()))),
            "{name}: ± {uncertainty}"
        );
    }
    // What is written is what is told; the reader of JSON rounds the last bit.
    let toml = folder.read("out/errors.toml");
    let written =
        toml.lines().find(|line| line.starts_with("tilt_x ")).and_then(|line| line.split('"').nth(1));
    let written = written.and_then(|value| value.strip_suffix(" rad")).expect(&toml);
    let written: f64 = written.parse().expect("a number");
    assert!((written / error("tilt_x").0 - 1.0).abs() <= f64::EPSILON, "{toml}");
    let coefficient = report["effects"][0]["coefficients"].as_object().expect("a table");
    assert!(coefficient.iter().all(|(name, value)| value.as_f64() == Some(error(name).0)));
}

/// An adversary puts an effect into the rows that are drawn, and as much of the opposite into the others: less than the noise, so that
/// robust weights leave the balance.
#[test]
fn an_effect_of_the_drawn_rows_alone_is_not_borne_out() {
    let drawn = stretches(&[ROWS; 3], SEARCHED, 4);
    let is_drawn =
        |row: u64| drawn[(row / ROWS) as usize].iter().any(|stretch| stretch.contains(&(row % ROWS)));
    let share = SEARCHED as f64 / (3 * ROWS) as f64;
    let folder = folder("adversary", |row| ARCSEC * if is_drawn(row) { 1.0 } else { -share / (1.0 - share) });
    let (text, report) = calibrated(&folder);
    assert_eq!(report["effects"][0]["driver"], "alpha");
    let cautions: Vec<&Value> =
        report["cautions"].as_array().expect("a list").iter().map(|c| &c["kind"]).collect();
    assert_eq!(cautions, ["not borne out by every row", "worse on held-out data"], "{text}");
    assert!(text.contains("WORSE ON HELD-OUT DATA") && text.contains("Do not correct with it"), "{text}");
}

#[test]
fn a_mistake_behind_the_rows_that_are_drawn_is_named() {
    let folder = folder("spoiled-late", |_| 0.0);
    let text = folder.read("c.csv");
    let lines: Vec<&str> = text.lines().collect();
    let spoiled = [&lines[..7990], &["1,2,three,4,5"], &lines[7991..]].concat().join("\n");
    folder.write("c.csv", &spoiled);
    let [study, out] = ["study.toml", "out"].map(|name| folder.0.join(name).display().to_string());
    let run = trueaxis(&["calibrate", &study, "--out", &out, "--search-rows", "6000"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("c.csv: line 7991, row 7990, column `x`"), "{run}");
    assert!(!folder.names().contains(&"out".to_owned()));
    for (rows, words) in [("0", "the search needs rows"), ("many", "write a whole number")] {
        let run = trueaxis(&["calibrate", &study, "--search-rows", rows]);
        assert!(run.code == 2 && run.stderr.contains(words), "{run}");
    }
}
