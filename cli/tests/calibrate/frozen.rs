//! A frozen model: exactly the study's terms are fitted, and what one term less or more does is told.

use std::fmt::Write;

use serde_json::Value;
use testkit::mount::ARCSEC;
use testkit::{Random, turned};

use crate::figures::{error, number};
use crate::support::{Folder, run_in};

const CHAIN: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

/// Stars seen by a mount with index errors, a tilted base, a bending tube, and an azimuth circle that sits off centre.
fn stars(off_centre: f64) -> String {
    let mut random = Random::new(53);
    let mut rows = "azimuth,elevation,x,y,z\n".to_owned();
    for _ in 0..150 {
        let (a, e) = (6.2 * random.even() - 3.1, 0.2 + 1.1 * random.even());
        let azimuth = a + (50.0 + off_centre * a.sin()) * ARCSEC + 2.0 * ARCSEC * random.normal() / e.cos();
        let elevation = e + (-30.0 - 40.0 * e.cos()) * ARCSEC + 2.0 * ARCSEC * random.normal();
        let sight = turned(2, -azimuth, turned(0, elevation, [0.0, 1.0, 0.0]));
        let [x, y, z] = turned(0, 25.0 * ARCSEC, turned(1, -15.0 * ARCSEC, sight));
        writeln!(rows, "{a:.9},{e:.9},{x:.9},{y:.9},{z:.9}").expect("a string");
    }
    rows
}

fn study(model: &str) -> String {
    format!(
        "chain = \"mount.chain\"\ndata = \"stars.csv\"\n\n[observed]\nkind = \"direction\"\nx = \"x\"\ny = \"y\"\nz = \"z\"\n\n\
         [columns]\nazimuth = {{ column = \"azimuth\", unit = \"rad\" }}\nelevation = {{ column = \"elevation\", unit = \"rad\" }}\n\n{model}\n"
    )
}

fn folder(name: &str, model: &str, off_centre: f64) -> Folder {
    let folder = Folder::new(&format!("frozen-{name}"));
    folder
        .write("mount.chain", CHAIN)
        .write("stars.csv", stars(off_centre))
        .write("study.toml", study(model));
    folder
}

const TERMS: &str = "[model]\nterms = [\"IA\", \"IE\", \"AN\", \"AW\", \"TF\"]";

#[test]
fn exactly_the_terms_are_fitted() {
    let folder = folder("fitted", TERMS, 12.0);
    let run = run_in(&folder.0, &["calibrate", "study.toml", "--out", "result"], "");
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("FROZEN MODEL FITTED"), "{run}");
    for told in [
        "`collimation`",
        "held at zero",
        "Terms, with the held-out RMS without each",
        "Would gain: encoder eccentricity of azimuth",
    ] {
        assert!(run.stdout.contains(told), "{told}: {run}");
    }
    let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    let model = &report["frozen"];
    let terms = model["terms"].as_array().expect("a list");
    let read: Vec<&str> = terms.iter().map(|own| own["read_as"].as_str().expect("a name")).collect();
    assert_eq!(
        read,
        ["azimuth_index", "elevation_index", "tilt_east", "tilt_north", "gravity flexure of tube about x"]
    );
    assert_eq!(model["held_at_zero"], serde_json::json!(["nonperpendicularity", "collimation"]));
    // Each term is there, so leaving it out is worse; and what else is there would gain.
    let with_all = number(&model["held_out_rms"]);
    for own in terms {
        assert!(number(&own["held_out_rms_without"]) > 1.2 * with_all, "{own}");
    }
    let other = &model["others"][0];
    assert!(other["accepted"] == true && number(&other["held_out_rms_with"]) < 0.8 * with_all, "{other}");
    let [index, sigma] = error(&report, "azimuth_index");
    assert!((index - 50.0 * ARCSEC).abs() < 5.0 * sigma, "{index} ± {sigma}");
    // Nothing but the terms is written.
    let amended = folder.read("result/amended.chain");
    assert!(amended.contains("gravity flexure of tube") && !amended.contains("eccentricity"), "{amended}");
    assert_eq!(report["effects"].as_array().map(Vec::len), Some(1));
}

/// The same names every night, so nights can be compared.
#[test]
fn nights_compare() {
    let names = ["first", "second"].map(|night| {
        let folder = folder(night, TERMS, 0.0);
        let run = run_in(&folder.0, &["calibrate", "study.toml", "--out", "result"], "");
        assert_eq!(run.code, 0, "{run}");
        folder
    });
    let [first, second] = names.each_ref().map(|night| night.0.join("result/instrument.toml"));
    let told = [&first, &second].map(|path| path.to_str().expect("UTF-8"));
    let run = run_in(&names[0].0, &["compare", told[0], told[1]], "");
    assert_eq!(run.code, 0, "{run}");
}

#[test]
fn a_term_that_is_none_is_refused_with_the_nearest_name() {
    for (model, told) in [
        ("[model]\nterms = [\"IA\", \"IF\"]", "did you mean `I"),
        ("[model]\nterms = [\"azimuth_indx\"]", "did you mean `azimuth_index`?"),
        ("[model]\nterms = [\"IA\", \"azimuth_index\"]", "are the same term"),
        ("[model]\nterms = []", "no term is a declared error"),
        ("[model]\nterms = [\"TF\"]", "no term is a declared error"),
        ("[model]\nterms = [\"IA\", \"gravity\"]", "is a family of"),
        ("[model]\nterms = [\"IA\"]\n[fit]\nfix = { azimuth_index = 0 }", "is fixed under [fit]"),
        ("[model]\nterms = [\"IA\"]\n[search]\neffects = [\"TF\"]", "leave one of them out"),
        ("[model]\nterm = [\"IA\"]", "terms"),
    ] {
        let folder = folder("refused", model, 0.0);
        let run = run_in(&folder.0, &["calibrate", "study.toml"], "");
        assert!(run.code == 2 && run.stderr.contains(told), "{model}: {run}");
    }
}
