//! What a perfect instrument shows.

#![allow(clippy::expect_used, reason = "a test may fail loudly")]

use claims::checker::entries::Entries;
use claims::checker::{Order, PrintedVector, extended};
use claims::latex::{PrintedSymbols, read_matrix};
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
    certificate.shown("right", tip, &printed(&declared, right), true).expect("a certificate");
    let wrong = right.replace(r"l_2 \sin(q_1 + q_2)", r"l_2 \sin(q_1 - q_2)");
    certificate.shown("wrong", tip, &printed(&declared, &wrong), false).expect("a certificate");
    let text = certificate.finish("test");
    assert!(text.contains(r"(* As printed: \begin{bmatrix} l_1 \cos q_1"), "{text}");
    assert!(text.contains("Theorem differs : ~ (forall"), "{text}");
    accepted("shown", &text, 2);
}
