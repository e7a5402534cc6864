//! The exact error of the expanded scanner against 200-bit arithmetic: numbers and script lie in
//! `model-core/tests/reference`.
#![allow(clippy::unwrap_used)]

use trueaxis::model_core::SymbolKind;

use super::chains::CASES;

#[test]
fn validate_the_exact_error_to_thirteen_digits_of_the_errors() {
    let mut checked = 0;
    for line in include_str!("../../model-core/tests/reference/numbers.csv").lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        if fields[0] != "mobile-lidar" {
            continue;
        }
        let is_it =
            |file: &str, observable: &str| file.ends_with("mobile-lidar.chain") && observable == fields[1];
        let case = CASES.iter().find(|case| is_it(case.file, case.observable)).unwrap();
        let (chain, _) = case.chain();
        let of_kind = |kind| -> Vec<f64> {
            let value = |name: &str| {
                let mut pairs = fields[3].split(' ').map(|pair| pair.split_once('=').unwrap());
                pairs.find(|(other, _)| *other == name).unwrap().1.parse().unwrap()
            };
            chain.symbols_of(kind).map(|id| value(&chain.symbol(id).name)).collect()
        };
        let errors = of_kind(SymbolKind::Error);
        let pose = [of_kind(SymbolKind::Joint), of_kind(SymbolKind::Input)].concat();
        let found = (case.answer)(&errors, &pose).error;
        let sum: f64 = errors.iter().map(|error| error.abs()).sum();
        for (found, expected) in found.iter().zip(&fields[4..7]) {
            let off = (found - expected.parse::<f64>().unwrap()).abs();
            assert!(off <= 1e-13 * sum, "{} at {}: {:e}", fields[1], fields[2], off / sum);
            checked += 1;
        }
    }
    assert_eq!(checked, 81);
}
