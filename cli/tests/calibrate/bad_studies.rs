//! Slips in a study, or in the data that it names.

use insta::assert_snapshot;

use crate::support::Folder;

const CHAIN: &str = "chain Turntable {
    body table on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(azimuth);
    }
    observe pointing: direction(1, 0, 0) of table;
}
";

const STUDY: &str = "chain = \"turntable.chain\"
observable = \"pointing\"
data = \"measured.csv\"

[columns]
azimuth = { column = \"az\", unit = \"deg\" }

[observed]
kind = \"direction\"
x = \"x\"
y = \"y\"
z = \"z\"
";

const DATA: &str = "az,x,y,z\n0,1,0,0\n90,0,1,0\n180,-1,0,0\n";

/// What `calibrate` says of a chain, a study and data with one place changed.
fn refused(name: &str, from: &str, to: &str) -> String {
    let parts = [CHAIN, STUDY, DATA];
    assert!(parts.iter().any(|part| part.contains(from)), "{from}");
    let [chain, study, data] = parts.map(|part| part.replacen(from, to, 1));
    let folder = Folder::new(&format!("study-{name}"));
    folder.write("turntable.chain", chain).write("study.toml", study).write("measured.csv", data);
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
    assert!(!folder.names().contains(&"result".to_owned()), "nothing is written");
    run.stderr
}

/// How uncertain readings are is a positive figure, or a column of its own, and said of joints and inputs alone.
#[test]
fn uncertain_readings() {
    let column = "azimuth = { column = \"az\", unit = \"deg\" }";
    let with = |sigma: &str| format!("azimuth = {{ column = \"az\", unit = \"deg\", sigma = {sigma} }}");
    let said = |name: &str, sigma: &str| refused(name, column, &with(sigma));
    assert_snapshot!(said("sigma-negative", "\"-1 arcsec\""));
    assert_snapshot!(said("sigma-unit", "\"1 mm\""));
    assert_snapshot!(said("sigma-column", "{ column = \"std\", unit = \"deg\" }"));
    assert_snapshot!(said("sigma-two", "[\"a\", \"b\"]"));
    assert_snapshot!(said("sigma-below", "{ column = \"x\", unit = \"deg\" }"));
    assert_snapshot!(said("sigma-twice", "{ column = \"x\", unit = \"deg\", sigma = \"1 arcsec\" }"));
    assert_snapshot!(refused("sigma-observed", "x = \"x\"", "x = { column = \"x\", sigma = \"1 arcsec\" }"));
    let derived = "azimuth = { derive = \"turns(az)\", sigma = \"1 arcsec\" }";
    assert_snapshot!(refused("sigma-derived", column, derived));
}

#[test]
fn misspelt_key() {
    assert_snapshot!(refused("key", "observable =", "observble ="));
}

#[test]
fn chain_that_is_not_there() {
    assert_snapshot!(refused("chain", "turntable.chain\"\nobs", "turntabel.chain\"\nobs"));
}

#[test]
fn data_that_are_not_there() {
    assert_snapshot!(refused("data", "measured.csv", "mesured.csv"));
}

#[test]
fn unknown_observable() {
    assert_snapshot!(refused("observable", "\"pointing\"", "\"pointings\""));
}

#[test]
fn unknown_joint() {
    assert_snapshot!(refused("joint", "azimuth = {", "azimut = {"));
}

#[test]
fn unknown_kind() {
    assert_snapshot!(refused("kind", "\"direction\"", "\"directions\""));
}

#[test]
fn missing_column() {
    assert_snapshot!(refused("column", "column = \"az\"", "column = \"azi\""));
}

#[test]
fn angle_without_a_unit() {
    assert_snapshot!(refused("unit", ", unit = \"deg\"", ""));
}

#[test]
fn length_for_an_angle() {
    assert_snapshot!(refused("length", "unit = \"deg\"", "unit = \"mm\""));
}

#[test]
fn cell_that_is_no_number() {
    assert_snapshot!(refused("number", "90,0,1,0", "ninety,0,1,0"));
}

#[test]
fn not_a_number() {
    assert_snapshot!(refused("nan", "90,0,1,0", "90,NaN,1,0"));
}

#[test]
fn empty_data() {
    assert_snapshot!(refused("empty", DATA, ""));
}

#[test]
fn header_alone() {
    assert_snapshot!(refused("header", DATA, "az,x,y,z\n"));
}

#[test]
fn direction_that_is_none() {
    assert_snapshot!(refused("length-of-direction", "90,0,1,0", "90,0,100,0"));
}

#[test]
fn mistake_in_the_chain() {
    assert_snapshot!(refused("in-chain", "Rz(azimuth)", "Rq(azimuth)"));
}

#[test]
fn own_effect_of_an_unknown_joint() {
    let effect = "[[effect]]\nname = \"cable\"\nbody = \"table\"\nmoves = \"Rz\"\nfunctions = [\"sin(2*azimut)\"]\n\n[columns]";
    assert_snapshot!(refused("own-effect", "[columns]", effect));
}

#[test]
fn unknown_name_of_an_effect() {
    assert_snapshot!(refused("chosen-effect", "[columns]", "[search]\neffects = [\"encodre\"]\n\n[columns]"));
}

#[test]
fn empty_study() {
    assert_snapshot!(refused("empty-study", STUDY, ""));
}

/// A number out of its range, a text for a number, a key that is missing or stands twice: each with what to write.
#[test]
fn keys_that_cannot_be_read() {
    let hold_out = |folds: &str| format!("[hold_out]\nfolds = {folds}\n\n[columns]");
    assert_snapshot!(refused("one-fold", "[columns]", &hold_out("1")));
    assert_snapshot!(refused("text-for-folds", "[columns]", &hold_out("\"ten\"")));
    assert_snapshot!(refused("no-kind", "kind = \"direction\"\n", ""));
    assert_snapshot!(refused("twice", "[columns]", "data = \"other.csv\"\n\n[columns]"));
    assert_snapshot!(refused("no-quotes", "\"turntable.chain\"\nobs", "turntable.chain\nobs"));
    assert_snapshot!(refused("far-shift", "unit = \"deg\"", "unit = \"deg\", shift = 3"));
}

#[test]
fn one_sigma_for_angles_and_lengths() {
    let also = "z = \"z\"

[[also]]
observable = \"edge\"
data = \"measured.csv\"
columns = { azimuth = { column = \"az\", unit = \"deg\" } }
observed = { kind = \"point\", x = \"x\", y = \"y\", z = \"z\" }

[noise]
sigma = \"2 arcsec\"
";
    let folder = Folder::new("study-one-sigma");
    let edge = CHAIN.replace("    observe", "    observe edge: point(1, 0, 0) of table;\n    observe");
    folder.write("turntable.chain", edge).write("measured.csv", DATA);
    folder.write("study.toml", STUDY.replace("z = \"z\"\n", also));
    let run = folder.trueaxis(&["calibrate", "study.toml"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
    assert_snapshot!(run.stderr);
}

/// An orientation has a kind of its own; columns that a kind does not read are not passed over.
#[test]
fn a_direction_is_no_orientation() {
    let turned = "observe pointing: orientation of table;";
    let shown = refused("turned", "observe pointing: direction(1, 0, 0) of table;", turned);
    assert!(shown.contains("`pointing` is an orientation, which this kind does not measure"), "{shown}");
    assert!(shown.contains("kind = \"orientation\""), "{shown}");
    let named = refused("turned_key", "x = \"x\"", "rotation_x = \"x\"");
    assert!(named.contains("`rotation_x` is no column of this kind"), "{named}");
    assert!(named.contains("it reads `x`, `y`, `z`: leave the other out"), "{named}");
}
