//! An amended declaration reads, derives and generates like any other, and calibrating it again finds nothing more where nothing was said
//! to remain.

use calibration::calibrate::{Calibration, Request, calibrate};
use calibration::diagnose::Verdict;
use codegen::{Form, build_all};
use model_core::{Chain, SymbolKind, forms};

use crate::data::{load, observations, study};

/// What a study comes to, and what its amended declaration comes to.
#[track_caller]
fn again(path: &str) -> Option<[Calibration; 2]> {
    let loaded = load(path)?;
    let first = loaded.calibrate();
    assert!(!first.diagnosis.effects.is_empty(), "{path}: something is found");
    let amended = first.amended.clone().unwrap();
    let chain = Chain::from_text(&amended)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render("amended", &amended)));
    let plan = study(path).plan(&chain).unwrap();
    for series in &loaded.observations.poses.series {
        let form = forms::derive(&chain, series.observable, 1).unwrap();
        for name in first.diagnosis.effects.iter().flat_map(|effect| effect.coefficients.keys()) {
            let id = chain.find_symbol(name).unwrap();
            let (_, column) = form.columns(&chain).into_iter().find(|(error, _)| *error == id).unwrap();
            assert!(
                column.iter().any(|component| !component.is_zero()),
                "{path}: {name} moves what is observed"
            );
        }
        let errors: Vec<_> = chain.symbols_of(SymbolKind::Error).collect();
        let program =
            build_all(&chain, &[series.observable], &[Form::ExactValue, Form::ExactJacobian], &errors);
        assert!(!program.inputs().is_empty());
    }
    let again = calibrate(Request {
        text: &amended,
        plan: &plan,
        observations: &observations(path, &plan),
        sample: None,
        second: None,
        when: "2026-11-22",
    })
    .unwrap();
    Some([first, again])
}

#[track_caller]
fn nothing_more(path: &str) {
    let Some([first, again]) = again(path) else { return };
    let found: Vec<_> =
        again.diagnosis.effects.iter().map(|effect| (&effect.names, effect.p_value)).collect();
    assert!(found.is_empty(), "{path}: {found:?}");
    assert_eq!(again.amended, first.amended);
}

#[test]
fn mobile_lidar() {
    nothing_more("examples/mobile-lidar/study.toml");
}

#[test]
fn auxiliary_telescope() {
    nothing_more("examples/auxtel/auxtel-2022-04.toml");
}

#[test]
fn radio_telescope() {
    nothing_more("examples/iram30m/iram30m-2013-10.toml");
}

/// Something is left there that nothing in the catalogue explains. With eight effects in the declaration it may look like a ninth, and the
/// declaration has to come out as it was left.
#[test]
fn what_remains_beside_an_amended_declaration_is_what_was_left() {
    let Some([first, again]) = again("examples/equatorial/equatorial-b.toml") else { return };
    assert_eq!(first.diagnosis.verdict, Verdict::StructureRemains);
    let [left, found] = [first.after.rms, again.before.rms];
    assert!((found / left - 1.0).abs() < 0.01, "{found} where {left} was left");
}
