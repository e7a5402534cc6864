//! How bodies are turned, in programs: against the exact form and the derived form of the core, which 120-digit arithmetic
//! has checked.

use codegen::{Form, Interpreter, build};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind, exact, forms};

const CHAIN: &str = "chain Gimbal {
    const lean: angle = 0.4;
    body base on ground { position: Rx(lean); motion: Rz(az); motion_error: Rz(e), Rx(a*cos(az)); }
    body tube on base { motion: Ry(el); motion_error: Ry(f), Rx(g), Tx(d); }
    body table on base { motion: Rx(q); motion_error: Rz(h); }
    observe turned: orientation of tube;
    observe seen: rotation_y, rotation_x of orientation of tube in table;
}";

#[test]
fn programs_of_orientations_have_the_values_of_the_core() {
    let chain = Chain::from_text(CHAIN).unwrap();
    let both = [ObservableId(0), ObservableId(1)];
    for size in [0.0, 1e-12, 1e-5, 0.1, 0.7] {
        let mut values = chain.nominal_values();
        for (index, id) in (0u16..).zip(chain.symbols_of(SymbolKind::Error)) {
            values[id.index()] = size * (1.0 - 0.3 * f64::from(index));
        }
        for (index, id) in (0u16..).zip(chain.symbols_of(SymbolKind::Joint)) {
            values[id.index()] = 0.3 + 0.8 * f64::from(index);
        }
        let run = |form| {
            let mut out = [f64::NAN; 5];
            Interpreter::new(&build(&chain, &both, form, &[])).eval(&values, &mut out).unwrap();
            out
        };
        let exact: Vec<f64> =
            both.iter().flat_map(|&id| exact::Path::new(&chain, id).shown_error(&values)).collect();
        let first: Vec<f64> = both
            .iter()
            .flat_map(|&id| forms::derive(&chain, id, 1).unwrap().components)
            .map(|component| component.eval(&values))
            .collect();
        for (form, expected) in
            [(Form::ExactError, &exact), (Form::ExactValue, &exact), (Form::FirstOrderError, &first)]
        {
            for (found, expected) in run(form).iter().zip(expected) {
                assert!(
                    (found - expected).abs() <= 1e-14 * size,
                    "{form:?} {size}: {found} is not {expected}"
                );
            }
        }
    }
}

/// With respect to errors, joints and constants, against differences of the core's exact form.
#[test]
fn jacobians_of_orientations_are_those_of_differences() {
    let chain = Chain::from_text(CHAIN).unwrap();
    let both = [ObservableId(0), ObservableId(1)];
    let wrt: Vec<SymbolId> = [SymbolKind::Error, SymbolKind::Joint, SymbolKind::Constant]
        .into_iter()
        .flat_map(|kind| chain.symbols_of(kind))
        .collect();
    for size in [0.0, 1e-9, 1e-3, 0.4] {
        let mut values = chain.nominal_values();
        for (index, id) in (0u16..).zip(chain.symbols_of(SymbolKind::Error)) {
            values[id.index()] = size * (1.0 - 0.3 * f64::from(index));
        }
        for (index, id) in (0u16..).zip(chain.symbols_of(SymbolKind::Joint)) {
            values[id.index()] = 0.3 + 0.8 * f64::from(index);
        }
        let shown = |values: &[f64]| -> Vec<f64> {
            both.iter().flat_map(|&id| exact::Path::new(&chain, id).shown(values)).collect()
        };
        let mut out = vec![f64::NAN; 5 * wrt.len()];
        let program = build(&chain, &both, Form::ExactJacobian, &wrt);
        Interpreter::new(&program).eval(&values, &mut out).unwrap();
        for (column, id) in wrt.iter().enumerate() {
            const STEP: f64 = 1e-5;
            let moved = |by: f64| {
                let mut moved = values.clone();
                moved[id.index()] += by;
                shown(&moved)
            };
            for (row, (up, down)) in moved(STEP).iter().zip(moved(-STEP)).enumerate() {
                let (found, expected) = (out[row * wrt.len() + column], (up - down) / (2.0 * STEP));
                let what = (&chain.symbol(*id).name, row, size);
                assert!((found - expected).abs() <= 1e-9, "{what:?}: {found} is not {expected}");
            }
        }
    }
}
