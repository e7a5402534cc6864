//! An amended declaration reads, derives and generates like any other, and calibrating it again finds nothing more.

use calibration::calibrate::{Request, calibrate};
use codegen::{Form, build_all};
use model_core::{Chain, SymbolKind, forms};

use crate::data::{load, observations, study};

#[track_caller]
fn nothing_more(path: &str) {
    let Some(loaded) = load(path) else { return };
    let first = loaded.calibrate();
    assert!(!first.diagnosis.effects.is_empty(), "{path}: something is found");
    let amended = first.amended.unwrap();
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
    let found: Vec<_> =
        again.diagnosis.effects.iter().map(|effect| (&effect.names, effect.p_value)).collect();
    assert!(found.is_empty(), "{path}: {found:?}");
    assert_eq!(again.amended, Some(amended));
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

#[test]
fn equatorial_mount() {
    nothing_more("examples/equatorial/equatorial-b.toml");
}
