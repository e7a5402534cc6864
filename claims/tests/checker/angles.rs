//! Slips inside sums of angles are named, in LaTeX and in plain text, whatever the constants are.

use claims::checker::{Checker, ClosedForm, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use model_core::print::Style;
use model_core::{Chain, ObservableId, SymbolKind};

/// An arm in a plane, with lengths that have no value.
const ARM: &str = "chain Arm {
    const a1: length;
    const a2: length;
    body upper on ground { motion: Rz(q1); motion_error: Rz(e); }
    body fore on upper { position: Tx(a1); motion: Rz(q2); motion_error: Rz(f); }
    observe hand: point(a2, 0, 0) of fore;
}";

/// By hand.
const X: &str = r"-(a_1 \sin q_1 + a_2 \sin(q_1 + q_2)) e - a_2 \sin(q_1 + q_2) f";
const Y: &str = r"(a_1 \cos q_1 + a_2 \cos(q_1 + q_2)) e + a_2 \cos(q_1 + q_2) f";

fn said(x: &str, y: &str) -> Vec<String> {
    let chain = Chain::symbolic_from_text(ARM).unwrap();
    let printed = PrintedVector::read(&chain, &PrintedSymbols::of_chain(&chain), &[x, y, "0"]).unwrap();
    let kept = chain.symbols_of(SymbolKind::Error).collect();
    let observable = ObservableId(0);
    let claim = ClosedForm { observable, order: Order::UpTo(1), only: None, faces: None, kept, printed };
    let verdict = Checker::new(&chain).closed_form(&claim).unwrap();
    let slips = verdict.differences.iter().map(|difference| difference.slip.as_ref().unwrap());
    slips.map(|slip| slip.describe(&chain, observable, Style::Text)).collect()
}

#[test]
fn the_right_formula_holds() {
    assert_eq!(said(X, Y), Vec::<String>::new());
    let plain = [
        "-(a1*sin(q1) + a2*sin(q1 + q2))*e - a2*sin(q1 + q2)*f",
        "(a1*cos(q1) + a2*cos(q1 + q2))*e + a2*cos(q2 + q1)*f",
    ];
    assert_eq!(said(plain[0], plain[1]), Vec::<String>::new());
}

#[test]
fn a_slip_in_a_sum_of_angles_is_named() {
    let last = |from: &str, text: &str, to: &str| {
        let at = text.rfind(from).unwrap();
        format!("{}{to}{}", &text[..at], &text[at + from.len()..])
    };
    for (to, named) in [
        (r"\cos(q_1 + q_2)", "cos(q1 + q2) for sin(q1 + q2)"),
        (r"\sin(q_1 - q_2)", "sin(q1 - q2) for sin(q1 + q2)"),
        (r"\sin(q_2 - q_1)", "for sin(q1 + q2)"),
        (r"\sin(q_1)", "sin(q1) for sin(q1 + q2)"),
        (r"\sin q_2", "sin(q2) for sin(q1 + q2)"),
        (r"\sin(q_1 + q_2 + q_2)", "for sin(q1 + q2)"),
        (r"\sin(q_1 + q_1)", "for sin(q1 + q2)"),
    ] {
        let found = said(&last(r"\sin(q_1 + q_2)", X, to), Y);
        assert_eq!(found.len(), 1, "{to}: {found:?}");
        assert!(found[0].contains(named), "{to}: {found:?}");
    }
    // Where the sum is one of several terms of an error, and where one angle was made two.
    let found = said(&X.replacen(r"a_2 \sin(q_1 + q_2)", r"a_2 \sin(q_1 - q_2)", 1), Y);
    assert!(found.len() == 1 && found[0].contains("sin(q1 - q2) for sin(q1 + q2)"), "{found:?}");
    let found = said(X, &Y.replacen(r"a_1 \cos q_1", r"a_1 \cos(q_1 + q_2)", 1));
    assert!(found.len() == 1 && found[0].contains("cos(q1 + q2) for cos(q1)"), "{found:?}");
    // In front of a bracket, which is multiplied out.
    let found = said("-(a1*sin(q1) + a2*sin(q1 + q2))*e*cos(q2) - a2*sin(q1 + q2)*f", Y);
    assert!(found.len() == 1 && found[0].contains("cos(q2) is too much"), "{found:?}");
}
