//! Structure of arrays: each row as the single pose has it, whatever the number of rows.

use codegen::{Form, Interpreter, ShapeError, Stage, build_all};
use model_core::{ObservableId, SymbolId, SymbolKind};

use crate::support::{CHAINS, errors, pose, random, read};

#[test]
fn rows_are_what_single_poses_are() {
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let observables: Vec<ObservableId> =
            (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect();
        let forms = [Form::ExactValue, Form::ExactJacobian, Form::FirstOrderError];
        let program = build_all(&chain, &observables, &forms, &errors(&chain));
        program.check().unwrap();
        let mut interpreter = Interpreter::new(&program);
        let moving: Vec<SymbolId> = [SymbolKind::Joint, SymbolKind::Input]
            .into_iter()
            .flat_map(|kind| chain.symbols_of(kind))
            .collect();
        let mut random = random(6);
        let constants = pose(&chain, &mut random, 1e-3);
        for rows in [0, 1, 7, 64, 65, 200] {
            let poses: Vec<Vec<f64>> = (0..rows).map(|_| pose(&chain, &mut random, 0.0)).collect();
            let columns: Vec<Vec<f64>> =
                moving.iter().map(|id| poses.iter().map(|pose| pose[id.index()]).collect()).collect();
            let columns: Vec<(SymbolId, &[f64])> =
                moving.iter().copied().zip(columns.iter().map(Vec::as_slice)).collect();
            let mut found = vec![vec![0.0; rows]; program.outputs().len()];
            let mut slices: Vec<&mut [f64]> = found.iter_mut().map(Vec::as_mut_slice).collect();
            interpreter.eval_batch(&columns, &constants, &mut slices).unwrap();
            let mut expected = vec![0.0; program.outputs().len()];
            for (row, pose) in poses.iter().enumerate() {
                let mut values = constants.clone();
                for id in &moving {
                    values[id.index()] = pose[id.index()];
                }
                interpreter.eval(&values, &mut expected).unwrap();
                for (found, expected) in found.iter().zip(&expected) {
                    assert_eq!(found[row].to_bits(), expected.to_bits(), "{name}, row {row}");
                }
            }
        }
    }
}

#[test]
fn a_symbol_without_column_has_one_value_for_all_rows() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let program = build_all(&chain, &[ObservableId(0)], &[Form::ExactValue], &[]);
    let mut interpreter = Interpreter::new(&program);
    let values = pose(&chain, &mut random(7), 1e-3);
    let alpha = chain.find_symbol("alpha").unwrap();
    let column = [values[alpha.index()]; 3];
    let mut found = [[0.0; 3]; 3];
    let mut slices: Vec<&mut [f64]> = found.iter_mut().map(<[f64; 3]>::as_mut_slice).collect();
    interpreter.eval_batch(&[(alpha, &column)], &values, &mut slices).unwrap();
    assert!(found.iter().all(|rows| rows[0] == rows[1] && rows[1] == rows[2]));
}

#[test]
fn columns_that_do_not_fit_are_errors() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let program = build_all(&chain, &[ObservableId(0)], &[Form::ExactValue], &[]);
    let mut interpreter = Interpreter::new(&program);
    let values = chain.nominal_values();
    let (alpha, error) = (chain.find_symbol("alpha").unwrap(), chain.find_symbol("da1").unwrap());
    let mut out = [[0.0; 2]; 3];
    let mut slices: Vec<&mut [f64]> = out.iter_mut().map(<[f64; 2]>::as_mut_slice).collect();
    let long = interpreter.eval_batch(&[(alpha, &[0.0; 5])], &values, &mut slices).unwrap_err();
    assert_eq!(long, ShapeError::Rows { expected: 2, found: 5 });
    let prepared = interpreter.eval_batch(&[(error, &[0.0; 2])], &values, &mut slices).unwrap_err();
    assert_eq!(prepared, ShapeError::PreparedColumn { symbol: error.index() });
    let missing = interpreter.eval_batch(&[], &values[..3], &mut slices).unwrap_err();
    assert!(matches!(missing, ShapeError::NoValue { values: 3, .. }));
}

#[test]
fn stages_split_by_what_moves() {
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let program = build_all(&chain, &[ObservableId(0)], &[Form::ExactError], &[]);
        for (id, stage) in program.inputs() {
            let moves = matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input);
            assert_eq!(stage == Stage::Evaluated, moves, "{name}");
        }
    }
}
