//! Files with the headings of the study go in, and come out with corrected values in their units and notation.

use std::f64::consts::PI;

use crate::support::{Folder, run_in};
use crate::{calibrated, packed};

/// The cells of a column.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|cell| *cell == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
    lines.map(|line| line.split(',').nth(at).expect("a cell").to_owned()).collect()
}

fn numbers(text: &str, name: &str) -> Vec<f64> {
    column(text, name).iter().map(|cell| cell.parse().expect("a number")).collect()
}

fn apply(folder: &Folder, data: &str, more: &[&str]) -> String {
    let fixed = ["apply", "result/instrument.toml", "--data", data, "--out", "-"];
    let run = folder.trueaxis(&[&fixed, more].concat());
    assert_eq!(run.code, 0, "{run}");
    run.stdout
}

/// What is planted is 40″ of index: the elevation that is written is the reading and 40″, packed as the data have it.
#[test]
fn corrected_values_are_in_the_units_and_the_notation_of_the_data() {
    let folder = calibrated("columns-notation");
    // In other order, with a column that nobody knows, and a target of one star alone.
    folder.write(
        "new.csv",
        format!("remark,pier,zenith,Az\n\"a, b\",1,{},-100\nc,-1,{},50\n", packed(60.0), packed(12.5)),
    );
    let text = apply(&folder, "new.csv", &["--correction"]);
    let header = text.lines().next().expect("a header");
    assert_eq!(
        header,
        "remark,pier,zenith,Az,true az (deg),true el,true az_correction [arcsec],true el_correction [arcsec]"
    );
    assert!(text.contains("\"a, b\",1,"), "cells stay as they are: {text}");
    let text = text.replace("\"a, b\"", "a");
    let close = |found: &[f64], expected: &[f64], within: f64| {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < within, "{found} {expected}");
        }
    };
    // The data have azimuths on both sides of zero: so are those that are written.
    close(&numbers(&text, "true az (deg)"), &[-90.0, 45.0], 1e-4);
    let elevations: Vec<f64> =
        [30.0, 77.5].iter().map(|el| packed(el + 40.0 / 3600.0).parse().expect("a number")).collect();
    close(&numbers(&text, "true el"), &elevations, 1e-5);
    close(&numbers(&text, "true el_correction [arcsec]"), &[40.0; 2], 0.05);
}

/// The study's own data, whose observed columns are replaced where they stand.
#[test]
fn columns_that_are_there_are_replaced_where_they_stand() {
    let folder = calibrated("columns-there");
    let data = folder.read("stars.csv");
    let fixed = ["apply", "result/instrument.toml", "--data", "stars.csv", "--out", "out.csv"];
    let run = folder.trueaxis(&fixed);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("the input's own columns `true az (deg)`, `true el` were replaced"), "{run}");
    let out = folder.read("out.csv");
    assert_eq!(out.lines().next(), data.lines().next());
    assert_eq!(column(&out, "zenith"), column(&data, "zenith"));
    for (name, within) in [("true az (deg)", 1e-4), ("true el", 3e-5)] {
        for (found, measured) in numbers(&out, name).into_iter().zip(numbers(&data, name)) {
            let turns = ((found - measured) / 360.0).round();
            assert!((found - measured - 360.0 * turns).abs() < within, "{name}: {found} {measured}");
        }
    }
}

/// The values are those of the declaration and the errors file that stand beside the instrument file.
#[test]
fn it_says_what_the_declaration_and_the_errors_say() {
    let folder = calibrated("columns-same");
    folder.write("new.csv", format!("Az,zenith,pier\n-100,{},1\n50,{},-1\n", packed(60.0), packed(12.5)));
    folder.write("si.csv", "azimuth [deg],elevation [deg],side\n-90,30,1\n45,77.5,-1\n");
    let old = ["--errors", "result/errors.toml", "--data", "si.csv", "--out", "-"];
    for [command, quantity] in [["apply", ""], ["eval", "value"], ["eval", "error"]] {
        let more: Vec<&str> =
            if quantity.is_empty() { vec!["--as", "vector"] } else { vec!["--quantity", quantity] };
        let before = folder.trueaxis(&[&[command, "result/amended.chain"], &old[..], &more].concat());
        let file = ["result/instrument.toml", "--data", "new.csv", "--out", "-"];
        let after = folder.trueaxis(&[&[command], &file[..], &more].concat());
        assert_eq!([before.code, after.code], [0, 0], "{before}{after}");
        for axis in ["pointing_x", "pointing_y", "pointing_z"] {
            for (a, b) in numbers(&before.stdout, axis).into_iter().zip(numbers(&after.stdout, axis)) {
                assert!((a - b).abs() < 1e-13, "{command} {quantity} {axis}: {a} {b}");
            }
        }
    }
}

