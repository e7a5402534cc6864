//! Each declared error in turn is taken out of a declaration whose instrument has it: the search names it or its set, or
//! says that the data cannot show it.

use calibration::calibrate::{Request, calibrate};
use calibration::diagnose::{Diagnosis, EffectFound};
use effects::candidate::Freedom;
use effects::families::assembly_name;
use model_core::algebra::Poly;
use model_core::{Chain, Factor, Role, SymbolId, SymbolKind, TransformKind, exact};
use nalgebra::Vector3;
use observe::{Measure, Measured, Observations, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use study::{Plan, Study};

use crate::data::{load, root};
use crate::simulated::observed_alone;

const ARCSEC: f64 = std::f64::consts::PI / 180.0 / 3600.0;

/// What a report says of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Said {
    Named,
    Hidden,
    /// Another function, in the same body and degree of freedom.
    Placed,
}

/// What a report says of an effect of this name and size; `None` if nothing.
fn said(report: &Diagnosis, wanted: &str, size: f64) -> Option<Said> {
    let named = report.effects.iter().any(|effect| effect.told().any(|name| name == wanted));
    let too_small = |smallest: Option<f64>| smallest.is_none_or(|smallest| smallest > size);
    let hidden = || report.not_shown.iter().any(|effect| effect.name == wanted && too_small(effect.smallest));
    if named { Some(Said::Named) } else { hidden().then_some(Said::Hidden) }
}

/// A plan without one factor of the declaration and its error, and the name of what it lacks.
fn without(plan: &Plan, body: usize, factor: usize) -> (Plan, SymbolId, String) {
    let mut lacking = plan.clone();
    let Factor { role, kind, axis, amount, .. } = lacking.chain.bodies[body].factors.remove(factor);
    let is_error = |id: &SymbolId| plan.chain.symbol(*id).kind == SymbolKind::Error;
    let error = amount.symbols().into_iter().find(is_error).unwrap();
    lacking.fit.estimate.retain(|&id| id != error);
    let constant = amount == Poly::symbol(error) || amount == -&Poly::symbol(error);
    let name = if constant {
        assembly_name(&plan.chain.bodies[body].name, role, Freedom { kind, axis })
    } else {
        "refraction, cot of elevation".to_owned()
    };
    (lacking, error, name)
}

/// The places of all declared errors: body and factor.
fn errors(chain: &Chain) -> Vec<(usize, usize)> {
    let places = chain.bodies.iter().enumerate().flat_map(|(number, body)| {
        let factors = body.factors.iter().enumerate();
        factors
            .filter(|(_, f)| matches!(f.role, Role::PositionError | Role::MotionError))
            .map(move |(at, _)| (number, at))
    });
    places.collect()
}

/// The scanner at random poses, aiming (rotations left out) or measuring points (shifts left out).
fn measured(
    plan: &Plan,
    truth: &Chain,
    errors: &[(SymbolId, f64)],
    measure: Measure,
    seed: u64,
) -> Observations {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let name = if measure == Measure::Point { "target" } else { "pointing" };
    let observable = plan.chain.find_observable(name).unwrap();
    let mut values = truth.nominal_values();
    errors.iter().for_each(|&(id, value)| values[id.index()] = value);
    let ids = ["alpha", "beta", "gamma", "range"].map(|name| plan.chain.find_symbol(name).unwrap());
    let mut columns: Vec<(SymbolId, Vec<f64>)> = ids.iter().map(|&id| (id, Vec::new())).collect();
    let mut observed = Vec::new();
    let rows = 150;
    for _ in 0..rows {
        for (i, (id, column)) in columns.iter_mut().enumerate() {
            let value = if i < 3 { random.random_range(-3.1..3.1) } else { random.random_range(1.0..5.0) };
            values[id.index()] = value;
            column.push(value);
        }
        let exact = exact::value(truth, observable, &values);
        let mut noise = |sigma: f64| sigma * random.sample::<f64, _>(StandardNormal);
        observed.push(match measure {
            Measure::Point => Measured::Point(exact + Vector3::from_fn(|_, _| noise(2e-5))),
            _ => {
                let [across, along] = tangent_frame(&exact);
                let moved = exact + across * noise(2.0 * ARCSEC) + along * noise(2.0 * ARCSEC);
                Measured::Direction(moved.normalize())
            }
        });
    }
    observed_alone(&plan.chain, name, measure, columns, observed)
}

