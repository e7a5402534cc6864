//! Tables of readings, evaluated, corrected and simulated.

use crate::support::{Folder, root, run_in, trueaxis};
use crate::{LIDAR, OFF_CENTRE, answered};

/// Columns of a table by their names, as numbers.
fn columns(table: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let column = |name: &&str| {
        let at = header.iter().position(|column| column == name).expect("the column is there");
        rows.iter().map(|row| row[at].parse().expect("a number")).collect()
    };
    names.iter().map(column).collect()
}

const POINTING: [&str; 3] = ["pointing_x", "pointing_y", "pointing_z"];
const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// The variance across the beam of two tables' directions, per direction across it, in squared arcseconds.
fn variance(one: &str, other: &str) -> f64 {
    let (one, other) = (columns(one, &POINTING), columns(other, &POINTING));
    let squares: f64 = one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| (a - b).powi(2)).sum();
    squares / (2.0 * one[0].len() as f64) / ARCSEC.powi(2)
}

#[test]
fn the_independent_simulator_and_the_chain_agree_up_to_the_noise() {
    let errors = "examples/mobile-lidar/off-centre.errors.toml";
    let measured = "examples/mobile-lidar/measured.csv";
    let arguments = ["apply", OFF_CENTRE, "--errors", errors, "--data", measured, "--out", "-"];
    let run = trueaxis(&[arguments.as_slice(), &["--observable", "pointing"]].concat());
    assert_eq!(run.code, 0, "{run}");
    let corrected = run.stdout;
    let measured = std::fs::read_to_string(root().join(measured)).expect("the example's data");
    let variance = variance(&corrected, &measured);
    // 800 independent normal amounts of 2 arcsec: their variance has a standard deviation of 5 %.
    assert!((variance / 4.0 - 1.0).abs() < 0.15, "{variance}");
}

#[test]
fn simulated_noise_is_what_was_asked_for_and_the_seed_fixes_it() {
    let errors = "examples/mobile-lidar/errors.toml";
    let simulate = |seed: &str| {
        answered(&[
            "simulate",
            LIDAR,
            "--errors",
            errors,
            "--poses",
            "5000",
            "--noise",
            "3 arcsec",
            "--seed",
            seed,
            "--observable",
            "pointing",
            "--out",
            "-",
        ])
    };
    let table = simulate("7");
    assert_eq!(table, simulate("7"), "the same seed");
    assert_ne!(table, simulate("8"), "another seed");
    let arguments =
        ["apply", LIDAR, "--errors", errors, "--observable", "pointing", "--data", "-", "--out", "-"];
    let exact = run_in(root(), &arguments, &table);
    assert_eq!(exact.code, 0, "{exact}");
    let variance = variance(&exact.stdout, &table);
    // 10000 normal amounts: the variance has a standard deviation of 1.4 %.
    assert!((variance / 9.0 - 1.0).abs() < 0.05, "{variance}");
}

#[test]
fn simulated_joints_keep_to_their_ranges() {
    let table = answered(&[
        "simulate",
        LIDAR,
        "--errors",
        "examples/mobile-lidar/errors.toml",
        "--poses",
        "500",
        "--noise",
        "0",
        "--seed",
        "1",
        "--observable",
        "target",
        "--range",
        "beta=-30..60 deg",
        "--range",
        "range=2 m..5 m",
        "--out",
        "-",
    ]);
    let [beta, range] = columns(&table, &["beta", "range"]).try_into().expect("two columns");
    assert!(beta.iter().all(|beta| (-30.0..60.0).contains(&beta.to_degrees())));
    assert!(range.iter().all(|range| (2.0..5.0).contains(range)));
    let spread =
        beta.iter().copied().fold(f64::MIN, f64::max) - beta.iter().copied().fold(f64::MAX, f64::min);
    assert!(spread.to_degrees() > 85.0, "the whole range is used");
}

#[test]
fn exact_and_first_order_errors_are_equal_to_second_order() {
    let folder = Folder::new("exact-and-first-order");
    folder.copy(LIDAR).copy("examples/mobile-lidar/measured.csv");
    let largest = |size: f64| {
        folder.write("e.toml", format!("\"*\" = {size:e}\n"));
        let eval = |form: &str| {
            let arguments = [
                "eval",
                "mobile-lidar.chain",
                "--errors",
                "e.toml",
                "--data",
                "measured.csv",
                "--observable",
                "position",
                "--form",
                form,
                "--out",
                "-",
            ];
            let run = folder.trueaxis(&arguments);
            assert_eq!(run.code, 0, "{run}");
            columns(&run.stdout, &["position_x", "position_y", "position_z"]).concat()
        };
        let (exact, first) = (eval("exact"), eval("first-order"));
        exact.iter().zip(first).map(|(exact, first)| (exact - first).abs()).fold(0.0, f64::max)
    };
    let ratio = largest(2e-4) / largest(1e-4);
    assert!((ratio - 4.0).abs() < 0.01, "halving the errors divides the difference by four: {ratio}");
}

