//! `compare`: what changed between calibrations.

use serde_json::Value;

use crate::support::{Folder, Run};
use crate::{ARCSEC, Errors, instrument, json};

const OLD: Errors = [3.0, -2.0, 40.0, 5.0];

/// Runs the command on these files, named in their order.
fn compare(name: &str, files: &[String], more: &[&str]) -> Run {
    let folder = Folder::new(&format!("monthly-compare-{name}"));
    let names: Vec<String> =
        (0..files.len()).map(|at| format!("{}.toml", char::from(b'a' + at as u8))).collect();
    for (name, text) in names.iter().zip(files) {
        folder.write(name, text);
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    folder.trueaxis(&[&["compare"], &names[..], more].concat())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn an_index_that_moved_is_named_and_everything_else_is_not() {
    let new = [3.1, -2.1, 52.0, 5.1];
    let files = [instrument(OLD), instrument(new)];
    let run = compare("moved", &files, &[]);
    assert_eq!(run.code, 1, "{run}");
    let first = run.stdout.lines().next().expect("a line");
    assert_eq!(first, "CHANGED. index moved by 12.00 ± 0.14″. Everything else is within its uncertainty.");
    assert!(run.stdout.contains("Over the common measured region pointing changed by 12.0"), "{run}");
    let found = json(&compare("moved-json", &files, &["--format", "json"]));
    // Independent errors of 0.1″ each: the sum of squares of the changes over 0.02.
    let expected = (0.1 * 0.1 * 3.0 + 144.0) / 0.02;
    assert!((number(&found["joint"]["chi_squared"]) / expected - 1.0).abs() < 1e-6, "{found}");
    assert_eq!(found["joint"]["degrees_of_freedom"], 4.0);
    let changed: Vec<&Value> =
        found["values"].as_array().into_iter().flatten().filter(|value| value["changed"] == true).collect();
    assert_eq!(changed.len(), 1, "{found}");
    assert_eq!(changed[0]["name"], "index");
}

#[test]
fn an_index_moves_what_is_observed_by_as_much_everywhere() {
    let files = [instrument(OLD), instrument([OLD[0], OLD[1], OLD[2] + 12.0, OLD[3]])];
    let found = json(&compare("index", &files, &["--format", "json"]));
    let observed = &found["observables"][0];
    for key in ["rms", "largest"] {
        assert!((number(&observed[key]) / ARCSEC - 12.0).abs() < 1e-4, "{found}");
    }
    // Along the change only the errors that raise or lower the tube count: the index, and of the tilts less over all azimuths.
    let uncertainty = number(&observed["rms_standard_uncertainty"]) / ARCSEC;
    assert!((uncertainty - 0.1 * 2.0_f64.sqrt()).abs() < 0.01, "{found}");
}

#[test]
fn the_same_file_did_not_change() {
    let files = [instrument(OLD), instrument(OLD)];
    let run = compare("same", &files, &[]);
    assert_eq!(run.code, 0, "{run}");
    assert!(
        run.stdout.starts_with("NO SIGNIFICANT CHANGE. All 4 values are within the uncertainty.\n"),
        "{run}"
    );
}

#[test]
fn what_one_file_alone_has_is_named() {
    let with = instrument(OLD)
        .replace("motion_error: Rx(index)", "motion_error: Rx(index + sag*cos(elevation))")
        .replace("[errors]\n", "[errors]\nsag = \"7 arcsec\"\n");
    for (name, files, file) in [
        ("new", [instrument(OLD), with.clone()], "b.toml"),
        ("old", [with.clone(), instrument(OLD)], "a.toml"),
    ] {
        let run = compare(&format!("alone-{name}"), &files, &[]);
        assert_eq!(run.code, 1, "{run}");
        let only = format!("ANOTHER MODEL. Only {file} has sag, 7.00″ (no ±).");
        assert!(run.stdout.starts_with(&only), "{run}");
        // 7″ times the cosine of the elevation, at most at 10°.
        let found = json(&compare(&format!("alone-{name}-json"), &files, &["--format", "json"]));
        let largest = number(&found["observables"][0]["largest"]) / ARCSEC;
        assert!((largest - 7.0 * 10.0_f64.to_radians().cos()).abs() < 0.01, "{found}");
    }
}

#[test]
fn instruments_that_differ_are_refused_with_what_differs() {
    let change = |from: &str, to: &str| {
        let text = instrument(OLD);
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    };
    for (name, other, why) in [
        (
            "place",
            change("Ry(tilt_y)", "Rz(tilt_y)"),
            "body `fork` has `Ry(tilt_y)` in the first and `Rz(tilt_y)` in the second",
        ),
        ("sign", change("motion: Rz(-azimuth)", "motion: Rz(azimuth)"), "body `fork` has"),
        ("observable", change("direction(0, 1, 0)", "direction(1, 0, 0)"), "observe pointing"),
        ("body", change("body fork", "body yoke").replace("on fork", "on yoke"), "body fork on ground"),
    ] {
        let run = compare(&format!("differ-{name}"), &[instrument(OLD), other], &[]);
        assert_eq!(run.code, 2, "{name}: {run}");
        assert!(
            run.stderr.contains("are of different instruments") && run.stderr.contains(why),
            "{name}: {run}"
        );
    }
}

#[test]
fn names_and_units_of_columns_do_not_matter() {
    let other = instrument(OLD)
        .replace("{ column = \"az\", unit = \"deg\" }", "{ column = \"Hz\", unit = \"gon\" }")
        .replace("chain Mount", "chain Telescope")
        .replace("/// A mount.", "/// The same mount.");
    let run = compare("columns", &[instrument(OLD), other], &[]);
    assert_eq!(run.code, 0, "{run}");
}

/// Four months of an index that drifts by 2″ a month.
#[test]
fn a_history_has_a_row_for_each_file_and_the_drift() {
    let files: Vec<String> =
        (0..4).map(|month| instrument([3.0, -2.0, 40.0 + 2.0 * f64::from(month), 5.0])).collect();
    let dates = ["--dates", "2026-01-01,2026-01-31,2026-03-02,2026-04-01"];
    let run = compare("history", &files, &dates);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("CHANGED. index is not one value in 4 files (p ≤ 0.001)."), "{run}");
    assert!(run.stdout.contains("drift per month"), "{run}");
    let found = json(&compare("history-json", &files, &[&dates[..], &["--format", "json"]].concat()));
    let index = found["values"].as_array().into_iter().flatten().find(|value| value["name"] == "index");
    let drift = number(&index.expect("the index")["drift_per_month"]) / ARCSEC;
    // Every thirty days.
    assert!((drift - 2.0 * 30.436_875 / 30.0).abs() < 1e-6, "{found}");
}

#[test]
fn arguments_that_do_not_fit_are_refused() {
    let files = [instrument(OLD), instrument(OLD)];
    for (name, more, why) in [
        ("dates", vec!["--dates", "2026-01-01"], "1 dates for 2 files"),
        ("no-date", vec!["--dates", "soon,later"], "write a day"),
    ] {
        let run = compare(name, &files, &more);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(why), "{run}");
    }
    assert_eq!(compare("one", &files[..1], &[]).code, 2);
    let far = instrument(OLD).replace("[\"10 deg\", \"80 deg\"]", "[\"85 deg\", \"88 deg\"]");
    let run = compare("region", &[instrument(OLD), far], &[]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("no common region") && run.stderr.contains("elevation"), "{run}");
}
