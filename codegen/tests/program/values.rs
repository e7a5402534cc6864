//! Values and errors of every chain against the numeric reference and the derived first-order form.

use codegen::{Form, Interpreter, build};
use model_core::{Chain, ObservableId, exact, forms};

use crate::support::{CHAINS, SIGHT, errors, pose, random, read};

const POSES: usize = 50;

fn observables(chain: &Chain) -> Vec<ObservableId> {
    (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect()
}

/// Compares a form with a reference at random poses; differences are measured against `size`, the size of the errors,
/// times that of the reference for errors all of size one.
fn check(
    form: Form,
    sizes: &[f64],
    reference: impl Fn(&Chain, ObservableId, &[f64]) -> [f64; 3],
    scale: impl Fn(f64) -> f64,
) {
    for (name, text) in CHAINS.into_iter().chain([SIGHT]) {
        let chain = read(name, text);
        let observables = observables(&chain);
        let program = build(&chain, &observables, form, &errors(&chain));
        program.check().unwrap();
        let mut interpreter = Interpreter::new(&program);
        let mut found = vec![0.0; program.outputs().len()];
        let mut random = random(1);
        for &size in sizes {
            for _ in 0..POSES {
                let values = pose(&chain, &mut random, size);
                interpreter.eval(&values, &mut found).unwrap();
                for (&observable, found) in observables.iter().zip(found.chunks_exact(3)) {
                    let expected = reference(&chain, observable, &values);
                    for (found, expected) in found.iter().zip(expected) {
                        let tolerance = 256.0 * f64::EPSILON * scale(size);
                        assert!(
                            (found - expected).abs() <= tolerance,
                            "{name}, {observable:?}, errors of {size}: {found} is not {expected}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn exact_values_agree_with_the_reference() {
    check(
        Form::ExactValue,
        &[0.0, 1e-3, 0.3],
        |chain, id, values| exact::value(chain, id, values).into(),
        |_| 1.0,
    );
}

/// To full precision of the error, however small: nothing cancels.
#[test]
fn exact_errors_agree_with_the_reference_at_any_size() {
    check(
        Form::ExactError,
        &[0.3, 1e-3, 1e-9, 1e-15],
        |chain, id, values| exact::error(chain, id, values).into(),
        |size| size,
    );
}

#[test]
fn first_order_errors_agree_with_the_closed_form() {
    check(
        Form::FirstOrderError,
        &[1.0, 1e-9],
        |chain, id, values| {
            let form = forms::derive(chain, id, 1).unwrap();
            [0, 1, 2].map(|axis| form.components[axis].eval(values))
        },
        |size| size,
    );
}

#[test]
fn without_errors_the_error_is_zero() {
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let observables = observables(&chain);
        for form in [Form::ExactError, Form::FirstOrderError] {
            let program = build(&chain, &observables, form, &[]);
            let mut found = vec![1.0; program.outputs().len()];
            Interpreter::new(&program).eval(&pose(&chain, &mut random(2), 0.0), &mut found).unwrap();
            assert!(found.iter().all(|&component| component == 0.0), "{name}: {form:?}");
        }
    }
}

#[test]
fn no_number_and_infinity_pass_through() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let program = build(&chain, &observables(&chain), Form::ExactError, &[]);
    let mut interpreter = Interpreter::new(&program);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut values = pose(&chain, &mut random(3), 1e-3);
        values[chain.find_symbol("alpha").unwrap().index()] = bad;
        let mut found = vec![0.0; program.outputs().len()];
        interpreter.eval(&values, &mut found).unwrap();
        // alpha turns about z: x and y of each observable follow it, z does not.
        assert!(found[0].is_nan() && found[1].is_nan() && found[3].is_nan() && found[4].is_nan());
    }
}

#[test]
fn too_few_values_are_an_error() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let program = build(&chain, &[ObservableId(0)], Form::ExactValue, &[]);
    let mut interpreter = Interpreter::new(&program);
    let error = interpreter.eval(&[0.0; 2], &mut [0.0; 3]).unwrap_err();
    assert_eq!(error.to_string(), "symbol 2 of the program has no value: 2 values were given");
    let values = chain.nominal_values();
    let error = interpreter.eval(&values, &mut [0.0; 4]).unwrap_err();
    assert_eq!(error.to_string(), "the program has 3 outputs, room was given for 4");
}
