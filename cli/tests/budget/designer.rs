//! What tolerances come to, against an independent program: see reference.py.

use serde_json::Value;

use crate::support::{Folder, Run, trueaxis};

const LIDAR: &str = "examples/mobile-lidar/mobile-lidar.chain";
/// The paper's chain at a target 10 m away, with the sizes of [`sizes`].
const PATH: &str = "alpha=t, beta=t, gamma=t, range=10 m";

/// A folder with the paper's chain and 10″ and 0.3 mm for its errors.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.copy(LIDAR).copy("examples/mobile-lidar/paper.toml");
    let angles = ["dtheta_*", "da*", "db*", "dg*"].map(|name| format!("\"{name}\" = \"10 arcsec\"\n"));
    let shifts = ["delta_*", "dx*", "dy*", "dz*"].map(|name| format!("\"{name}\" = \"0.3 mm\"\n"));
    folder.write("box.toml", angles.concat() + &shifts.concat());
    folder
}

fn budget(folder: &Folder, more: &[&str]) -> Run {
    let mut arguments = vec!["budget", "mobile-lidar.chain", "--sizes", "box.toml"];
    arguments.extend(more);
    folder.trueaxis(&arguments)
}

fn tolerances(run: &Run) -> Value {
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    let json: Value = serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}"));
    json["observables"][0]["tolerances"].clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn reference(name: &str) -> f64 {
    let lines = include_str!("reference.txt").lines();
    let found = lines.filter_map(|line| line.strip_prefix(name)?.trim().parse().ok()).next();
    found.unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn tolerances_come_to_what_the_independent_program_says() {
    let folder = folder("budget_tolerances");
    let target = ["--observable", "target", "--path", PATH, "--format", "json"];
    let run = budget(
        &folder,
        &[
            &target[..],
            &["--draws", "200000", "--wanted", "0.5 mm", "--campaign", "100", "--noise", "0.3 mm"],
        ]
        .concat(),
    );
    let found = tolerances(&run);
    let registered =
        budget(&folder, &[&target[..], &["--registered", "--campaign", "100", "--noise", "0.3 mm"]].concat());
    let registered = tolerances(&registered);
    let size = |name: &str| {
        let errors = found["errors"].as_array().map_or(&[][..], Vec::as_slice);
        errors
            .iter()
            .find(|error| error["name"] == name)
            .map_or(Value::Null, |error| error["size_for_wanted"].clone())
    };
    for (name, value) in [
        ("expected rms", &found["root_sum_square"]["rms"]),
        ("expected largest", &found["root_sum_square"]["largest"]),
        ("worst combination", &found["worst_case"]["largest"]),
        ("after calibration", &found["after_calibration"]["root_sum_square"]["rms"]),
        ("expected registered", &registered["root_sum_square"]["rms"]),
        ("after registered", &registered["after_calibration"]["root_sum_square"]["rms"]),
        ("size of dtheta_x1", &size("dtheta_x1")),
        ("size of dx1", &size("dx1")),
        ("size of db2", &size("db2")),
    ] {
        let (value, expected) = (number(value), reference(name));
        assert!((value - expected).abs() < 1e-9 * expected, "{name}: {value} {expected}");
    }
    let ratio = number(&found["wanted"]["cost_then"]) / number(&found["wanted"]["cost_now"]);
    assert!((ratio - reference("cost ratio")).abs() < 1e-9);
    // A turn about the beam does nothing, whatever its size.
    assert!(size("dg4").is_null());
    // Percentiles of 200,000 draws on either side: a standard error is a seventh of a percent at most.
    for sample in ["single", "rms", "largest"] {
        for part in ["50", "95"] {
            let value = number(&found["drawn"][sample]["percentiles"][part]);
            let expected = reference(&format!("drawn {sample} {part}"));
            assert!((value - expected).abs() < 0.008 * expected, "{sample} {part}: {value} {expected}");
        }
        let within = number(&found["drawn"][sample]["yield"]);
        assert!(within > 0.0 && within < 0.2, "{within}");
    }
    let shares: f64 =
        found["errors"].as_array().into_iter().flatten().map(|error| number(&error["share"])).sum();
    assert!((shares - 1.0).abs() < 1e-12);
}

/// The sizes for a wanted error, fed back, give what was wanted; a campaign from a table is that of its poses.
#[test]
fn what_comes_out_goes_in_again() {
    let folder = folder("budget_again");
    let target = ["--observable", "target", "--path", PATH, "--format", "json"];
    let costs = ["--cost", "da*=3", "--finest", "dx*=0.1 mm", "--wanted", "0.4 mm"];
    let found = tolerances(&budget(&folder, &[&target[..], &costs].concat()));
    let mut file = String::new();
    for error in found["errors"].as_array().into_iter().flatten() {
        let size = error["size_for_wanted"].as_f64().unwrap_or_else(|| number(&error["size"]));
        file += &format!("{} = {size:?}\n", error["name"].as_str().unwrap_or_default());
        if error["name"] == "dx1" {
            assert!(size >= 1e-4);
        }
    }
    folder.write("box.toml", file);
    let again = tolerances(&budget(&folder, &[&target[..], &["--wanted", "0.4 mm"]].concat()));
    assert!((number(&again["root_sum_square"]["rms"]) - 4e-4).abs() < 1e-12);
    // Nothing is cheaper than what is cheapest.
    assert!(number(&again["wanted"]["cost_then"]) <= number(&again["wanted"]["cost_now"]) * (1.0 + 1e-9));

    let poses: String =
        (0..100).map(|at| 3.6 * (f64::from(at) + 0.5)).map(|t| format!("{t},{t},{t},10\n")).collect();
    folder.write("poses.csv", format!("alpha [deg],beta [deg],gamma [deg],range\n{poses}"));
    let with = |campaign: &str| {
        let run = budget(&folder, &[&target[..], &["--campaign", campaign, "--noise", "0.1 mm"]].concat());
        number(&tolerances(&run)["after_calibration"]["root_sum_square"]["rms"])
    };
    let (of_table, of_path) = (with("poses.csv"), with("100"));
    assert!((of_table - of_path).abs() < 1e-9 * of_path, "{of_table} {of_path}");
}

#[test]
fn text_says_what_a_designer_asks() {
    let folder = folder("budget_text");
    folder.write("triangle.csv", "value,frequency\n-1,0\n0,1\n1,0\n");
    let run = budget(
        &folder,
        &[
            "--observable",
            "pointing",
            "--path",
            "alpha=t, beta=t/2, gamma=t",
            "--poses",
            "90",
            "--draws",
            "2000",
            "--wanted",
            "12 arcsec",
            "--distribution",
            "normal 2",
            "--distribution",
            "da*=table triangle.csv",
            "--campaign",
            "20",
            "--noise",
            "2 arcsec",
        ],
    );
    insta::assert_snapshot!(run.to_string());
}

#[test]
fn the_page_stands_alone() {
    let folder = folder("budget_page");
    let run = budget(
        &folder,
        &[
            "--path",
            PATH,
            "--steps",
            "5",
            "--draws",
            "1000",
            "--wanted",
            "0.5 mm",
            "--claims",
            "paper.toml",
            "--out",
            "out",
        ],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    // A length cannot be wanted of a direction, which is said and costs no more.
    assert!(run.stderr.contains("pointing is left out"), "{}", run.stderr);
    let page = folder.read("out/budget.html");
    assert!(page.len() < 1_000_000, "{}", page.len());
    for wanted in [
        "What to tighten first",
        "Along the path",
        "Draws of all errors",
        "Sizes for 0.500 mm",
        "does not hold",
    ] {
        assert!(page.contains(wanted), "{wanted}");
    }
    // Figures 7 and 8: a panel an error that does something, five lines each.
    assert!(page.contains("Δβ₂ (db2) at 2 arcsec, 4 arcsec, 6 arcsec, 8 arcsec, 10 arcsec"), "no panel");
    for foreign in ["http://", "https://", "<script", "NaN", "src="] {
        assert!(!page.contains(foreign), "{foreign}");
    }
}

#[test]
fn what_a_designer_mistypes_is_named() {
    let folder = folder("budget_mistyped");
    folder
        .write("wrong.csv", "value,frequency\n-1,0\n2,1\n")
        .write("words.csv", "a,b\nc,d\n")
        .write("poses.csv", "alpha,bta\n1,2\n");
    let target = ["--observable", "target", "--path", PATH];
    for (more, wanted) in [
        (&["--distribution", "unifrom"][..], "did you mean `uniform`?"),
        (&["--distribution", "normal"], "write `normal 2`"),
        (&["--distribution", "dz9=uniform"], "no error `dz9`; did you mean"),
        (&["--distribution", "da*=uniform", "--distribution", "da*=normal 2"], "said twice"),
        (&["--distribution", "table wrong.csv"], "wrong.csv: row 2: the value 2 is beyond the size"),
        (&["--distribution", "table words.csv"], "words.csv:2: `c,d` is not two numbers"),
        (&["--distribution", "table nothing.csv"], "nothing.csv"),
        (&["--wanted", "0.5"], "has no unit"),
        (&["--wanted", "5 arcsec"], "`arcsec` measures an angle, but a length is wanted"),
        (&["--wanted=-1 mm"], "is no size"),
        (&["--wanted", "0.1 mm", "--finest", "d[xyz]*=0.2 mm"], "no error `d[xyz]*`"),
        (&["--wanted", "0.1 mm", "--finest", "dx*=0.2 mm"], "the root sum square is 0.2309 mm"),
        (&["--wanted", "0.1 mm", "--cost", "da1=0"], "`0` is no cost"),
        (&["--wanted", "0.1 mm", "--cost", "2"], "write errors=value"),
        (&["--campaign", "100"], "--noise"),
        (&["--campaign", "0", "--noise", "1 mm"], "nothing to measure"),
        (&["--campaign", "poses.csv", "--noise", "1 mm"], "did you mean `bta`?"),
        (&["--draws", "0"], "--draws"),
        (&["--claims", "paper.toml"], "--out"),
    ] {
        let run = budget(&folder, &[&target[..], more].concat());
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{more:?}: {}", run.stderr);
        assert!(run.stderr.contains(wanted), "{more:?}: {}", run.stderr);
    }
    assert_eq!(
        folder.names(),
        ["box.toml", "mobile-lidar.chain", "paper.toml", "poses.csv", "words.csv", "wrong.csv"]
    );
}

/// The same whatever the number of threads.
#[test]
fn the_seed_says_what_is_drawn() {
    let drawn = |seed: &str| {
        let run = trueaxis(&[
            "budget",
            LIDAR,
            "--sizes",
            "examples/mobile-lidar/box.toml",
            "--observable",
            "pointing",
            "--draws",
            "9000",
            "--poses",
            "20",
            "--seed",
            seed,
            "--format",
            "json",
        ]);
        tolerances(&run)["drawn"].to_string()
    };
    assert_eq!(drawn("4"), drawn("4"));
    assert_ne!(drawn("4"), drawn("5"));
}