/// A column that is missing is named as the study names it.
#[test]
fn a_column_that_is_missing_is_named_as_the_data_have_it() {
    let folder = calibrated("columns-missing");
    folder.write("new.csv", "Az,zenith\n1,2\n");
    let run = folder.trueaxis(&["apply", "result/instrument.toml", "--data", "new.csv", "--out", "-"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("no column `pier`"), "{run}");
    // Those of the declaration are others.
    folder.write("new.csv", "azimuth [deg],elevation [deg],side\n1,2,1\n");
    let run = folder.trueaxis(&["apply", "result/instrument.toml", "--data", "new.csv", "--out", "-"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("no column `Az`"), "{run}");
}

/// Inputs that follow from other columns are derived as the study says, in the order of the rows.
#[test]
fn what_follows_from_other_columns_is_derived() {
    let folder = Folder::new("columns-derived");
    folder.write(
        "axis.chain",
        "chain Axis {\n    input way;\n    body table on ground {\n        motion: Rz(-alpha);\n        motion_error: Rz(-(index + way*play));\n    }\n    \
         observe mark: direction(0, 1, 0) of table;\n}\n",
    );
    let study = "chain = \"axis.chain\"\ndata = \"runs.csv\"\n[columns]\nalpha = { column = \"a\", unit = \"deg\" }\n\
                 way = { derive = \"direction(alpha)\" }\n[observed]\nkind = \"spherical\"\nazimuth = { column = \"b\", unit = \"deg\" }\n\
                 [noise]\norder = \"n\"\n[hold_out]\nfolds = 3\n";
    folder.write("study.toml", study);
    // Up and down, index 20″ and play 10″; the first row has no way yet.
    let angle = |n: i32| f64::from(if (n / 10) % 2 == 0 { n % 10 } else { 10 - n % 10 }) * 7.0;
    let rows = (0..60).map(|n| {
        let way = if n == 0 { 0.0 } else { (angle(n) - angle(n - 1)).signum() };
        let noise = f64::from((n * 7) % 5 - 2) * 0.01;
        format!("{n},{:.3},{:.9}\n", angle(n), angle(n) + (20.0 + 10.0 * way + noise) / 3600.0)
    });
    folder.write("runs.csv", format!("n,a,b\n{}", rows.collect::<String>()));
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 0, "{run}");
    // Backwards in the file: the order says which came first.
    folder.write("new.csv", "n,a\n3,20\n2,30\n1,10\n");
    let text = apply(&folder, "new.csv", &[]);
    let off: Vec<f64> =
        numbers(&text, "b").iter().zip([20.0, 30.0, 10.0]).map(|(b, a)| (b - a) * 3600.0).collect();
    for (found, expected) in off.iter().zip([10.0, 30.0, 20.0]) {
        assert!((found - expected).abs() < 0.1, "{off:?}");
    }
}

/// Angles that the data count from 0 to 400 gon are written so.
#[test]
fn azimuths_go_round_as_the_data_have_them() {
    let folder = Folder::new("columns-round");
    folder.write("axis.chain", "chain Axis {\n    body table on ground { motion: Rz(-alpha); motion_error: Rz(-index); }\n    observe mark: direction(0, 1, 0) of table;\n}\n");
    let study = "chain = \"axis.chain\"\ndata = \"d.csv\"\n[columns]\nalpha = { column = \"a\" }\n[observed]\nkind = \"spherical\"\n\
                 azimuth = { column = \"b\" }\n[hold_out]\nfolds = 3\n";
    folder.write("study.toml", study);
    let rows = (0..30).map(|n| {
        let noise = f64::from((n * 7) % 5 - 2) * 1e-5;
        format!("{},{:.8}\n", n * 13, f64::from(n * 13) + 0.01 + noise)
    });
    folder.write("d.csv", format!("a [gon],b [gon]\n{}", rows.collect::<String>()));
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 0, "{run}");
    // A file that gives the reading in another unit says so in its heading.
    folder.write("new.csv", format!("a [rad]\n{}\n", -0.5 * PI));
    let text = apply(&folder, "new.csv", &[]);
    let found = numbers(&text, "b [gon]")[0];
    assert!((found - 300.01).abs() < 1e-4, "{found}");
}

/// A pipe gives its bytes once: nothing else looks at them first.
#[cfg(unix)]
#[test]
fn rows_out_of_a_pipe_are_corrected_as_those_of_a_file() {
    let folder = calibrated("instrument-pipe");
    let apply = |data: &str, rows: &str| {
        let arguments = ["apply", "result/instrument.toml", "--data", data, "--out", "-"];
        let run = run_in(&folder.0, &arguments, rows);
        assert_eq!(run.code, 0, "{run}");
        run.stdout
    };
    let rows = folder.read("stars.csv");
    assert_eq!(apply("/dev/stdin", &rows), apply("stars.csv", ""));
}
