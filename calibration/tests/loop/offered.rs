//! A function that no effect of the catalogue is, offered for the study: written there, it is found and declared.

use calibration::diagnose::Verdict;
use study::{Plan, Study};
use model_core::Chain;

use crate::simulated::{lidar, measured, pointing, search};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// The study of a pointing, with more lines.
fn plan(chain: &Chain, more: &str) -> Plan {
    let study = format!(
        "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n\
         [columns]\ntemperature = {{ column = \"t\", meaning = \"temperature\" }}\n\
         beta_direction = {{ column = \"b\", meaning = \"direction of beta\" }}\n\
         [observed]\nkind = \"direction\"\n\
         [search]\ninputs = [\"temperature\", \"beta_direction\"]\n{more}"
    );
    Study::from_text(&study).unwrap().plan(chain).unwrap()
}

/// Calibrates a scanner whose middle body turns about x by `moved` of the readings; then again with what is offered.
fn again_with_the_offer(driver: &str, moved: impl Fn([f64; 5]) -> f64 + Copy) {
    let text = lidar();
    let chain = Chain::from_text(&text).unwrap();
    let first = plan(&chain, "");
    let turned = text.replacen("Ry(db2),", "Rx(planted), Ry(db2),", 1);
    let turned = Chain::from_text(&turned).unwrap();
    let observations =
        measured(&first, 600, 8, |readings| pointing(&turned, &[("planted", moved(readings))], readings));
    let report = search(&text, &first, &observations).diagnosis;
    assert_eq!(report.verdict, Verdict::UnnamedFunction, "{:?} {:?}", report.effects, report.remaining);
    let remaining = report.remaining.unwrap();
    assert_eq!(remaining.place.as_ref().unwrap().driver, driver, "{:?}", remaining.place);
    let offer = remaining.offer.unwrap();

    let second = plan(&chain, &offer);
    let report = search(&text, &second, &observations).diagnosis;
    assert!(
        matches!(report.verdict, Verdict::Explained | Verdict::Confounded),
        "{:?} {:?}\n{offer}",
        report.verdict,
        report.remaining
    );
    let name = &report.effects[0].names[0];
    assert!(name.starts_with(&format!("function of {driver} at ")), "{name}");
    let noise = 2.0 * ARCSEC * std::f64::consts::SQRT_2;
    let held_out = report.after.held_out_rms.unwrap();
    assert!((held_out / noise - 1.0).abs() < 0.1, "{}", held_out / noise);
}

#[test]
fn a_function_of_the_temperature_is_taken_up() {
    again_with_the_offer("temperature", |[_, _, _, temperature, _]| {
        20.0 * ARCSEC * (0.5 * temperature).sin()
    });
}

#[test]
fn a_function_of_a_joint_is_taken_up() {
    again_with_the_offer("beta", |[_, beta, ..]| 30.0 * ARCSEC * (2.0 * beta.sin()).exp() / 2.0f64.exp());
}