#[test]
fn value_is_the_value_without_errors_and_the_error() {
    let folder = Folder::new("value-and-error");
    folder.copy(LIDAR).write("none.toml", "").write("e.toml", "\"d*\" = 1e-4\n");
    folder.write("poses.csv", "note,alpha [deg],beta [deg],gamma [deg]\nfirst,10,20,30\nsecond,-40,50,60\n");
    let eval = |errors: &str, quantity: &str, form: &str| {
        let arguments = [
            "eval",
            "mobile-lidar.chain",
            "--errors",
            errors,
            "--data",
            "poses.csv",
            "--observable",
            "pointing",
            "--quantity",
            quantity,
            "--form",
            form,
            "--out",
            "-",
        ];
        let run = folder.trueaxis(&arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
        assert!(run.stdout.starts_with("note,alpha [deg],beta [deg],gamma [deg],pointing_x"), "{run}");
        assert!(run.stdout.lines().nth(2).is_some_and(|row| row.starts_with("second,-40,50,60,")), "{run}");
        columns(&run.stdout, &POINTING).concat()
    };
    for form in ["exact", "first-order"] {
        let sum = eval("none.toml", "value", form).into_iter().zip(eval("e.toml", "error", form));
        for ((ideal, error), value) in sum.zip(eval("e.toml", "value", form)) {
            assert!(
                (ideal + error - value).abs() <= 2.0 * f64::EPSILON,
                "{form}: {ideal} + {error} = {value}"
            );
        }
    }
}

#[test]
fn columns_of_the_input_that_are_computed_anew_are_replaced_with_a_word() {
    for command in ["eval", "apply"] {
        let arguments = [
            command,
            LIDAR,
            "--errors",
            "examples/mobile-lidar/errors.toml",
            "--data",
            "examples/mobile-lidar/measured.csv",
            "--observable",
            "pointing",
            "--out",
            "-",
        ];
        let run = trueaxis(&arguments);
        assert_eq!(run.code, 0, "{run}");
        assert_eq!(
            run.stderr,
            "warning: the input's own columns `pointing_x`, `pointing_y`, `pointing_z` were replaced\n"
        );
        assert_eq!(run.stdout.lines().next().expect("a header").matches("pointing_x").count(), 1);
    }
}

/// Readings that are solved for were the starts; what else has a name of the result is told.
#[test]
fn readings_that_are_solved_for_are_replaced_without_a_word() {
    let folder = Folder::new("replaced-solved");
    folder.write("mount.chain", "chain M { body b on ground { motion: Rz(pan); } body t on b { motion: Rx(tilt); } observe sight: direction(0, 1, 0) of t; }");
    folder.write("e.toml", "");
    let solve = "apply mount.chain --errors e.toml --data in.csv --solve --out out.csv";
    let words: Vec<&str> = solve.split(' ').collect();
    folder.write("in.csv", "pan,tilt,sight_x,sight_y,sight_z\n0,0,0,1,0.1\n");
    let run = folder.trueaxis(&words);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
    folder.write("in.csv", "pan,tilt,sight_x,sight_y,sight_z,sight_remaining\n0,0,0,1,0.1,7\n");
    let run = folder.trueaxis(&words);
    assert_eq!(
        (run.code, run.stderr.as_str()),
        (0, "warning: the input's own column `sight_remaining` was replaced\n"),
        "{run}"
    );
}

#[test]
fn output_appears_whole_or_not_at_all() {
    let folder = Folder::new("whole-or-not");
    folder.copy(LIDAR).write("e.toml", "da1 = 1e-5\n").write("out.csv", "what stood there\n");
    let rows: String = (0..9000).map(|row| format!("{row},0,0\n")).collect();
    folder.write("poses.csv", format!("alpha [deg],beta [deg],gamma [deg]\n{rows}1,2,three\n"));
    let arguments =
        ["eval", "mobile-lidar.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv"];
    let run = folder.trueaxis(&arguments);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("row 9001, column `gamma [deg]`: `three` is no number"), "{run}");
    assert_eq!(folder.read("out.csv"), "what stood there\n");
    assert_eq!(folder.names(), ["e.toml", "mobile-lidar.chain", "out.csv", "poses.csv"]);
}
