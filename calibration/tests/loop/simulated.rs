//! Planted effects: eight kinds are named, two at once, none gives nothing, a bump in no catalogue is placed.

use calibration::calibrate::{Calibration, Request, calibrate};
use calibration::diagnose::{Diagnosis, EffectFound, Verdict};
use model_core::{Chain, SymbolId, exact};
use nalgebra::Vector3;
use observe::{Measure, Measured, Observations, Poses, Series, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use study::{Plan, Study};

use crate::data::root;

const ARCSEC: f64 = std::f64::consts::PI / 180.0 / 3600.0;
const NOISE: f64 = 2.0 * ARCSEC;

pub(crate) fn lidar() -> String {
    std::fs::read_to_string(root().join("examples/mobile-lidar/mobile-lidar.chain")).unwrap()
}

/// A study of the pointing, with a temperature measured beside it.
fn plan(chain: &Chain) -> Plan {
    let study = "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n\
                 [columns]\ntemperature = { column = \"t\", meaning = \"temperature\" }\n\
                 beta_direction = { column = \"b\", meaning = \"direction of beta\" }\n\
                 [observed]\nkind = \"direction\"\n\
                 [search]\ninputs = [\"temperature\", \"beta_direction\"]\n";
    Study::from_text(study).unwrap().plan(chain).unwrap()
}

/// Readings and what was observed at them, each row a group of its own.
pub(crate) fn observed_alone(
    chain: &Chain,
    observable: &str,
    measure: Measure,
    mut columns: Vec<(SymbolId, Vec<f64>)>,
    measured: Vec<Measured>,
) -> Observations {
    columns.sort_by_key(|(id, _)| *id);
    let rows = measured.len();
    let observable = chain.find_observable(observable).unwrap();
    let series = Series { observable, measure, rows: 0..rows, source: "simulated".to_owned() };
    Observations {
        poses: Poses { series: vec![series], columns },
        measured,
        groups: (0..rows as u32).collect(),
        row_numbers: (1..=rows as u64).collect(),
        ..Observations::default()
    }
}

/// Observations of a plan's chain at random poses: `truth` turns the readings (alpha, beta, gamma, temperature,
/// direction of beta) into what the instrument does.
pub(crate) fn measured(
    plan: &Plan,
    rows: usize,
    seed: u64,
    truth: impl Fn([f64; 5]) -> Vector3<f64>,
) -> Observations {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let names = ["alpha", "beta", "gamma", "temperature", "beta_direction"];
    let mut columns: Vec<(SymbolId, Vec<f64>)> =
        names.iter().map(|name| (plan.chain.find_symbol(name).unwrap(), Vec::new())).collect();
    let mut observed = Vec::new();
    for _ in 0..rows {
        let mut turn = || random.random_range(-3.1..3.1);
        let (alpha, beta, gamma) = (turn(), turn(), turn());
        let temperature = random.random_range(10.0..30.0);
        let direction = if random.random_range(0.0..1.0) < 0.5 { -1.0 } else { 1.0 };
        let readings = [alpha, beta, gamma, temperature, direction];
        columns.iter_mut().zip(readings).for_each(|((_, column), value)| column.push(value));
        let aim = truth(readings).normalize();
        let [across, along] = tangent_frame(&aim);
        let noise = [(); 2].map(|()| NOISE * random.sample::<f64, _>(StandardNormal));
        observed.push(Measured::Direction((aim + across * noise[0] + along * noise[1]).normalize()));
    }
    observed_alone(&plan.chain, "pointing", Measure::Direction, columns, observed)
}

/// The pointing of a chain text with some errors set, at some readings.
pub(crate) fn pointing(chain: &Chain, errors: &[(&str, f64)], readings: [f64; 5]) -> Vector3<f64> {
    let mut values = chain.nominal_values();
    let names = ["alpha", "beta", "gamma", "temperature", "beta_direction"];
    for (name, value) in names.into_iter().zip(readings).chain(errors.iter().copied()) {
        if let Some(id) = chain.find_symbol(name) {
            values[id.index()] = value;
        }
    }
    exact::value(chain, chain.find_observable("pointing").unwrap(), &values)
}

pub(crate) fn search(text: &str, plan: &Plan, observations: &Observations) -> Calibration {
    calibrate(Request { text, plan, observations, sample: None, second: None, when: "2026-11-21" }).unwrap()
}

/// The lidar with `lines` added to the middle frame's motion errors.
fn planted(lines: &str) -> Chain {
    let text = lidar().replacen(
        "    input range",
        "    input temperature;\n    input beta_direction;\n    input range",
        1,
    );
    let text = text.replacen("Rz(dg2);", &format!("Rz(dg2);\n        motion_error: {lines};"), 1);
    Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("planted", &text)))
}

