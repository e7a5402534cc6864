//! Jacobians column by column, and combinations of errors.

#![allow(clippy::expect_used, reason = "a test may fail loudly")]

use claims::checker::entries::{Entries, EntriesOf};
use claims::checker::{Checker, Order, extended};
use claims::latex::{PrintedSymbols, read_matrix};
use model_core::{SymbolId, identify};
use proof::Certificate;

use crate::statements::accepted;
use crate::support::{declared, observable};

const ARM: &str = "chain A { const l1: length; const l2: length; const k: angle;
    body one on ground { position_error: Rx(u), Ry(v); position: Rz(k); position_error: Rx(w); motion: Rz(q1); position: Tx(l1); }
    body two on one { motion: Ry(-2*q2); motion_error: Ry(e); position: Tx(l2); }
    observe tip: point(0, 0, 0) of two;
    observe foot: point(0, 0, 1) of one; }";

/// The certificate of a Jacobian of the tip.
fn of_jacobian(by: &[&str], jacobian: &str) -> String {
    let declared = declared(ARM);
    let by: Vec<SymbolId> =
        by.iter().map(|name| declared.chain().find_symbol(name).expect("declared")).collect();
    let declared = declared.with_changes(&by);
    let chain = extended(declared.chain());
    let matrix = read_matrix(jacobian, &PrintedSymbols::of_chain(&chain)).expect("a matrix");
    let claim = Entries {
        only: None,
        of: EntriesOf::Jacobian { observables: vec![observable(&declared, "tip")], by: by.clone() },
        order: Order::UpTo(1),
        kept: Vec::new(),
        labels: vec![String::new(); 3 * by.len()],
        printed: Entries::read(&chain, matrix, Order::UpTo(1)).expect("entries"),
    };
    let standing = |id: SymbolId| Some(declared.change_of(id).unwrap_or(id));
    let mut certificate = Certificate::new(&declared);
    let mut checker = Checker::new(&chain);
    for column in claim.columns(&chain, standing).expect("a Jacobian of vectors") {
        let verdict = checker.closed_form(&column.form).expect("a closed form");
        let title = format!("by {}", chain.symbol(column.by).name);
        certificate.closed_form(&title, &column.form, &verdict).expect("a certificate");
    }
    certificate.finish("test")
}

#[test]
fn columns_of_jacobians_are_proved() {
    let jacobian = r"\begin{bmatrix}
        -\sin(k + q_1) (l_1 + l_2 \cos 2 q_2) & -2 l_2 \cos(k + q_1) \sin 2 q_2 & l_2 \cos(k + q_1) \sin 2 q_2 \\
        \cos(k + q_1) (l_1 + l_2 \cos 2 q_2) & -2 l_2 \sin(k + q_1) \sin 2 q_2 & l_2 \sin(k + q_1) \sin 2 q_2 \\
        0 & 2 l_2 \cos 2 q_2 & -l_2 \cos 2 q_2 \end{bmatrix}";
    let text = of_jacobian(&["q1", "q2", "e"], jacobian);
    assert!(text.contains("Ry (- 2 * change_of_q2)") || text.contains("Ry (-2 * change_of_q2)"), "{text}");
    assert_eq!(text.matches("Theorem holds").count(), 3, "{text}");
    accepted("jacobian", &text, 3);
    let wrong = r"\begin{bmatrix} l_2 \cos(k + q_1) \sin 2 q_2 \\ l_2 \sin(k + q_1) \sin 2 q_2 \\ l_2 \cos 2 q_2 \end{bmatrix}";
    let text = of_jacobian(&["e"], wrong);
    assert!(text.contains("Theorem differs"), "{text}");
    accepted("jacobian_wrong", &text, 1);
}

/// One tilt about an axis between two others is a combination of theirs.
#[test]
fn combinations_of_errors_are_proved() {
    let declared = declared(ARM);
    let foot = observable(&declared, "foot");
    let found = identify::identify(declared.chain(), &[foot]).expect("a closed form");
    assert_eq!(found.combinations.len(), 1, "{found:?}");
    let mut certificate = Certificate::new(&declared);
    certificate.dependent(foot, &found.combinations[0]).expect("a certificate");
    let text = certificate.finish("test");
    // What each of the three does, and that one is a combination of the others.
    accepted("combination", &text, 4);
}

/// Rank from both sides: what has no influence or is a combination, and that the rest is independent.
#[test]
fn what_data_can_separate_is_proved_from_both_sides() {
    let declared = declared(ARM);
    let foot = observable(&declared, "foot");
    let tip = observable(&declared, "tip");
    let found = identify::identify(declared.chain(), &[foot]).expect("a closed form");
    let mut certificate = Certificate::new(&declared);
    certificate.identifiability(&found, |_| true);
    let together = identify::identify(declared.chain(), &[foot, tip]).expect("a closed form");
    certificate.identifiability(&together, |_| true);
    assert!(certificate.notes().is_empty(), "{:?}", certificate.notes());
    let text = certificate.finish("test");
    assert!(text.contains("Module independent_on_foot."), "{text}");
    assert!(text.contains("Module independent_on_foot_tip."), "{text}");
    let theorems = text.matches("Print Assumptions").count();
    accepted("identifiability", &text, theorems);
}

/// Whoever calls dependent errors independent finds no such poses.
#[test]
fn dependent_errors_are_not_proved_independent() {
    let declared = declared(ARM);
    let foot = observable(&declared, "foot");
    let [u, v, w] = ["u", "v", "w"].map(|name| declared.chain().find_symbol(name).expect("declared"));
    let mut certificate = Certificate::new(&declared);
    assert_eq!(certificate.independent(&[foot], &[u, v, w], &[w]), Err(proof::Refusal::NoMinor));
}
