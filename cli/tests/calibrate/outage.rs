//! A trajectory that says how uncertain its poses are: half of the time the satellites are out of sight.

use std::fmt::Write;

use serde_json::Value;

use crate::drive::{Off, ROWS, drive, held, report};
use crate::figures::first_effect;

/// Three outages, during which poses are off ten times as far, each by itself.
const OUTAGES: Off =
    Off { remembered: None, times: |row| if row * 6 / ROWS % 2 == 1 { 5.0 } else { 0.5 }, stated: 1.0 };

const READINGS: [(&str, &str); 6] =
    [("east", "m"), ("north", "m"), ("up", "m"), ("heading", "rad"), ("pitch", "rad"), ("roll", "rad")];

/// What says where the uncertainties stand.
fn stated() -> String {
    let mut more = "\n[columns]\n".to_owned();
    for (name, unit) in READINGS {
        let sigma = format!("{{ column = \"s_{name}\", unit = \"{unit}\" }}");
        writeln!(more, "{name} = {{ column = \"{name}\", sigma = {sigma} }}").expect("a string takes all");
    }
    more
}

/// What is determined of `name`, in whatever combination: its standard uncertainty.
fn uncertainty(report: &Value, name: &str) -> f64 {
    let own = report["estimable"].as_array().expect("a list").iter();
    let own = own.map(|own| (&own["combination"][0]["error"], &own["standard_uncertainty"]));
    let mut own = own.filter_map(|(error, sigma)| (error == name).then_some(sigma.as_f64()?));
    own.next().unwrap_or_else(|| panic!("no {name}: {}", report["estimable"]))
}

/// The scanner's own noise is 3 mm, and nothing is made of the rest.
#[test]
fn poses_weigh_as_much_as_they_say_and_noise_in_them_is_no_function_of_them() {
    let (mut all, mut within) = (0, 0);
    for seed in 1..=4 {
        let data = drive(seed, &OUTAGES, 0.0);
        let report = report(&format!("outage-{seed}"), &data, &stated());
        assert!(report["effects"].as_array().is_some_and(Vec::is_empty), "{seed}: {}", report["effects"]);
        assert_eq!(report["verdict"], "nothing detectable", "{seed}: {}", report["remaining"]);
        let sigma = report["noise"]["series"][0]["sigma"][0].as_f64().expect("a number");
        assert!(sigma < 0.006, "{seed}: {sigma} m");
        assert_eq!(report["noise"]["readings"].as_array().map(Vec::len), Some(6), "{}", report["noise"]);
        let [own, held] = held(&report);
        (all, within) = (all + own, within + held);
    }
    assert!(all >= 16 && within * 10 >= all * 8, "{within} of {all}");
}

#[test]
fn what_the_declaration_lacks_is_found_beside_outages_and_values_are_surer() {
    let data = drive(5, &OUTAGES, 1e-3);
    let with = report("outage-planted", &data, &stated());
    assert_eq!(with["effects"].as_array().map(Vec::len), Some(1), "{}", with["effects"]);
    assert!(first_effect(&with).contains("encoder eccentricity of angle"), "{}", with["effects"]);
    let without = report("outage-unstated", &drive(5, &OUTAGES, 0.0), "");
    assert!(uncertainty(&with, "latency") < 0.7 * uncertainty(&without, "latency"), "{with} {without}");
}

/// Heights that were read with 53 mm of noise look like a function of height: that is no finding, or it is told together with how large
/// such noise would be.
#[test]
fn noise_that_nobody_stated_is_no_finding_by_itself() {
    for seed in 8..=13 {
        let report = report(&format!("outage-silent-{seed}"), &drive(seed, &OUTAGES, 0.0), "");
        let is_found = !report["effects"].as_array().expect("a list").is_empty();
        let is_placed = report["remaining"]["where"]["driver"] == "up";
        let cautions = report["cautions"].as_array().expect("a list");
        let noisy = cautions.iter().find(|own| own["kind"] == "noise in readings looks like it");
        assert!(noisy.is_some() || !is_found && !is_placed, "{seed}: {report}");
        if let Some(noisy) = noisy {
            assert_eq!(noisy["reading"], "up", "{noisy}");
            let sigma = noisy["sigma"].as_f64().expect("a number");
            assert!((0.015..0.08).contains(&sigma), "{seed}: {sigma} m");
        }
    }
}

/// Where a study states a hundred times what there is, or a fiftieth, rows weigh as the residuals say, and the reader is told.
#[test]
fn what_is_stated_of_poses_is_held_against_the_residuals() {
    let modest = "\n[columns]\neast = { column = \"east\", sigma = \"20 cm\" }\n".to_owned();
    let close = Off { times: |_| 0.5, ..OUTAGES };
    let bold = Off { stated: 0.02, ..OUTAGES };
    for (seed, study, off) in [(6, modest, close), (7, stated(), bold)] {
        let report = report(&format!("outage-{seed}"), &drive(seed, &off, 0.0), &study);
        let [all, within] = held(&report);
        assert!(all >= 4 && within + 1 >= all, "{seed}: {within} of {all}");
        let cautions = report["cautions"].as_array().expect("a list").iter();
        let kinds: Vec<&str> = cautions.filter_map(|own| own["kind"].as_str()).collect();
        assert_eq!(kinds, ["readings not as uncertain as stated"], "{seed}: {}", report["cautions"]);
    }
}
