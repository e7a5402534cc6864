//! Damaged and hostile instrument files: exit code 2, the place, and what to write instead; never a panic.

use insta::assert_snapshot;

use crate::support::{Folder, Run};
use crate::{calibrated, packed};

/// What `apply` says of the sample where one text in it is another.
fn with(name: &str, from: &str, to: &str) -> String {
    let folder = Folder::new(&format!("refused-{name}"));
    folder.copy("cli/tests/instrument/version-1.toml");
    let text = folder.read("version-1.toml");
    assert!(text.contains(from), "{from}: {text}");
    folder.write("instrument.toml", text.replacen(from, to, 1));
    let run = applied(&folder);
    assert_eq!(run.code, 2, "{name}: {run}");
    assert_eq!(run.stdout, "", "{name}");
    run.stderr
}

fn applied(folder: &Folder) -> Run {
    folder.write("new.csv", format!("Az,zenith,pier\n-100,{},1\n", packed(60.0)));
    folder.trueaxis(&["apply", "instrument.toml", "--data", "new.csv", "--out", "-"])
}

#[test]
fn a_later_version() {
    assert_snapshot!(with("later", "instrument = 1", "instrument = 2"));
}

#[test]
fn a_version_that_is_none() {
    assert_snapshot!(with("none", "instrument = 1", "instrument = \"one\""));
    assert!(with("zero", "instrument = 1", "instrument = 0").contains("write instrument = 1"));
}

#[test]
fn no_declaration() {
    assert_snapshot!(with("no-chain", "chain = '''", "chian = '''"));
}

#[test]
fn a_declaration_with_an_error() {
    assert_snapshot!(with("bad-chain", "Rx(tilt_x)", "Rw(tilt_x)"));
}

#[test]
fn an_unknown_symbol() {
    assert_snapshot!(with("symbol", "\ntilt_y ", "\ntilt_z "));
}

#[test]
fn an_unknown_constant() {
    assert_snapshot!(with("constant", "[constants]\narm", "[constants]\narn"));
}

#[test]
fn a_covariance_of_another_size() {
    assert_snapshot!(with("size", "of = [\"tilt_x\", ", "of = ["));
}

#[test]
fn a_covariance_that_is_not_symmetric() {
    let folder = Folder::new("refused-sample");
    let text = folder.copy("cli/tests/instrument/version-1.toml").read("version-1.toml");
    let (_, rows) = text.split_once("rows = [\n  [").expect("a covariance");
    let first = rows.split(',').nth(1).expect("a number").trim();
    assert_snapshot!(with("symmetric", &format!(", {first}"), ", 1.0"));
    assert_snapshot!(with("finite", &format!(", {first}"), ", nan"));
}

#[test]
fn values_that_are_not_finite() {
    for value in ["inf", "nan", "\"1e999 rad\""] {
        let said = with("value", "[errors]\ntilt_x ", &format!("[errors]\ntilt_x = {value}\n#"));
        assert!(said.contains("instrument.toml:") && said.contains("finite"), "{value}: {said}");
    }
}

#[test]
fn a_column_that_the_study_lacks() {
    assert_snapshot!(with("column", "[corrected.azimuth]", "[corrected.azimut]"));
}

#[test]
fn a_unit_of_something_else() {
    let of_study = "column = \"true az (deg)\"\nunit = ";
    assert_snapshot!(with("unit-of-study", &format!("{of_study}\"deg\""), &format!("{of_study}\"mm\"")));
    let of_data = "heading = \"true az (deg)\"\nunit = ";
    assert_snapshot!(with("unit-of-data", &format!("{of_data}\"deg\""), &format!("{of_data}\"mm\"")));
}

#[test]
fn a_study_that_names_what_the_declaration_lacks() {
    assert_snapshot!(with("study", "[study.columns.azimuth]", "[study.columns.azimutt]"));
}

#[test]
fn a_key_that_is_none() {
    assert_snapshot!(with("key", "instrument = 1", "instrument = 1\nvalid-till = 2027-01-01"));
}

/// Where the file ends early, or a byte of it is another, it is refused with a place, or read.
#[test]
fn no_damage_makes_it_panic() {
    let folder = Folder::new("refused-damaged");
    let text = folder.copy("cli/tests/instrument/version-1.toml").read("version-1.toml");
    let step = text.len() / 40;
    for at in (1..text.len()).step_by(step).filter(|at| text.is_char_boundary(*at)) {
        folder.write("instrument.toml", &text[..at]);
        let run = applied(&folder);
        assert!(run.code == 2 || run.code == 0, "{at}: {run}");
        assert!(!run.stderr.contains("panicked"), "{at}: {run}");
        let mut bytes = text.clone().into_bytes();
        bytes[at] = b'"';
        folder.write("instrument.toml", &bytes);
        let run = applied(&folder);
        assert!(run.code == 2 || run.code == 0, "{at}: {run}");
        assert!(!run.stderr.contains("panicked"), "{at}: {run}");
    }
}

#[test]
fn files_in_each_others_place_are_told_apart() {
    let folder = calibrated("refused-places");
    let data = ["--data", "stars.csv", "--out", "-"];
    let told = |arguments: &[&str], why: &str| {
        let run = folder.trueaxis(&[arguments, &data].concat());
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(why), "{run}");
    };
    let file = "result/instrument.toml";
    told(&["apply", file, "--errors", "result/errors.toml"], "leave --errors out");
    told(&["apply", "result/amended.chain"], "say --errors E.toml, or give the instrument file");
    told(&["apply", "result/amended.chain", "--errors", file], "give it in place of the declaration");
    let run = folder.trueaxis(&["derive", file]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("needed here is a declaration: give `amended.chain`"), "{run}");
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "again", "--valid-until", "soon"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("write a day, as 2027-06-30"), "{run}");
}