#[test]
fn each_of_the_scanners_30_errors_is_named_or_said_to_be_hidden() {
    let text = std::fs::read_to_string(root().join("examples/mobile-lidar/mobile-lidar.chain")).unwrap();
    let full = Chain::from_text(&text).unwrap();
    let plan = |observable: &str, kind: &str| {
        let study = format!(
            "chain = \"c\"\nobservable = \"{observable}\"\ndata = \"d\"\n[observed]\nkind = \"{kind}\"\n[hold_out]\nfolds = 5\n"
        );
        Study::from_text(&study).unwrap().plan(&full).unwrap()
    };
    let (aiming, measuring) = (plan("pointing", "direction"), plan("target", "point"));
    let mut told: Vec<(String, Said)> = Vec::new();
    for (body, at) in errors(&full) {
        let turns = full.bodies[body].factors[at].kind == TransformKind::Rotation;
        let (plan, measure, size) = if turns {
            (&aiming, Measure::Direction, 30.0 * ARCSEC)
        } else {
            (&measuring, Measure::Point, 0.5e-3)
        };
        let (lacking, error, wanted) = without(plan, body, at);
        let other = full.find_symbol(if turns { "dtheta_x3" } else { "dx4" }).unwrap();
        let planted = [(other, 0.4 * size), (error, size)];
        let observations = measured(&lacking, &full, &planted, measure, 9 + u64::from(error.0));
        let request = Request {
            text: &text,
            plan: &lacking,
            observations: &observations,
            sample: None,
            second: None,
            when: "2026-11-21",
        };
        let report = calibrate(request).unwrap().diagnosis;
        let name = full.symbol(error).name.clone();
        let said = said(&report, &wanted, size);
        let said = said.unwrap_or_else(|| panic!("{name}: {wanted} not among {:#?}", report.effects));
        told.push((name, said));
    }
    assert_eq!(told.len(), 30);
    insta::assert_debug_snapshot!(told);
}

#[test]
fn each_error_of_the_auxiliary_telescope_is_named_or_said_to_be_hidden() {
    let Some(study) = load("examples/auxtel/auxtel-2022-04.toml") else { return };
    let before = study.calibrate();
    let mut told: Vec<(String, Said)> = Vec::new();
    for (body, at) in errors(&study.plan.chain) {
        let (lacking, error, wanted) = without(&study.plan, body, at);
        let request = Request {
            text: &study.text,
            plan: &lacking,
            observations: &study.observations,
            sample: None,
            second: None,
            when: "2026-11-21",
        };
        let report = calibrate(request).unwrap().diagnosis;
        let name = study.plan.chain.symbol(error).name.clone();
        let size = before.diagnosis.errors.iter().find(|e| e.name == name).unwrap().value.abs();
        let declared = &study.plan.chain.bodies[body];
        let freedom = Freedom { kind: declared.factors[at].kind, axis: declared.factors[at].axis };
        let moves = |e: &EffectFound| e.dof.split(", ").any(|word| word == freedom.word());
        let here = |e: &EffectFound| moves(e) && e.body == declared.name;
        let placed = || report.effects.iter().any(here).then_some(Said::Placed);
        let said = said(&report, &wanted, size).or_else(placed).unwrap_or_else(|| {
            let found: Vec<_> =
                report.effects.iter().map(|e| (&e.names, &e.confounded_with, &e.competing_with)).collect();
            panic!("{name}: {wanted} not among {found:#?}")
        });
        told.push((name, said));
    }
    assert_eq!(told.len(), 6);
    insta::assert_debug_snapshot!(told);
}
