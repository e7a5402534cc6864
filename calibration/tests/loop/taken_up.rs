//! A function that no effect of the catalogue is: taken up as an effect where it sits, told as what it is, and part of the
//! amended declaration, which leaves nothing more to find.

use calibration::calibrate::Calibration;
use calibration::diagnose::Verdict;
use model_core::Chain;
use study::{Plan, Study};

use crate::simulated::{lidar, measured, pointing, search};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

const RAMP: [&str; 2] = ["shape", "ramp(beta, "];

/// The study of a pointing.
fn plan(chain: &Chain) -> Plan {
    let study = "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n\
         [columns]\ntemperature = { column = \"t\", meaning = \"temperature\" }\n\
                 beta_direction = { column = \"b\", meaning = \"direction of beta\" }\n\
         [observed]\nkind = \"direction\"\n\
         [search]\nfunctions = true\ninputs = [\"temperature\", \"beta_direction\"]\n";
    Study::from_text(study).unwrap().plan(chain).unwrap()
}

/// Calibrates a scanner whose middle body turns about x by `moved` of the readings; what is left is noise, the declaration
/// holds the function, of a family and beginning with some words, and calibrating again finds nothing more.
fn taken_up(driver: &str, [family, words]: [&str; 2], moved: impl Fn([f64; 5]) -> f64 + Copy) -> Calibration {
    let text = lidar();
    let chain = Chain::from_text(&text).unwrap();
    let first = plan(&chain);
    let turned = text.replacen("Ry(db2),", "Rx(planted), Ry(db2),", 1);
    let turned = Chain::from_text(&turned).unwrap();
    let data = |plan: &Plan| {
        measured(plan, 600, 8, |readings| pointing(&turned, &[("planted", moved(readings))], readings))
    };
    let found = search(&text, &first, &data(&first));
    let report = &found.diagnosis;
    let names: Vec<_> = report.effects.iter().map(|effect| &effect.names).collect();
    assert_eq!(names.len(), 1, "{names:?} {:?}", report.verdict);
    assert_eq!(
        (report.effects[0].driver.as_str(), report.effects[0].dof.as_str()),
        (driver, "Rx"),
        "{names:?}"
    );
    assert_eq!(report.effects[0].causes[0].family, family, "{names:?}");
    let noise = 2.0 * ARCSEC * std::f64::consts::SQRT_2;
    let held_out = report.after.held_out_rms.unwrap();
    assert!((held_out / noise - 1.0).abs() < 0.1, "{}", held_out / noise);

    let amended = found.amended.clone().unwrap();
    assert!(amended.contains(words), "{amended}");
    let chain = Chain::from_text(&amended).unwrap();
    let second = plan(&chain);
    let again = search(&amended, &second, &data(&second));
    let more: Vec<_> = again.diagnosis.effects.iter().map(|effect| &effect.names).collect();
    assert!(more.is_empty(), "{names:?}, then {more:?}");
    found
}

#[test]
fn a_function_of_the_temperature_is_tabulated() {
    let found = taken_up("temperature", ["shape", "ramp(temperature, "], |[_, _, _, temperature, _]| {
        20.0 * ARCSEC * (0.5 * temperature).sin()
    });
    assert_eq!(found.diagnosis.verdict, Verdict::UnnamedFunction);
}

#[test]
fn a_step_and_a_saturating_ramp_are_named() {
    let found = taken_up("beta", RAMP, |[_, beta, ..]| if beta > 0.4 { 15.0 * ARCSEC } else { 0.0 });
    let name = &found.diagnosis.effects[0].names[0];
    assert!(name.starts_with("step at ") || name.starts_with("ramp from "), "{name}");
    assert!(matches!(found.diagnosis.verdict, Verdict::Explained | Verdict::Confounded), "{name}");

    let found = taken_up("beta", RAMP, |[_, beta, ..]| 25.0 * ARCSEC * ((beta + 0.5) / 0.9).clamp(0.0, 1.0));
    let name = &found.diagnosis.effects[0].names[0];
    assert!(name.starts_with("ramp from "), "{name}");
}

/// As large as the noise, where the catalogue goes to eight a turn: a gear, and a worm beyond it.
#[test]
fn waves_that_nobody_asked_for_are_named() {
    for order in [17, 360] {
        let found = taken_up("beta", ["high harmonic", &format!("cos({order}*beta)")], |[_, beta, ..]| {
            2.0 * ARCSEC * std::f64::consts::SQRT_2 * (f64::from(order) * beta + 0.4).cos()
        });
        let effect = &found.diagnosis.effects[0];
        assert!(effect.names[0].starts_with(&format!("harmonic, {order} per turn")), "{:?}", effect.names);
        assert!(effect.alias_orders.is_empty(), "{:?}", effect.alias_orders);
        assert!(matches!(found.diagnosis.verdict, Verdict::Explained | Verdict::Confounded), "{order}");
    }
}
