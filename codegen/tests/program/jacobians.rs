//! Jacobians: against differences of the reference, against the derived columns, and that equal columns are merged.

use std::collections::BTreeSet;

use codegen::{Form, Interpreter, NodeId, build};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind, exact, forms};

use crate::support::{CHAINS, SIGHT, errors, pose, random, read};

/// Derivative by a five-point difference: off by h⁴/30 times the fifth derivative, and by rounding over h.
fn difference(chain: &Chain, id: ObservableId, values: &[f64], symbol: SymbolId) -> [f64; 3] {
    const STEP: f64 = 1e-3;
    let at = |steps: f64| {
        let mut moved = values.to_vec();
        moved[symbol.index()] += steps * STEP;
        exact::value(chain, id, &moved)
    };
    let derivative = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * STEP);
    derivative.into()
}

/// With respect to errors, constants, joints and inputs alike, at errors that are not small.
#[test]
fn exact_jacobians_agree_with_differences() {
    for (name, text) in CHAINS.into_iter().chain([SIGHT]) {
        let chain = read(name, text);
        let wrt: Vec<SymbolId> =
            [SymbolKind::Error, SymbolKind::Constant, SymbolKind::Joint, SymbolKind::Input]
                .into_iter()
                .flat_map(|kind| chain.symbols_of(kind))
                // 400 θ turns too fast for a difference of this step.
                .filter(|&id| chain.symbol(id).name != "theta")
                .collect();
        for id in (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId) {
            let program = build(&chain, &[id], Form::ExactJacobian, &wrt);
            program.check().unwrap();
            let mut found = vec![0.0; program.outputs().len()];
            let mut interpreter = Interpreter::new(&program);
            let mut random = random(4);
            for _ in 0..5 {
                let values = pose(&chain, &mut random, 0.1);
                interpreter.eval(&values, &mut found).unwrap();
                for (column, &symbol) in wrt.iter().enumerate() {
                    let expected = difference(&chain, id, &values, symbol);
                    for (component, expected) in expected.into_iter().enumerate() {
                        let found = found[component * wrt.len() + column];
                        assert!(
                            (found - expected).abs() <= 1e-8 * (1.0 + expected.abs()),
                            "{name}, {id:?}, {component}, {}: {found} is not {expected}",
                            chain.symbol(symbol).name
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn first_order_jacobians_agree_with_the_derived_columns() {
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let wrt = errors(&chain);
        for id in (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId) {
            let program = build(&chain, &[id], Form::FirstOrderJacobian, &wrt);
            program.check().unwrap();
            let columns = forms::derive(&chain, id, 1).unwrap().columns(&chain);
            let mut found = vec![0.0; program.outputs().len()];
            let mut interpreter = Interpreter::new(&program);
            let mut random = random(5);
            for _ in 0..20 {
                let values = pose(&chain, &mut random, 1.0);
                interpreter.eval(&values, &mut found).unwrap();
                for (column, (_, expected)) in columns.iter().enumerate() {
                    for (component, expected) in expected.iter().enumerate() {
                        let expected = expected.eval(&values);
                        let found = found[component * wrt.len() + column];
                        let tolerance = 64.0 * f64::EPSILON * (1.0 + expected.abs());
                        assert!((found - expected).abs() <= tolerance, "{name}: {found} is not {expected}");
                    }
                }
            }
        }
    }
}

/// Sharing nodes finds every pair of columns that the canonical form says is equal.
#[test]
fn equal_columns_are_merged() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let wrt = errors(&chain);
    let observables =
        [chain.find_observable("pointing").unwrap(), chain.find_observable("position").unwrap()];
    let program = build(&chain, &observables, Form::FirstOrderJacobian, &wrt);
    let column = |column: usize| -> Vec<NodeId> {
        program.outputs().iter().skip(column).step_by(wrt.len()).copied().collect()
    };
    let distinct: BTreeSet<Vec<NodeId>> = (0..wrt.len()).map(column).collect();

    let derived = observables.map(|id| forms::derive(&chain, id, 1).unwrap().columns(&chain));
    let derived = |column: usize| [&derived[0][column].1, &derived[1][column].1];
    let expected: Vec<usize> =
        (0..wrt.len()).filter(|&i| !(0..i).any(|j| derived(i) == derived(j))).collect();
    assert_eq!(distinct.len(), expected.len());
}