/// What a search reports after planting.
fn found(lines: &str, errors: &[(&str, f64)], seed: u64) -> Diagnosis {
    let text = lidar();
    let plan = plan(&Chain::from_text(&text).unwrap());
    let truth = planted(lines);
    let declared = [("dtheta_y1", 20.0 * ARCSEC), ("dtheta_x3", -15.0 * ARCSEC)];
    let all: Vec<(&str, f64)> = declared.iter().chain(errors).copied().collect();
    let observations = measured(&plan, 300, seed, |readings| pointing(&truth, &all, readings));
    search(&text, &plan, &observations).diagnosis
}

/// Whether an effect goes by a name, alone or in its set.
fn called(effect: &EffectFound, name: &str) -> bool {
    effect.names.iter().chain(&effect.confounded_with).any(|known| known == name)
}

#[test]
fn eight_kinds_are_named_right() {
    let six = 6.0 * ARCSEC;
    let both = || vec![("p", six), ("q", six)];
    for (line, errors, name, verdict) in [
        (
            "Rx(p*cos(beta) + q*sin(beta))",
            both(),
            "encoder eccentricity of beta",
            // A coupling into the outer frame about the parallel axis does the very same, and beside the declared errors
            // gravity that winds the joint up.
            Verdict::Confounded,
        ),
        (
            "Rx(p*cos(2*beta) + q*sin(2*beta))",
            both(),
            "encoder ellipticity of beta",
            // A coupling into the outer frame about the parallel axis does the same.
            Verdict::Confounded,
        ),
        ("Rx(p*cos(5*beta))", vec![("p", six)], "encoder error of beta, 5 per turn", Verdict::Explained),
        (
            "Ry(p*cos(2*beta) + q*sin(2*beta))",
            both(),
            "tilt about y of the beta axis, 2 per turn",
            // Both move the beam along x of the outer frame; about its y or z, a wave of once a turn is multiplied by the
            // beam's own sine or cosine.
            Verdict::Confounded,
        ),
        (
            "Rx(p*temperature)",
            vec![("p", six / 5.0)],
            "temperature in middle about x",
            // The x axes of the outer frame, of the middle one and of the inner one's bearing are parallel.
            Verdict::Confounded,
        ),
        ("Rx(p*beta_direction)", vec![("p", six)], "backlash of beta", Verdict::Explained),
        ("Rx(p*beta)", vec![("p", six)], "encoder scale of beta", Verdict::Explained),
        (
            "Rx(p*cos(2*gamma))",
            vec![("p", six)],
            "coupling of gamma into middle about x, harmonic 2",
            // The outer frame's x axis is parallel.
            Verdict::Confounded,
        ),
    ] {
        let report = found(line, &errors, 5);
        let told: Vec<_> =
            report.effects.iter().map(|e| (&e.names, &e.confounded_with, &e.competing_with)).collect();
        assert_eq!(told.len(), 1, "{line}: {told:?}");
        assert!(called(&report.effects[0], name), "{line}: {told:?}");
        assert_eq!(report.verdict, verdict, "{line}: {told:?}");
    }
}

#[test]
fn two_at_once_are_both_named() {
    let line = "Rx(p*cos(2*beta) + r*temperature)";
    let report = found(line, &[("p", 8.0 * ARCSEC), ("r", ARCSEC)], 6);
    assert_eq!(report.effects.len(), 2, "{:?}", report.effects);
    for name in ["encoder ellipticity of beta", "temperature in middle about x"] {
        assert!(report.effects.iter().any(|effect| called(effect, name)), "{name}: {:?}", report.effects);
    }
    assert_eq!(report.verdict, Verdict::Confounded);
}

#[test]
fn nothing_planted_gives_nothing() {
    let report = found("Rx(p)", &[], 7);
    assert!(report.effects.is_empty(), "{:?}", report.effects);
    assert_eq!(report.verdict, Verdict::NothingDetectable);
}

#[test]
fn a_bump_in_no_catalogue_is_placed() {
    let text = lidar();
    let chain = Chain::from_text(&text).unwrap();
    let plan = plan(&chain);
    let observations = measured(&plan, 400, 8, |mut readings| {
        let width = (readings[1] - 0.8) / 0.25;
        readings[1] += 25.0 * ARCSEC * (-0.5 * width * width).exp();
        pointing(&chain, &[], readings)
    });
    let report = search(&text, &plan, &observations).diagnosis;
    assert_eq!(report.verdict, Verdict::UnnamedFunction, "{:?} {:?}", report.effects, report.remaining);
    let place = report.remaining.unwrap().place.unwrap();
    assert_eq!((place.driver.as_str(), place.dof.as_str()), ("beta", "Rx"));
}
