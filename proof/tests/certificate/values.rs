//! Printed numbers.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use claims::checker::{Checker, Claim, Exactly, Given, Values};
use model_core::algebra::{Poly, Rational};
use model_core::symbol::SymbolId;
use proof::{Certificate, Declared, Refusal};

use crate::coq;
use crate::statements::accepted_reading;
use crate::support::{declared, observable};

/// Two links of 0.8 m and 0.6 m; an error with a harmonic, one with a tangent, and a frame to look back from.
const ARM: &str = "chain Arm { const l1: length = 0.8; const l2: length = 60 cm; const turn: angle = 30 deg;
    body base on ground { position: Rz(turn); }
    body upper on base { motion: Rz(q1); motion_error: Rz(e), Rx(f*cos(2*q1)); position: Tx(l1); }
    body fore on upper { motion: Ry(q2); motion_error: Rz(g*tan(q1)); position: Tx(l2); }
    observe tip: point(0, 0.1, 0) of fore;
    observe back: direction(1, 0, 0) of base in fore;
    observe seen: azimuth(x, y) of direction(1, 0, 0) of fore; }";

fn decimal(text: &str) -> Poly {
    Poly::constant(Rational::parse_decimal(text).expect("a decimal"))
}

fn degrees(text: &str) -> Poly {
    let one = Rational::new(1, 180).expect("a number");
    &decimal(text).scale(&one) * &Poly::symbol(SymbolId::PI)
}

/// Numbers at q1 = 31.7°, q2 = 0.4 rad and errors of −0.01°, 2 and 3 mrad.
fn claim(declared: &Declared, of: &str, is_error: bool, claimed: [&str; 3], half: &str) -> Values {
    let chain = declared.chain();
    let numbers = [
        ("q1", degrees("31.7")),
        ("q2", decimal("0.4")),
        ("e", degrees("-0.01")),
        ("f", decimal("2e-3")),
        ("g", decimal("0.003")),
    ];
    let given = numbers.map(|(name, value)| {
        let symbol = chain.find_symbol(name).expect("declared");
        Given { symbol, value, written: format!("{name} (* as written *)") }
    });
    let mut values = chain.nominal_values();
    for given in &given {
        values[given.symbol.index()] = given.value.eval(&[std::f64::consts::PI]);
    }
    let exact: Vec<[Poly; 2]> = claimed.iter().map(|text| [decimal(text), decimal(half)]).collect();
    let numbers = exact.iter().map(|pair| pair.each_ref().map(|number| number.eval(&[]))).collect();
    let written = claimed.map(str::to_owned).to_vec();
    let exactly = Some(Exactly { given: given.to_vec(), claimed: exact, written });
    Values { observable: observable(declared, of), is_error, values, claimed: numbers, exactly }
}

/// The exact numbers, rounded to nine decimals.
fn rounded(declared: &Declared, of: &str, is_error: bool) -> [String; 3] {
    let any = claim(declared, of, is_error, ["0", "0", "0"], "1");
    let path = model_core::exact::Path::new(declared.chain(), any.observable);
    let found = if is_error { path.shown_error(&any.values) } else { path.shown(&any.values) };
    found
        .into_iter()
        .map(|number| format!("{number:.9}"))
        .collect::<Vec<_>>()
        .try_into()
        .expect("three numbers")
}

/// A certificate of the numbers, the last digit of the second one moved; whether the claim holds.
fn written(of: &str, is_error: bool, by: i64) -> (bool, String) {
    let declared = declared(ARM);
    let [x, y, z] = rounded(&declared, of, is_error);
    let moved: f64 = y.parse::<f64>().expect("a number") + by as f64 * 1e-9;
    let claim = claim(&declared, of, is_error, [&x, &format!("{moved:.9}"), &z], "5e-10");
    let asked = Claim::Values(claim);
    let verdict = Checker::new(declared.chain()).check(&asked).expect("a verdict");
    let mut certificate = Certificate::new(&declared);
    certificate.claim("numbers", &asked, &verdict).expect("a certificate");
    (verdict.holds(), certificate.finish("test"))
}

#[test]
fn rounded_numbers_are_proved_and_the_next_last_digits_refuted() {
    for (of, is_error) in [("tip", true), ("tip", false), ("back", true), ("back", false)] {
        let name = format!("values_{of}_{is_error}");
        let (holds, text) = written(of, is_error, 0);
        assert!(holds && text.contains("\nTheorem holds : claim."), "{text}");
        assert!(text.contains("Definition q1 : R := 317 / 1800 * PI. (* q1"), "{text}");
        accepted_reading(&name, &text, 1);
        for by in [-1, 1] {
            let (holds, text) = written(of, is_error, by);
            assert!(!holds && text.contains("\nTheorem differs : ~ claim."), "{text}");
            accepted_reading(&format!("{name}_{}", by + 1), &text, 1);
        }
    }
}

/// A certificate with another number, another value, another sign or another verdict does not check.
#[test]
fn falsified_numbers_are_refused() {
    let (_, right) = written("tip", true, 0);
    let (_, wrong) = written("tip", true, 1);
    let printed = |text: &str| {
        let at = text.find("Definition printed").expect("the printed numbers");
        text[at..].split("\n(*").next().expect("a definition").to_owned()
    };
    assert_ne!(printed(&right), printed(&wrong));
    let falsified = [
        right.replace(&printed(&right), &printed(&wrong)),
        wrong.replace(&printed(&wrong), &printed(&right)),
        right.replace(":= 317 / 1800 * PI.", ":= 318 / 1800 * PI."),
        right.replace("Rz e;", "Rz (- e);"),
        right.replace("holds : claim", "holds : ~ claim"),
        wrong.replace("differs : ~ claim", "differs : claim"),
        right.replace("less (shown Point instrument vector)", "less (shown Point designed vector)"),
    ];
    for (index, text) in falsified.iter().enumerate() {
        assert!(*text != right && *text != wrong, "{index} changes nothing:\n{right}");
    }
    let Some(folder) = coq::folder() else { return };
    assert!(coq::check(folder, "numbers", &right).is_ok());
    for (index, text) in falsified.iter().enumerate() {
        assert!(coq::check(folder, &format!("numbers_{index}"), text).is_err(), "{index} is accepted");
    }
}

#[test]
fn what_has_no_exact_number_is_refused_with_its_reason() {
    let declared = declared(ARM);
    let refusal = |claim: &Values| Certificate::new(&declared).values("numbers", claim, true);
    let mut inexact = claim(&declared, "tip", true, ["0", "0", "0"], "1");
    inexact.exactly = None;
    assert!(matches!(refusal(&inexact), Err(Refusal::NoExactValue { .. })));
    let angle = claim(&declared, "seen", true, ["0", "0", "0"], "1");
    assert_eq!(refusal(&angle), Err(Refusal::ValueOf { reading: "azimuth".to_owned() }));
}
