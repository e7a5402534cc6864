//! Image points: against numbers of `examples/pixels/simulate.py`, which shares no code, and programs against the exact form.

use codegen::{Form, Interpreter, build};
use model_core::syntax::Declaration;
use model_core::{Chain, ObservableId, SymbolId, SymbolKind, exact, identify};

const CHAIN: &str = include_str!("../../../examples/pixels/head.chain");

fn values(chain: &Chain, own: &[(&str, f64)]) -> Vec<f64> {
    let mut values = chain.nominal_values();
    let pose = [("pan", 0.2), ("tilt", -0.1), ("px", 0.06), ("py", -0.09), ("pz", 1.2)];
    for (name, value) in pose.iter().chain(own) {
        values[chain.find_symbol(name).unwrap().index()] = *value;
    }
    values
}

const ERRORS: [(&str, f64); 9] = [
    ("tilt_index", 2e-3),
    ("dfx", 12.0),
    ("dfy", 8.5),
    ("dcx", 2.4),
    ("dcy", -3.9),
    ("k1", -0.21),
    ("k2", 0.06),
    ("p1", 0.0008),
    ("p2", -0.0005),
];

fn run(chain: &Chain, form: Form, wrt: &[SymbolId], values: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; 2 * wrt.len().max(1)];
    Interpreter::new(&build(chain, &[ObservableId(0)], form, wrt)).eval(values, &mut out).unwrap();
    out
}

#[test]
fn a_camera_sees_a_point_where_the_other_program_does() {
    let chain = Chain::from_text(CHAIN).unwrap();
    let path = exact::Path::new(&chain, ObservableId(0));
    for (own, expected) in [
        (&ERRORS[..], [199.51215365104838, 95.94776486880224]),
        (&[][..], [197.5195531583817, 98.04720546883843]),
    ] {
        let values = values(&chain, own);
        for seen in [path.shown(&values), run(&chain, Form::ExactValue, &[], &values)] {
            for (seen, expected) in seen.iter().zip(expected) {
                assert!((seen - expected).abs() < 1e-10, "{seen} {expected}");
            }
        }
    }
}

#[test]
fn programs_of_images_have_the_values_of_the_core() {
    let chain = Chain::from_text(CHAIN).unwrap();
    let path = exact::Path::new(&chain, ObservableId(0));
    let errors: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
    for size in [1e-12, 1e-6, 1.0] {
        let sized = ERRORS.map(|(name, value)| (name, size * value));
        let values = values(&chain, &sized);
        let (error, rest) = (path.shown_error(&values), path.shown_remainder(&values));
        let computed = run(&chain, Form::ExactError, &[], &values);
        let first = run(&chain, Form::FirstOrderError, &[], &values);
        let slopes = run(&chain, Form::FirstOrderJacobian, &errors, &values);
        for place in 0..2 {
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * error[place].abs(), "{size} {a} {b}");
            near(computed[place], error[place]);
            near(first[place], error[place] - rest[place]);
            let columns = slopes[place * errors.len()..][..errors.len()].iter();
            near(columns.zip(&errors).map(|(slope, id)| slope * values[id.index()]).sum(), first[place]);
        }
    }
}

#[test]
fn derivatives_of_images_are_those_of_differences() {
    let chain = Chain::from_text(CHAIN).unwrap();
    let path = exact::Path::new(&chain, ObservableId(0));
    let all = [SymbolKind::Error, SymbolKind::Joint, SymbolKind::Input];
    let symbols: Vec<SymbolId> = all.into_iter().flat_map(|kind| chain.symbols_of(kind)).collect();
    let values = values(&chain, &ERRORS);
    let slopes = run(&chain, Form::ExactJacobian, &symbols, &values);
    for (column, id) in symbols.iter().enumerate() {
        let there = |by: f64| {
            let mut values = values.clone();
            values[id.index()] += by;
            path.shown(&values)
        };
        let (after, before) = (there(1e-6), there(-1e-6));
        for place in 0..2 {
            let (slope, expected) =
                (slopes[place * symbols.len() + column], (after[place] - before[place]) / 2e-6);
            let name = &chain.symbol(*id).name;
            assert!((slope - expected).abs() < 1e-5 * expected.abs().max(1.0), "{name} {slope} {expected}");
        }
    }
}

#[test]
fn an_image_of_another_body_is_printed_as_it_is_read() {
    let text = CHAIN.replace("(px, py, pz;", "(px, py, pz of flange;").replace(
        "    body pan_body",
        "    body flange on ground { motion: Rz(q); motion_error: Rz(wrist); }\n    body pan_body",
    );
    let printed = Declaration::from_text(&text).unwrap().to_string();
    assert!(printed.contains("image(px, py, pz of flange; 800 + dfx, 800 + dfy,"), "{printed}");
    assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(&text).unwrap());
    for wrong in ["of camera; 800", "of nobody; 800", "; 800, 800", "; tilt, 800"] {
        let spoiled = CHAIN.replace("; 800", &format!(" {wrong}"));
        assert!(Chain::from_text(&spoiled).is_err(), "{wrong}");
    }
}

#[test]
fn what_images_determine_is_told_at_the_declared_values() {
    let chain = Chain::from_text(CHAIN).unwrap();
    assert!(identify::identify(&chain, &[ObservableId(0)]).is_ok());
}
