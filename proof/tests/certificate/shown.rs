//! What a perfect instrument shows.

#![allow(clippy::expect_used, reason = "a test may fail loudly")]

use claims::checker::entries::{Entries, EntriesOf};
use claims::checker::{Checker, Claim, Order, PrintedVector, errors_named, extended};
use claims::latex::{PrintedSymbols, read_matrix};
use model_core::chain::BodyId;
use proof::{Certificate, Declared};

use crate::statements::accepted;
use crate::support::{declared, observable};

const PLANAR: &str = "chain Planar { const l1: length; const l2: length;
    body upper on ground { motion: Rz(q1); motion_error: Rz(e); position: Tx(l1); }
    body fore on upper { motion: Rz(q2); position: Tx(l2); }
    observe tip: point(0, 0, 0) of fore; }";

fn printed(declared: &Declared, text: &str) -> Vec<PrintedVector> {
    let chain = extended(declared.chain());
    let matrix = read_matrix(text, &PrintedSymbols::of_chain(&chain)).expect("a vector");
    Entries::read(&chain, matrix, Order::UpTo(0)).expect("entries")
}

#[test]
fn a_nominal_position_is_proved_and_a_wrong_one_refuted() {
    let declared = declared(PLANAR);
    let tip = observable(&declared, "tip");
    let mut certificate = Certificate::new(&declared);
    let right = r"\begin{bmatrix} l_1 \cos q_1 + l_2 \cos(q_1 + q_2) \\ l_1 \sin q_1 + l_2 \sin(q_1 + q_2) \\ 0 \end{bmatrix}";
    certificate.printed_as(&[right.to_owned()]);
    certificate.shown("right", (tip, 0, &[]), &printed(&declared, right), true).expect("a certificate");
    let wrong = right.replace(r"l_2 \sin(q_1 + q_2)", r"l_2 \sin(q_1 - q_2)");
    certificate.shown("wrong", (tip, 0, &[]), &printed(&declared, &wrong), false).expect("a certificate");
    let text = certificate.finish("test");
    assert!(text.contains(r"(* As printed: \begin{bmatrix} l_1 \cos q_1"), "{text}");
    assert!(text.contains("Theorem differs : ~ (forall"), "{text}");
    accepted("shown", &text, 2);
}

/// With its error, the tip is moved sideways, and the forearm is turned.
#[test]
fn what_is_shown_with_errors_and_how_a_body_stands_are_proved_or_refuted() {
    let tip = r"\begin{bmatrix} l_1 \cos q_1 - e\, l_1 \sin q_1 \\ l_1 \sin q_1 + e\, l_1 \cos q_1 \\ 0 \end{bmatrix}";
    let stands = r"\begin{bmatrix} \cos q_1 - e \sin q_1 & -\sin q_1 - e \cos q_1 & 0 & l_1 \cos q_1 - e\, l_1 \sin q_1 \\
        \sin q_1 + e \cos q_1 & \cos q_1 - e \sin q_1 & 0 & l_1 \sin q_1 + e\, l_1 \cos q_1 \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{bmatrix}";
    let chain = PLANAR.replace("point(0, 0, 0) of fore", "point(0, 0, 0) of upper");
    let own = declared(&chain);
    let extended = extended(own.chain());
    let claim = |text: &str, of: EntriesOf| {
        let matrix = read_matrix(text, &PrintedSymbols::of_chain(&extended)).expect("a matrix");
        let labels = (0..matrix.entries.len()).map(|at| at.to_string()).collect();
        let printed = Entries::read(&extended, matrix, Order::UpTo(1)).expect("entries");
        let kept = errors_named(&extended, "*").expect("errors");
        Claim::Entries(Box::new(Entries { of, order: Order::UpTo(1), kept, only: None, labels, printed }))
    };
    let shown = EntriesOf::Shown(observable(&own, "tip"));
    let body = BodyId(0);
    let frame = EntriesOf::Frame { body, frame: None, is_homogeneous: true };
    let wrong = |text: &str| text.replacen(r"- e\, l_1", r"+ e\, l_1", 1);
    let claims = [
        ("tip", claim(tip, shown.clone())),
        ("wrong tip", claim(&wrong(tip), shown)),
        ("stands", claim(stands, frame.clone())),
        ("wrong stands", claim(&wrong(stands), frame)),
    ];
    let declared = own.with_changes_of(claims.iter().map(|(_, claim)| claim));
    let mut certificate = Certificate::new(&declared);
    for (name, claim) in &claims {
        let verdict = Checker::new(&extended).check(claim).expect("a verdict");
        assert_eq!(verdict.holds(), !name.starts_with("wrong"), "{name}");
        certificate.claim(name, claim, &verdict).expect("a certificate");
    }
    let text = certificate.finish("test");
    for said in ["tip.holds", "wrong_tip.differs", "stands_origin.holds", "wrong_stands_origin.differs"] {
        assert!(text.contains(&format!("Print Assumptions {said}.")), "{said}: {text}");
    }
    accepted("shown_with_errors", &text, 10);
}
