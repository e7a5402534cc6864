//! Values, errors and forms by degree against `tests/reference/make_readings.py`.

use super::chain;
use model_core::{Chain, SymbolKind, exact, forms, print};

const REFERENCE: &str = include_str!("../reference/readings.csv");

pub struct Line {
    pub observable: &'static str,
    pub size: f64,
    pub values: Vec<f64>,
    /// The sum of the errors' sizes.
    pub sum: f64,
    pub shown: usize,
    /// The value, the exact error, then its parts of degree 1, 2 and 3 over size to that power.
    pub numbers: [f64; 5],
}

pub fn lines(chain: &Chain, text: &'static str) -> Vec<Line> {
    text.lines()
        .skip(1)
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            let mut values = chain.nominal_values();
            let mut sum = 0.0;
            for pair in fields[2].split(' ') {
                let (name, value) = pair.split_once('=').unwrap();
                let (id, value): (_, f64) = (chain.find_symbol(name).unwrap(), value.parse().unwrap());
                values[id.index()] = value;
                if chain.symbol(id).kind == SymbolKind::Error {
                    sum += value.abs();
                }
            }
            let number = |at: usize| fields[at].parse().unwrap();
            Line {
                observable: fields[0],
                size: number(1),
                values,
                sum,
                shown: fields[3].parse().unwrap(),
                numbers: [4, 5, 6, 7, 8].map(number),
            }
        })
        .collect()
}

#[test]
fn validate_values_and_errors_to_twelve_digits_however_small_they_are() {
    let chain = chain();
    let lines = lines(&chain, REFERENCE);
    assert_eq!(lines.len(), 57);
    for line in lines {
        let path = exact::Path::new(&chain, chain.find_observable(line.observable).unwrap());
        let (value, error) =
            (path.shown(&line.values)[line.shown], path.shown_error(&line.values)[line.shown]);
        let [expected_value, expected_error, ..] = line.numbers;
        let what = format!("{} {} {}", line.observable, line.shown, line.size);
        assert!((value - expected_value).abs() <= 1e-14 * (1.0 + expected_value.abs()), "{what}: {value:?}");
        // Lengths of some tens of metres amplify errors of angles.
        let scale = 1.0 + expected_error.abs() / line.sum;
        let off = (error - expected_error).abs() / (line.sum * scale);
        assert!(off <= 1e-12, "{what}: {error:?} is not {expected_error:?}: {off:e}");
    }
}

#[test]
fn validate_the_parts_of_degree_one_two_and_three() {
    let chain = chain();
    let is_error = |values: &[f64], scale: f64| -> Vec<f64> {
        let mut scaled = values.to_vec();
        for id in chain.symbols_of(SymbolKind::Error) {
            scaled[id.index()] /= scale;
        }
        scaled
    };
    let mut count = 0;
    for line in lines(&chain, REFERENCE) {
        let id = chain.find_observable(line.observable).unwrap();
        let values = is_error(&line.values, line.size);
        let form = |order| forms::derive(&chain, id, order).unwrap().components[line.shown].eval(&values);
        let [first, second, third] = [form(1), form(2), form(3)];
        let [_, _, expected @ ..] = line.numbers;
        for (found, expected) in [first, second - first, third - second].into_iter().zip(expected) {
            let scale = 1.0 + [first, second, third].iter().fold(0.0_f64, |most, part| most.max(part.abs()));
            let what = format!("{} {} {}", line.observable, line.shown, line.size);
            assert!((found - expected).abs() <= 1e-9 * scale, "{what}: {found:?} is not {expected:?}");
            count += 1;
        }
    }
    assert_eq!(count, 3 * 57);
}

/// A division is carried out where the way permits; a measured distance stays below where shifts are seen as angles.
#[test]
fn divisions_are_carried_out_where_the_way_permits() {
    let chain = chain();
    let below = |name: &str| -> Vec<String> {
        let form = forms::derive(&chain, chain.find_observable(name).unwrap(), 1).unwrap();
        form.components.iter().map(|part| print::text(&part.below, &chain)).collect()
    };
    for name in ["sky", "arcs", "clock", "other", "station", "lone", "seen"] {
        assert!(below(name).iter().all(|below| below == "1"), "{name}: {:?}", below(name));
    }
    assert_eq!(below("bearing"), ["distance"]);
}

/// The sign of an elevation's form is right on one side of the zenith only, and the form says so.
#[test]
fn what_has_to_be_positive_is_said() {
    let chain = chain();
    let positive = |name: &str| -> Vec<Vec<String>> {
        let form = forms::derive(&chain, chain.find_observable(name).unwrap(), 1).unwrap();
        let texts = |roots: &Vec<_>| roots.iter().map(|root| print::text(root, &chain)).collect();
        form.positive.iter().map(texts).collect()
    };
    let cosine = || vec!["cos(elevation)".to_owned()];
    assert_eq!(positive("sky"), [vec![], cosine()]);
    assert_eq!(positive("arcs"), [cosine(), cosine()]);
    assert_eq!(positive("away"), [vec!["lever".to_owned()]]);
}
