//! Against 200-bit arithmetic: `tests/reference/make_numbers.py`.

use super::chain;
use model_core::{SymbolKind, exact, forms};

/// One line of the reference: values of all symbols, and vectors.
struct Line {
    chain: &'static str,
    observable: &'static str,
    size: f64,
    values: Vec<(&'static str, f64)>,
    /// The exact error, then its parts of degree 1, 2 and 3 over size to that power.
    vectors: [[f64; 3]; 4],
}

fn lines() -> impl Iterator<Item = Line> {
    let ramps = include_str!("../reference/ramps.csv").lines().skip(1);
    include_str!("../reference/numbers.csv").lines().skip(1).chain(ramps).map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = fields[4..].iter().map(|field| field.parse().unwrap()).collect();
        let value = |pair: &'static str| {
            let (name, value) = pair.split_once('=').unwrap();
            (name, value.parse().unwrap())
        };
        Line {
            chain: fields[0],
            observable: fields[1],
            size: fields[2].parse().unwrap(),
            values: fields[3].split(' ').map(value).collect(),
            vectors: std::array::from_fn(|part| std::array::from_fn(|axis| numbers[3 * part + axis])),
        }
    })
}

#[test]
fn validate_the_exact_error_to_thirteen_digits_of_the_errors() {
    let mut count = 0;
    for line in lines() {
        let chain = chain(line.chain);
        let mut values = chain.nominal_values();
        let mut sum = 0.0;
        for (name, value) in &line.values {
            let id = chain.find_symbol(name).unwrap();
            values[id.index()] = *value;
            if chain.symbol(id).kind == SymbolKind::Error {
                sum += value.abs();
            }
        }
        let error = exact::error(&chain, chain.find_observable(line.observable).unwrap(), &values);
        for axis in 0..3 {
            let off = (error[axis] - line.vectors[0][axis]).abs();
            assert!(off <= 1e-13 * sum, "{} {} {axis}: {:e}", line.observable, line.size, off / sum);
            count += 1;
        }
    }
    assert_eq!(count, 216);
}

#[test]
fn validate_the_parts_of_degree_one_two_and_three() {
    let mut count = 0;
    for line in lines() {
        let chain = chain(line.chain);
        let observable = chain.find_observable(line.observable).unwrap();
        let mut values = chain.nominal_values();
        for (name, value) in &line.values {
            let id = chain.find_symbol(name).unwrap();
            let error = chain.symbol(id).kind == SymbolKind::Error;
            values[id.index()] = if error { value / line.size } else { *value };
        }
        chain.set_derived(&mut values);
        let mut lower = [0.0; 3];
        for order in 1..=3 {
            let form = forms::derive(&chain, observable, order).unwrap();
            for (axis, lower) in lower.iter_mut().enumerate() {
                let sum = form.components[axis].eval(&values);
                let (found, expected) = (sum - *lower, line.vectors[order as usize][axis]);
                let scale = expected.abs() + lower.abs() + 1.0;
                let place = (line.observable, order, axis);
                assert!((found - expected).abs() <= 1e-12 * scale, "{place:?}: {found} {expected}");
                *lower = sum;
                count += 1;
            }
        }
    }
    assert_eq!(count, 648);
}
