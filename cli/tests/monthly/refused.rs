//! Files in each other's place, damaged files and impossible requests: exit code 2, and what to do.

use crate::support::Run;
use crate::{Errors, SPREAD, folder, instrument, rows};

const ERRORS: Errors = [3.0, -2.0, 40.0, 5.0];

fn verify(name: &str, text: &str, data: &str, more: &[&str]) -> Run {
    let folder = folder(&format!("refused-{name}"), text);
    folder.write("ten.csv", data);
    let run = folder.trueaxis(&[&["verify", "instrument.toml", "--data", "ten.csv"], more].concat());
    assert!(!run.stderr.contains("panicked"), "{run}");
    run
}

fn refuses(name: &str, text: &str, data: &str, more: &[&str], why: &str) {
    let run = verify(name, text, data, more);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{name}: {run}");
    assert!(run.stderr.contains(why), "{name}: {run}");
}

fn ten() -> String {
    rows(ERRORS, &SPREAD, 1.0, 7)
}

#[test]
fn files_that_are_no_instrument_files() {
    let text = instrument(ERRORS);
    let chain = text.split("'''").nth(1).expect("a chain");
    let why = "is no instrument file: give the `instrument.toml`";
    for (name, other) in
        [("chain", chain), ("errors", "tilt_x = \"3 arcsec\"\n"), ("empty", ""), ("data", &ten())]
    {
        refuses(name, other, &ten(), &[], why);
        let folder = folder(&format!("refused-compare-{name}"), &text);
        folder.write("other", other);
        for files in [["instrument.toml", "other"], ["other", "instrument.toml"]] {
            let run = folder.trueaxis(&[&["compare"], &files[..]].concat());
            assert_eq!(run.code, 2, "{name}: {run}");
            assert!(run.stderr.contains(why), "{name}: {run}");
        }
    }
}

#[test]
fn instruments_that_lack_something() {
    let text = instrument(ERRORS);
    let start = |key: &str| text.find(key).expect("a table");
    let without = |from: &str, to: &str| format!("{}{}", &text[..start(from)], &text[start(to)..]);
    refuses("no-noise", &without("[[noise]]", "[study]"), &ten(), &[], "has no [[noise]]");
    let bare = without("[covariance]", "[[noise]]");
    refuses("no-covariance", &bare, &ten(), &[], "has no [covariance]");
    refuses("no-study", &without("[[noise]]", "[provenance]"), &ten(), &[], "has no [study]");
    let folder = folder("refused-bare", &bare);
    folder.write("new.csv", "az,el\n10,20\n");
    let run = folder.trueaxis(&["compare", "instrument.toml", "instrument.toml"]);
    assert_eq!((run.code, run.stderr.contains("has no [covariance]")), (2, true), "{run}");
    let apply = ["apply", "instrument.toml", "--data", "new.csv", "--uncertainty", "--out", "-"];
    let run = folder.trueaxis(&apply);
    assert_eq!((run.code, run.stderr.contains("has no [covariance]")), (2, true), "{run}");
}

#[test]
fn covariances_and_noises_that_are_none() {
    let text = instrument(ERRORS);
    let (head, rows) = text.split_once("rows = [\n  [").expect("a covariance");
    let variance = rows.split(',').next().expect("a number");
    let with = |first: &str| {
        // Two estimates with a correlation of 2.
        let twice = format!("{:e}", 2.0 * variance.parse::<f64>().expect("a number"));
        let rows = rows.replacen(", 0.0", &format!(", {twice}"), 1);
        let rows = rows.replacen("[0.0,", &format!("[{twice},"), 1);
        format!("{head}rows = [\n  [{first}{}", &rows[variance.len()..])
    };
    refuses("negative", &with(variance), &ten(), &[], "this is no covariance");
    let sigma = text.find("sigma = [").expect("a noise");
    for (name, noise, why) in [
        ("zero", "sigma = [0.0, 1e-6]", "this is no standard deviation"),
        ("nan", "sigma = [nan, 1e-6]", "this is no standard deviation"),
        ("three", "sigma = [1e-6, 1e-6, 1e-6]", "3 standard deviations for 2 components"),
    ] {
        let end = sigma + text[sigma..].find('\n').expect("a line");
        refuses(name, &format!("{}{noise}{}", &text[..sigma], &text[end..]), &ten(), &[], why);
    }
    let wrong = text.replace("degrees-of-freedom = 400.0", "degrees-of-freedom = 0");
    refuses("freedom", &wrong, &ten(), &[], "these are no degrees of freedom");
}

#[test]
fn data_that_cannot_be_read() {
    let text = instrument(ERRORS);
    refuses("no-rows", &text, "az,el,true_az,true_el\n", &[], "ten.csv");
    refuses("no-column", &text, "az,el,true_az\n1,20,1\n", &[], "true_el");
    refuses("no-number", &text, "az,el,true_az,true_el\n1,20,1,north\n", &[], "north");
    let run = verify("nan", &text, &(ten() + "5,20,NaN,20\n"), &[]);
    assert_eq!((run.code, run.stderr.contains("ten.csv")), (2, true), "{run}");
    let folder = folder("refused-missing", &text);
    let run = folder.trueaxis(&["verify", "instrument.toml", "--data", "none.csv"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("none.csv"), "{run}");
}

#[test]
fn goals_and_chances_that_are_none() {
    let text = instrument(ERRORS);
    for (name, more, why) in [
        ("length", ["--goal", "5 mm"], "--goal"),
        ("goal-zero", ["--goal", "0 arcsec"], "write a size above zero"),
        ("goal-word", ["--goal", "small"], "--goal"),
        ("chance", ["--false-alarm", "1.5"], "between 0 and 1"),
        ("chance-nan", ["--false-alarm", "nan"], "between 0 and 1"),
    ] {
        refuses(name, &text, &ten(), &more, why);
    }
}
