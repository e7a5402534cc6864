//! The generated methods give what the reference of `model-core` gives: the exact form evaluated along the chain,
//! and the first-order form derived as polynomials.
#![allow(clippy::unwrap_used)]

use trueaxis::model_core::{SymbolId, SymbolKind, exact, forms};
use trueaxis::nalgebra::{DVector, Vector3};

use super::chains::mobile_lidar::{InputRows, Inputs, JointRows, Joints, LengthsDiffer, MobileLidar};
use super::chains::{CASES, count, numbers};

#[test]
fn every_method_agrees_with_the_reference() {
    for (seed, case) in (1..).zip(&CASES) {
        let (chain, observable) = case.chain();
        let mut random = numbers(seed);
        let form = forms::derive(&chain, observable, 1).unwrap();
        for _ in 0..5 {
            let mut draw = |kinds: &[SymbolKind], size: f64| -> Vec<f64> {
                random.by_ref().take(count(&chain, kinds)).map(|number| number * size).collect()
            };
            let errors = draw(&[SymbolKind::Error], 1e-3);
            let joints = draw(&[SymbolKind::Joint], 1.2);
            let inputs = draw(&[SymbolKind::Input], 3.0);

            let mut values = chain.nominal_values();
            let mut set = |kind, numbers: &[f64]| {
                let ids: Vec<SymbolId> = chain.symbols_of(kind).collect();
                for (id, number) in ids.into_iter().zip(numbers) {
                    values[id.index()] = *number;
                }
            };
            set(SymbolKind::Error, &errors);
            set(SymbolKind::Joint, &joints);
            set(SymbolKind::Input, &inputs);
            chain.set_derived(&mut values);

            let answers = (case.answer)(&errors, &[joints, inputs].concat());
            let first_order = Vector3::from_fn(|axis, _| form.components[axis].eval(&values));
            let by_columns = &answers.jacobian * DVector::from_vec(errors);
            let what = format!("{} {}", case.file, case.observable);
            close(answers.value, exact::value(&chain, observable, &values), 1e-14, &what);
            close(answers.error, exact::error(&chain, observable, &values), 1e-16, &what);
            close(answers.first_order, first_order, 1e-16, &what);
            close(Vector3::from_column_slice(by_columns.as_slice()), first_order, 1e-16, &what);
        }
    }
}

/// Rounding of values near one is about 1e-15, of errors near 1e-3 about 1e-18; sums have some tens of terms.
fn close(found: Vector3<f64>, expected: Vector3<f64>, rounding: f64, what: &str) {
    let allowed = 10.0 * rounding * (1.0 + expected.norm());
    assert!((found - expected).norm() < allowed, "{what}: {found} and {expected}");
}

#[test]
fn slices_give_what_single_poses_give() {
    let mut random = numbers(7);
    let errors: [f64; 30] = std::array::from_fn(|_| random.next().unwrap() * 1e-4);
    let lidar = MobileLidar::new(errors.into());
    let column = |seed| -> Vec<f64> { numbers(seed).take(17).collect() };
    let (alpha, beta, gamma, range) = (column(1), column(2), column(3), column(4));
    let joints = JointRows { alpha: &alpha, beta: &beta, gamma: &gamma };
    let inputs = InputRows { range: &range };

    let (mut x, mut y, mut z) = (vec![0.0; 17], vec![0.0; 17], vec![0.0; 17]);
    let mut first = [vec![0.0; 17], vec![0.0; 17], vec![0.0; 17]];
    let [first_x, first_y, first_z] = &mut first;
    let mut jacobians = vec![Default::default(); 17];
    lidar.target_error_rows(&joints, &inputs, [&mut x, &mut y, &mut z]).unwrap();
    lidar.target_first_order_rows(&joints, &inputs, [first_x, first_y, first_z]).unwrap();
    lidar.target_jacobian_rows(&joints, &inputs, &mut jacobians).unwrap();
    for pose in 0..17 {
        let one = Joints { alpha: alpha[pose], beta: beta[pose], gamma: gamma[pose] };
        let input = Inputs { range: range[pose] };
        assert_eq!(Vector3::new(x[pose], y[pose], z[pose]), lidar.target_error(&one, &input));
        let over = Vector3::new(first[0][pose], first[1][pose], first[2][pose]);
        assert_eq!(over, lidar.target_first_order(&one, &input));
        assert_eq!(jacobians[pose], lidar.target_jacobian(&one, &input));
    }

    let short = InputRows { range: &range[1..] };
    assert_eq!(lidar.target_error_rows(&joints, &short, [&mut x, &mut y, &mut z]), Err(LengthsDiffer));
    assert_eq!(lidar.target_jacobian_rows(&joints, &short, &mut jacobians), Err(LengthsDiffer));
}

#[test]
fn without_errors_nothing_is_added() {
    for case in &CASES {
        let (chain, _) = case.chain();
        let pose: Vec<f64> =
            numbers(3).take(count(&chain, &[SymbolKind::Joint, SymbolKind::Input])).collect();
        let answers = (case.answer)(&vec![0.0; count(&chain, &[SymbolKind::Error])], &pose);
        assert_eq!(answers.error, Vector3::zeros(), "{} {}", case.file, case.observable);
        assert_eq!(answers.first_order, Vector3::zeros(), "{} {}", case.file, case.observable);
    }
}
