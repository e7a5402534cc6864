//! `trueaxis budget` as users run it: the paper's simulation, its files, and what cannot be read.

#[path = "../support/mod.rs"]
mod support;

mod designer;

use serde_json::Value;
use support::{Folder, Run, trueaxis};

const LIDAR: &str = "examples/mobile-lidar/mobile-lidar.chain";
const BOX: &str = "examples/mobile-lidar/box.toml";
/// The paper's path: all joints run together.
const TOGETHER: &str = "alpha=t, beta=t, gamma=t";

fn budget(more: &[&str]) -> Run {
    let mut arguments = vec!["budget", LIDAR, "--sizes", BOX];
    arguments.extend(more);
    trueaxis(&arguments)
}

/// The tilts of the paper's figures against quadrature at 40 digits: see ../check/reference.py.
#[test]
fn influences_are_those_of_the_independent_quadrature() {
    let run = budget(&["--observable", "pointing", "--path", TOGETHER, "--format", "json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let json: Value = serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}"));
    let errors = json["observables"][0]["errors"].as_array().map_or(&[][..], Vec::as_slice);
    assert_eq!(errors.len(), 30);
    let mut compared = 0;
    for line in include_str!("../check/reference.txt").lines() {
        let Some((name, numbers)) =
            line.strip_prefix("influence of ").and_then(|line| line.split_once(": rms "))
        else {
            continue;
        };
        let (rms, sup) = numbers.split_once(" sup ").unwrap_or_else(|| panic!("{line}"));
        let found = errors.iter().find(|error| error["name"] == name).unwrap_or_else(|| panic!("{name}"));
        for (key, expected) in [("rms", rms), ("sup", sup)] {
            let expected: f64 = expected.parse().unwrap_or_else(|error| panic!("{line}: {error}"));
            let found = found[key].as_f64().unwrap_or(f64::NAN);
            assert!((found - expected).abs() <= 1e-12 * expected + 1e-20, "{name} {key}: {found} {expected}");
            compared += 1;
        }
    }
    assert_eq!(compared, 12);
}

#[test]
fn the_table_is_made_for_reading() {
    let run = budget(&["--path", TOGETHER]);
    insta::assert_snapshot!(run.to_string());
}

/// Five sizes from 2 to 10 arc seconds and from 0.1 to 0.5 mm, as in figures 7 and 8.
#[test]
fn tables_and_figures_are_written() {
    let folder = Folder::new("budget_figures");
    folder.copy(LIDAR).copy(BOX);
    let run = folder.trueaxis(&[
        "budget",
        "mobile-lidar.chain",
        "--sizes",
        "box.toml",
        "--path",
        "alpha=t, beta=t, gamma=t, range=20 m",
        "--steps",
        "5",
        "--out",
        "figures",
    ]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let mut names: Vec<String> = std::fs::read_dir(folder.0.join("figures"))
        .map(|entries| {
            entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
        })
        .unwrap_or_default();
    names.sort();
    assert_eq!(
        names,
        [
            "budget.csv",
            "budget.html",
            "pointing.csv",
            "pointing.svg",
            "position.csv",
            "position.svg",
            "target.csv",
            "target.svg"
        ]
    );
    assert_eq!(folder.read("figures/budget.csv").lines().count(), 1 + 3 * 32);

    let table = folder.read("figures/pointing.csv");
    let header: Vec<&str> = table.lines().next().unwrap_or_default().split(',').collect();
    assert_eq!((header[0], header.len(), table.lines().count()), ("t", 1 + 30 * 5, 1 + 361));
    // A tilt of the middle frame turns the beam by itself at every pose.
    let arcsec = std::f64::consts::PI / (180.0 * 3600.0);
    for (step, column) in
        header.iter().enumerate().filter(|(_, name)| name.starts_with("db2 ")).map(|(c, _)| c).enumerate()
    {
        for row in table.lines().skip(1) {
            let value: f64 =
                row.split(',').nth(column).and_then(|cell| cell.parse().ok()).unwrap_or(f64::NAN);
            assert!((value - 2.0 * (step as f64 + 1.0) * arcsec).abs() < 1e-17, "{row}");
        }
    }

    let figure = folder.read("figures/pointing.svg");
    assert!(figure.starts_with("<svg") && figure.trim_end().ends_with("</svg>"));
    assert!(figure.contains(">Δβ₂<") && !figure.contains(">Δγ₂<"), "only what has an influence is drawn");
}

#[test]
fn ranges_take_the_place_of_a_path() {
    let run = budget(&["--observable", "target", "--range", "range=5..50 m", "--range", "beta=-30..30 deg"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    // The largest lever: 10 arc seconds over 50 m.
    let line = run.stdout.lines().find(|line| line.trim_start().starts_with("db2")).unwrap_or_default();
    assert!(line.contains(" 2.4241 "), "{line}");
}

#[test]
fn what_is_wrong_is_named() {
    for (arguments, wanted) in [
        (&["--path", "alpha=t, bta=t"][..], "did you mean `beta`?"),
        (&["--path", "alpha=t,"], "an assignment is missing here"),
        (&["--path", "alpha=t, alpha=2*t"], "`alpha` is given twice"),
        (&["--path", "alpha=sin(t/2)"], "the angle of a sine or cosine"),
        (&["--path", "alpha=beta"], "unknown name `beta`"),
        (&["--path", "alpha=10 mm"], "`mm` measures a length, but an angle is wanted"),
        (&["--observable", "pointing", "--path", "alpha=t"], "--range \"beta=lo..hi\""),
        (&["--observable", "target"], "--range \"range=lo..hi\""),
        (&["--path", TOGETHER, "--range", "beta=0..1"], "cannot be used with"),
        (&["--range", "bta=0..1"], "did you mean `beta`?"),
        (&["--range", "beta=2..1"], "swap them"),
        (&["--observable", "ponting"], "did you mean `pointing`?"),
        (&["--steps", "0"], "--steps"),
    ] {
        let run = budget(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(wanted), "{arguments:?}: {}", run.stderr);
    }
}
