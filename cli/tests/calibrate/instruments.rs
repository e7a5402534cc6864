//! Every example's study on measured data, through the whole command.

use serde_json::Value;

use crate::figures;
use crate::support::{root, trueaxis};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// The report of a study of `examples/`; `None` where its data are missing.
fn report(study: &str) -> Option<Value> {
    let path = format!("examples/{study}.toml");
    let text = std::fs::read_to_string(root().join(&path)).expect("the study is there");
    let data = "data       = \"../../../shared/data/";
    let data = text.lines().find_map(|line| line.strip_prefix(data)).expect("it names its data");
    testkit::measured(data.trim_end_matches('"'))?;
    let run = trueaxis(&["calibrate", &path, "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    Some(serde_json::from_str(&run.stdout).expect("JSON"))
}

fn number(report: &Value, path: &str) -> f64 {
    report.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {path}"))
}

/// Effects, rows and the bound on what the search leaves where it did not look, in the report's unit. Whether such
/// effects are all that an instrument does beyond its declaration nobody knows: every verdict that names a place will do.
fn holds(study: &str, rows: f64, bound: f64) -> Option<Value> {
    let report = report(study)?;
    let verdict = report["verdict"].as_str().expect("a word");
    let placed = ["confounded", "form not determined", "structure remains", "unnamed function"];
    assert!(placed.contains(&verdict), "{study}: {verdict}");
    assert_ne!(report["effects"], Value::Array(Vec::new()), "{study}");
    assert_eq!(number(&report, "/observations/rows"), rows, "{study}");
    let held_out = number(&report, "/after/held_out_rms_kept");
    assert!(held_out <= bound, "{study}: {held_out} is above {bound}");
    Some(report)
}

/// Sources of the RMS before: calibration/tests/reference/instruments.py, each component weighted by its own scatter, as
/// the command weights it when nothing is known of the noise.
#[test]
fn reports_say_what_an_independent_program_finds() {
    for (study, rows, bound_arcsec, reference_arcsec) in [
        ("auxtel/auxtel-2020-03", 44.0, 14.9, 22.280_896_192),
        ("equatorial/equatorial-a", 454.0, 165.0, 558.260_778_131),
    ] {
        let Some(report) = holds(study, rows, bound_arcsec * ARCSEC) else {
            return;
        };
        let before = number(&report, "/before/rms") / ARCSEC;
        // The command stops to learn the noise when it changes by less than a thousandth.
        assert!(
            (before / reference_arcsec - 1.0).abs() < 1e-4,
            "{study}: {before} is not {reference_arcsec}"
        );
        assert_eq!(report["observations"]["set_aside"], Value::Array(Vec::new()), "{study}");
    }
}

#[test]
fn the_telescopes_lack_effects_that_predict_what_nobody_fitted() {
    for (study, rows, bound_arcsec) in [
        ("auxtel/auxtel-2022-04", 54.0, 1.78),
        ("iram30m/iram30m-2013-04", 1110.0, 3.8),
        ("iram30m/iram30m-2013-10", 628.0, 3.6),
        ("equatorial/equatorial-b", 98.0, 62.0),
    ] {
        let Some(report) = holds(study, rows, bound_arcsec * ARCSEC) else {
            return;
        };
        assert!(number(&report, "/after/held_out_rms") >= number(&report, "/after/held_out_rms_kept"));
    }
}

#[test]
fn the_encoders_lack_effects_that_predict_what_nobody_fitted() {
    for study in ["encoder/encoder-a", "encoder/encoder-b"] {
        if holds(study, 200.0, 0.03_f64.to_radians()).is_none() {
            return;
        }
    }
}

/// What was planted stands in `examples/turntable/simulate.py`, which shares no code with ours.
#[test]
fn the_turntable_lacks_nothing() {
    let run = trueaxis(&["calibrate", "examples/turntable/turntable.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["verdict"], "nothing detectable");
    let planted = [("tilt_x", 20.0), ("tilt_y", -35.0), ("index", 60.0)];
    figures::holds(&report, &planted.map(|(name, planted_arcsec)| (name, planted_arcsec * ARCSEC)));
}
