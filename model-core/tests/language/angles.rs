//! Angles that are written as numbers are constants of their own.
#![allow(clippy::unwrap_used)]

use model_core::{Chain, SymbolKind, exact, print, syntax};

fn value(text: &str) -> [f64; 3] {
    let chain =
        Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("angles", text)));
    let mut values = chain.nominal_values();
    for (name, value) in [("q", 0.4), ("sag", 1e-3)] {
        values[chain.find_symbol(name).unwrap().index()] = value;
    }
    exact::value(&chain, chain.find_observable("d").unwrap(), &values).into()
}

fn chain(constants: &str, position: &str, motion: &str, error: &str) -> String {
    format!(
        "chain C {{ {constants} body a on ground {{ position: {position}; motion: {motion}; motion_error: {error}; }} \
         observe d: direction(0.3, 0.2, 1) of a; }}"
    )
}

#[test]
fn numbers_turn_as_constants_do() {
    let written = chain("", "Rx(0.7), Ry(-40 deg), Rz(pi/7)", "Rz(q - 30 deg)", "Rx(sag*cos(q + 0.1))");
    let named = chain(
        "const a: angle = 0.7; const b: angle = 40 deg; const c: angle = pi/7; const d: angle = 30 deg; const e: angle = 0.1;",
        "Rx(a), Ry(-b), Rz(c)",
        "Rz(q - d)",
        "Rx(sag*cos(q + e))",
    );
    for (one, other) in value(&written).into_iter().zip(value(&named)) {
        assert!((one - other).abs() < 1e-15, "{one} {other}");
    }
}

#[test]
fn equal_numbers_are_one_constant_and_quarter_turns_are_none() {
    let text =
        chain("", "Rx(0.7), Ry(-0.7), Rz(pi/2), Rx(22.5 deg)", "Rz(q + pi/2)", "Rx(sag*cos(q - 0.70))");
    let chain = Chain::from_text(&text).unwrap();
    let names: Vec<&str> =
        chain.symbols_of(SymbolKind::Constant).map(|id| chain.symbol(id).name.as_str()).collect();
    assert_eq!(names, ["angle_0_7_rad", "angle_22_5_deg"]);
}

/// What is printed reads back, and so does a formula with the number itself.
#[test]
fn formulas_may_use_the_number() {
    let text = chain("", "Rx(0.7)", "Rz(q)", "Rx(sag)");
    let chain = Chain::from_text(&text).unwrap();
    let amount = |text: &str| chain.amount(&syntax::parse_amount(text).unwrap()).unwrap();
    let value = amount("sag*cos(0.7) + sin(q - 0.7)");
    let printed = print::text(&value, &chain);
    assert!(printed.contains("angle_0_7_rad"), "{printed}");
    assert_eq!(amount(&printed), value);
}

#[test]
fn the_names_of_numbers_are_taken() {
    let text = chain("const angle_0_7_rad: angle = 0.2;", "Rx(0.7)", "Rz(q)", "Rx(sag)");
    assert!(Chain::from_text(&text).unwrap_err().to_string().contains("angle_0_7_rad"));
}
