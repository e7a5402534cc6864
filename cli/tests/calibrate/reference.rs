//! `[reference]`: what the study states of the reference is in the ± and in the budgets, and what cannot be stated is refused.

use serde_json::Value;

use crate::figures::{error, number};
use crate::support::{Folder, Run, root, run_in};

const STUDY: &str = include_str!("../../../examples/slides/clean.toml");

fn folder(name: &str, reference: &str) -> Folder {
    let folder = Folder::new(&format!("reference-{name}"));
    for file in ["machine.chain", "clean.csv"] {
        folder
            .write(file, std::fs::read_to_string(root().join("examples/slides").join(file)).expect("there"));
    }
    folder.write("study.toml", format!("{STUDY}\n{reference}\n"));
    folder
}

fn calibrated(folder: &Folder) -> Run {
    run_in(&folder.0, &["calibrate", "study.toml", "--out", "result"], "")
}

#[test]
fn a_scale_is_in_the_uncertainties_and_in_the_budgets() {
    let folder = folder("scale", "[reference]\nscale = \"2 ppm\"\nrotation = \"1 arcsec\"\nshift = \"5 um\"");
    let run = calibrated(&folder);
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    let [_, uncertainty] = error(&report, "scale_x");
    // The rows alone know it to 0.1 ppm.
    assert!((2e-6..2.1e-6).contains(&uncertainty), "{uncertainty}");
    let budgets = report["budgets"].as_array().expect("a list");
    let own = budgets.iter().find(|own| own["of"] == "scale_x").expect("a budget");
    let parts = own["parts"].as_array().expect("a list");
    let of = |input: &str| parts.iter().find(|part| part["input"] == input).expect("a part");
    assert!((number(&of("scale of the reference")["sensitivity"]) - 1.0).abs() < 1e-3, "{own}");
    assert_eq!(of("scatter of the rows")["kind"], "A");
    let squares: f64 = parts.iter().map(|part| number(&part["contribution"]).powi(2)).sum();
    assert!((squares.sqrt() / number(&own["standard_uncertainty"]) - 1.0).abs() < 1e-9);
    assert!((number(&own["coverage"]) - 1.96).abs() < 0.01, "{own}");
    assert!(budgets.iter().any(|own| own["of"] == "corrected reading"), "{report}");
    let page = folder.read("result/report.html");
    assert!(page.contains("Uncertainty budgets (GUM)"));
    assert!(folder.read("result/instrument.toml").contains("[covariance]"));
}

#[test]
fn what_cannot_be_stated_is_refused() {
    for (name, reference, told) in [
        ("zero", "scale = 0", "is positive"),
        ("negative", "shift = \"-1 mm\"", "is positive"),
        ("nan", "scale = nan", "nan"),
        ("infinite", "scale = inf", "inf"),
        ("large", "targets = \"3 m\"", "no small error"),
        ("dimension", "targets = \"2 ppm\"", "ppm"),
        ("bare", "shift = 2", "without a unit"),
        ("unknown", "scales = \"2 ppm\"", "scale"),
        ("empty", "", "states no uncertainty"),
        ("alone", "target = \"nest\"", "targets = "),
        ("column", "targets = \"0.1 mm\"\ntarget = \"nest\"", "nest"),
    ] {
        let folder = folder(name, &format!("[reference]\n{reference}"));
        let run = calibrated(&folder);
        assert_eq!(run.code, 2, "{name}: {run}");
        assert!(run.stderr.contains(told), "{name}: {run}");
        assert!(!folder.0.join("result").exists(), "{name}");
    }
}
