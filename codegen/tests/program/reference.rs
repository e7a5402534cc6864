//! The exact error against 200-bit arithmetic: numbers and script lie in `model-core/tests/reference`.

use codegen::{Form, Interpreter, build};
use model_core::SymbolKind;

use crate::support::{errors, read};

const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
const GIMBAL: &str = include_str!("../../../model-core/tests/reference/gimbal.chain");

#[test]
fn validate_the_exact_error_to_thirteen_digits_of_the_errors() {
    let mut count = 0;
    for line in include_str!("../../../model-core/tests/reference/numbers.csv").lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let chain = read(fields[0], if fields[0] == "gimbal" { GIMBAL } else { LIDAR });
        let observable = chain.find_observable(fields[1]).unwrap();
        let mut values = chain.nominal_values();
        let mut sum = 0.0;
        for pair in fields[3].split(' ') {
            let (name, value) = pair.split_once('=').unwrap();
            let (id, value): (_, f64) = (chain.find_symbol(name).unwrap(), value.parse().unwrap());
            values[id.index()] = value;
            if chain.symbol(id).kind == SymbolKind::Error {
                sum += value.abs();
            }
        }
        let program = build(&chain, &[observable], Form::ExactError, &errors(&chain));
        let mut found = [0.0; 3];
        Interpreter::new(&program).eval(&values, &mut found).unwrap();
        for (found, expected) in found.iter().zip(&fields[4..7]) {
            let off = (found - expected.parse::<f64>().unwrap()).abs();
            assert!(off <= 1e-13 * sum, "{} at {}: {:e}", fields[1], fields[2], off / sum);
            count += 1;
        }
    }
    assert_eq!(count, 162);
}
