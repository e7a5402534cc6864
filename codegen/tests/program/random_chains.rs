//! Chains at random: every form against the reference, and the rules of a program.

use std::fmt::Write;

use codegen::{Form, Interpreter, build_all};
use model_core::{ObservableId, exact, forms};
use proptest::prelude::*;

use crate::support::{errors, pose, random, read};

/// A body: its position, the errors of that, its motion and the errors of that, each by a number that picks one.
type Pick = (usize, Vec<usize>, usize, Vec<usize>);

const POSITIONS: [&str; 7] =
    ["", "Tx(arm)", "Rx(pi/2)", "Ry(-pi/2), Tz(arm)", "Rz(cant)", "Tz(1/4), Ry(cant - pi)", "Rx(2*cant)"];
const MOTIONS: [&str; 7] =
    ["", "Rx(J)", "Ry(-J)", "Rz(J + pi/2)", "Tx(J)", "Rz(2*J - cant)", "Ty(arm - J/2)"];
const AMOUNTS: [&str; 7] =
    ["E", "-E/3", "E*cos(J)", "E*sin(2*J) - shared*cos(3*J)", "E*shared", "E*heat", "E*J + shared"];
const FACTORS: [&str; 6] = ["Rx", "Ry", "Rz", "Tx", "Ty", "Tz"];

/// The text of a chain of these bodies, each on the one before.
fn declaration(bodies: &[Pick]) -> String {
    let mut text =
        String::from("chain Random {\n const arm: length = 0.3;\n const cant: angle = 0.4;\n input heat;\n");
    let mut lower = "ground".to_owned();
    for (index, (position, before, motion, after)) in bodies.iter().enumerate() {
        let joint = format!("j{index}");
        let mut names = 0..;
        let mut factors = |picks: &[usize]| -> String {
            picks
                .iter()
                .map(|pick| {
                    let factor = FACTORS[pick % FACTORS.len()];
                    // What turns and what shifts are different quantities; so are what they share.
                    let kind = if factor.starts_with('R') { "turn" } else { "shift" };
                    let amount = AMOUNTS[pick / FACTORS.len() % AMOUNTS.len()]
                        .replace('E', &format!("{kind}_{index}_{}", names.next().unwrap_or(0)))
                        .replace("shared", &format!("shared_{kind}"));
                    // The sine is that of an angle, so the joint must turn.
                    let turns = MOTIONS[motion % MOTIONS.len()].starts_with('R');
                    let amount = amount.replace('J', if turns { &joint } else { "cant" });
                    format!("{factor}({amount})")
                })
                .collect::<Vec<_>>()
                .join(", ")
        };
        let _ = writeln!(text, " body b{index} on {lower} {{");
        let parts = [
            ("position", POSITIONS[position % POSITIONS.len()].to_owned()),
            ("position_error", factors(before)),
            ("motion", MOTIONS[motion % MOTIONS.len()].replace('J', &joint)),
            ("motion_error", factors(after)),
        ];
        for (role, factors) in parts.iter().filter(|(_, factors)| !factors.is_empty()) {
            let _ = writeln!(text, "  {role}: {factors};");
        }
        text.push_str(" }\n");
        lower = format!("b{index}");
    }
    let _ = writeln!(
        text,
        " observe tip: point(1/2, arm, -1) of {lower};\n observe sight: direction(0, 3/5, 4/5) of {lower};\n}}"
    );
    text
}

fn bodies() -> impl Strategy<Value = Vec<Pick>> {
    let picks = || prop::collection::vec(0..42usize, 0..4);
    prop::collection::vec((0..7usize, picks(), 0..7usize, picks()), 1..4)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_form_agrees_with_the_reference(bodies in bodies(), seed in any::<u64>()) {
        let text = declaration(&bodies);
        let chain = read("random", &text);
        let wrt = errors(&chain);
        let observables = [ObservableId(0), ObservableId(1)];
        let forms = [Form::ExactValue, Form::ExactError, Form::FirstOrderError, Form::FirstOrderJacobian];
        let program = build_all(&chain, &observables, &forms, &wrt);
        prop_assert_eq!(program.check(), Ok(()));

        let size = 1e-6;
        let values = pose(&chain, &mut random(seed), size);
        let mut found = vec![0.0; program.outputs().len()];
        Interpreter::new(&program).eval(&values, &mut found).unwrap();
        // Lengths and joints reach a few metres and radians, and there are at most a dozen turns.
        let (value_tolerance, error_tolerance) = (1e-13, 1e-12 * size);
        for (place, &id) in observables.iter().enumerate() {
            let (value, error) = (exact::value(&chain, id, &values), exact::error(&chain, id, &values));
            let first = forms::derive(&chain, id, 1).unwrap();
            for axis in 0..3 {
                let output = 3 * place + axis;
                prop_assert!((found[output] - value[axis]).abs() <= value_tolerance, "value\n{}", text);
                prop_assert!((found[6 + output] - error[axis]).abs() <= error_tolerance, "error\n{}", text);
                let expected = first.components[axis].eval(&values);
                prop_assert!((found[12 + output] - expected).abs() <= error_tolerance, "first order\n{}", text);
                for (column, (_, coefficients)) in first.columns(&chain).iter().enumerate() {
                    let found = found[18 + output * wrt.len() + column];
                    let expected = coefficients[axis].eval(&values);
                    prop_assert!((found - expected).abs() <= 1e-13 * (1.0 + expected.abs()), "column\n{}", text);
                }
            }
        }
    }
}
