//! Formulas as they are written, and that what is written says the same.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use claims::checker::lower;
use claims::latex::{PrintedSymbols, read_formula};
use model_core::algebra::Poly;
use model_core::print::{Hand, Style, by_hand, poly, text};
use model_core::{Chain, SymbolId, syntax};

fn chain() -> Chain {
    Chain::from_text(
        "chain Arm {
            body a on ground { motion: Rz(q1); motion_error: Rz(e); }
            body b on a { motion: Rz(q2), Rz(q3), Rx(beta); motion_error: Rz(f*cos(beta)); }
            const arm: length = 1;
            observe tip: point(arm, 0, 0) of b;
        }",
    )
    .unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn value(chain: &Chain, text: &str) -> Poly {
    let amount = syntax::parse_amount(text).unwrap_or_else(|mistakes| panic!("{text}: {mistakes}"));
    lower(chain, &amount).unwrap_or_else(|mistake| panic!("{text}: {}", mistake.message))
}

/// Each formula beside the way it is written, which is shorter or as it was.
#[test]
fn the_shortest_of_a_few_forms_is_written() {
    let chain = chain();
    for (said, written) in [
        ("sin(q1)*cos(q2) + cos(q1)*sin(q2)", "sin(q1 + q2)"),
        ("e*(cos(q1)*cos(q2) + sin(q1)*sin(q2))", "e*cos(q1 - q2)"),
        ("e*cos(beta)^2", "e*cos(beta)^2"),
        ("e*sin(beta)^2 + f*sin(beta)^2", "(e + f)*sin(beta)^2"),
        ("e*sin(2*beta)", "e*sin(2*beta)"),
        ("e*sin(beta)*cos(beta)", "1/2*e*sin(2*beta)"),
        ("-e*cos(q1)*cos(beta)^2", "-e*cos(q1)*cos(beta)^2"),
        ("arm*e*sin(q1 + q2 + q3)*cos(beta)", "arm*e*cos(beta)*sin(q1 + q2 + q3)"),
        ("e*sin(q1)*cos(q2)", "e*sin(q1)*cos(q2)"),
        ("cos(2*beta) + 1", "2*cos(beta)^2"),
        ("e*(cos(2*beta) - 1)", "-2*e*sin(beta)^2"),
        ("e*cos(2*beta)", "e*cos(2*beta)"),
        ("e*cos(beta)^3", "e*cos(beta)^3"),
        ("e*tan(beta)*sin(q1 + q2)", "e*sin(q1 + q2)*tan(beta)"),
    ] {
        let value = value(&chain, said);
        let found = text(&value, &chain);
        assert_eq!(found.len(), written.len(), "{said}: {found}");
        assert_eq!(self::value(&chain, &found), value, "{said}: {found}");
        let mut sorted: Vec<char> = found.chars().collect();
        let mut wanted: Vec<char> = written.chars().collect();
        sorted.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(sorted, wanted, "{said}: {found}");
    }
}

#[test]
fn a_papers_abbreviations_and_sums_come_first() {
    let chain = chain();
    let [q1, q2] = ["q1", "q2"].map(|name| chain.find_symbol(name).unwrap_or(SymbolId::PI));
    let mut hand = Hand::default();
    hand.abbreviate(&[(q1, 1), (q2, 1)], true, "s_{12}");
    hand.abbreviate(&[(q1, 1)], false, "c_1");
    let written = |said: &str| by_hand(&value(&chain, said), &chain, Style::Latex, &hand);
    assert_eq!(written("e*sin(q1 + q2)*cos(q1)^0"), "e s_{12}");
    assert_eq!(written("e*cos(q1)"), "e c_1");
    assert_eq!(written("e*cos(q1 + q2)"), r"e \cos\left(q_{1} + q_{2}\right)");
    assert_eq!(written("e*cos(beta)^2"), r"e \cos^{2} \beta");
}

proptest::proptest! {
    /// Whatever is written reads back as what it was.
    #[test]
    fn what_is_written_reads_back(
        terms in proptest::collection::vec((-3i64..4, 0..3usize, 0..4u32, 0..4u32, 0..3u32, 0..2u32), 1..6)
    ) {
        let chain = chain();
        let mut sum = String::from("0");
        for (number, error, a, b, c, d) in terms {
            let error = ["1", "e", "f"][error];
            sum += &format!(" + {number}*{error}*cos(q1)^{a}*sin(q2)^{b}*cos(beta)^{c}*sin(q1 - q3)^{d}");
        }
        let value = value(&chain, &sum);
        for style in [Style::Text, Style::Latex] {
            let written = poly(&value, &chain, style);
            let symbols = PrintedSymbols::of_chain(&chain);
            let back = match style {
                Style::Text => self::value(&chain, &written),
                _ => {
                    let formula = read_formula(&written, &symbols);
                    let formula = formula.unwrap_or_else(|mistake| panic!("{written}: {}", mistake.message));
                    lower(&chain, &formula).unwrap_or_else(|mistake| panic!("{written}: {}", mistake.message))
                }
            };
            proptest::prop_assert_eq!(&back, &value, "{}", written);
        }
    }
}
