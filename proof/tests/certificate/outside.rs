//! What no example asks for: names that mean something to Coq, titles that would end a comment, the third order, and formulas
//! with everything in them at once.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use claims::checker::{Checker, Claim as Checked, Equality, Verdict};
use claims::latex::PrintedSymbols;
use proof::{Certificate, Refusal};

use crate::support::{Claim, add, declared, of_chain, of_claim};
use crate::{coq, statements::accepted};

/// Words of Coq's language, of its tactics, of its library and of ours, as names of everything that has a name.
const WORDS: &str = "chain Prop {
    const forall: angle = pi/7;
    const R: length = 2;
    input Axiom;
    body fun on ground { position: Rx(forall); motion: Rz(Definition); motion_error: Ry(Qed*Axiom), Rx(Section + lazymatch), Tx(list); }
    body instrument on fun { motion: Ry(exists); motion_error: Rz(V*sin(2*Definition) + step_1), Rx(squares + H), Ty(nat*ring); }
    body vector on instrument { motion: Tz(S); motion_error: Ry(eq_refl + defined_0*tan(exists)); }
    observe claim: direction(0, sin(forall), cos(forall)) of vector;
    observe holds: point(R, 0, shown) of vector;
    const shown: length = 1;
}";

#[test]
fn names_that_mean_something_to_coq_are_names() {
    accepted("words", &of_chain(WORDS, 1).expect("a certificate"), 2);
}

/// Everything at once: a tree, a constant, an input, harmonics, a ramp, a tangent and where it is defined.
const EVERYTHING: &str = "chain Everything {
    const lean: angle = pi/5;
    input heat;
    body base on ground { position: Rx(lean); motion: Rz(az); motion_error: Ry(tilt), Rz(bend*ramp(heat, 10, 20)); }
    body mirror on base { motion: Rx(el); motion_error: Rx(sag*tan(el) + wave*cos(3*el)), Ry(slip*(1 + heat)); }
    body other on base { motion: Ry(unused); motion_error: Ry(far); }
    observe sight: direction(0, 1, 0) of mirror;
}";

/// What it implies, to first order, worked out by hand for the errors that turn about x of the mirror.
const SIGHT: [&str; 3] = [
    "(sag*tan(el) + wave*cos(3*el))*sin(az)*sin(el)",
    "-(sag*tan(el) + wave*cos(3*el))*(cos(az)*cos(lean)*sin(el) + sin(lean)*cos(el))",
    "(sag*tan(el) + wave*cos(3*el))*(cos(lean)*cos(el) - cos(az)*sin(lean)*sin(el))",
];

const HOSTILE: &str = "*) Axiom cheat : False. (* \"§ Ω 日本 \u{202e}\u{1f980} (*) **) \\ 'fun";

fn titled(components: [&str; 3]) -> (bool, String) {
    let declared = declared(EVERYTHING);
    let mut certificate = Certificate::new(&declared);
    let claim = Claim { observable: "sight", order: 1, keep: &["sag", "wave"], components };
    let holds = add(&mut certificate, &declared, HOSTILE, &claim).expect("a certificate");
    certificate.not_certified(HOSTILE, HOSTILE);
    (holds, certificate.finish(HOSTILE))
}

#[test]
fn titles_do_not_end_the_comments_that_they_stand_in() {
    let (holds, text) = titled(SIGHT);
    assert!(holds);
    accepted("hostile_holds", &text, 1);
    let (holds, text) = titled([SIGHT[0], SIGHT[1], "0"]);
    assert!(!holds);
    accepted("hostile_differs", &text, 1);
}

#[test]
#[ignore = "a minute of Coq; `.ci/long` has it"]
fn everything_at_once_altered_in_any_line_is_refused() {
    // The body beside the way and its joint do not enter.
    let alone: Vec<&str> = EVERYTHING.lines().filter(|line| !line.contains("body other")).collect();
    let text = of_chain(&alone.join("\n"), 1).expect("a certificate");
    // Seven factors, the vector, three components, and the signs within each of these.
    crate::alterations::every_alteration_is_refused("altered_everything", &text, 7 + 1 + 3 + (5 + 8 + 8));
}

#[test]
fn the_third_order_is_derived_and_checked() {
    let chain = "chain C {
        body a on ground { motion: Rz(q); motion_error: Rx(e), Tz(d*e); }
        body b on a { motion_error: Ry(f); }
        observe o: direction(0, 1, 0) of b;
        observe p: point(0, 1, 0) of b;
    }";
    accepted("third_order", &of_chain(chain, 3).expect("a certificate"), 2);
    // cos e − 1 = −e²/2 and sin e = e − e³/6, turned by q.
    let right = ["e^2/2*sin(q)", "-e^2/2*cos(q)", "e - e^3/6"];
    let claim = |components| Claim { observable: "o", order: 3, keep: &["e"], components };
    let (holds, text) = of_claim(chain, &claim(right));
    assert!(holds);
    accepted("third_order_holds", &text, 1);
    let (holds, text) = of_claim(chain, &claim([right[0], right[1], "e - e^3/3"]));
    assert!(!holds);
    accepted("third_order_differs", &text, 1);
}

/// The certificate of the equality of two formulas; whether they are equal.
fn equality(title: &str, formulas: [&str; 2]) -> (bool, Result<String, Refusal>) {
    let declared = declared(EVERYTHING);
    let chain = claims::checker::extended(declared.chain());
    let claim = Equality::read(&chain, &PrintedSymbols::of_chain(&chain), formulas).expect("two formulas");
    let verdict = Checker::new(&chain).check(&Checked::Equality(Box::new(claim.clone()))).expect("a verdict");
    let Verdict::Equality(verdict) = verdict else { panic!("a verdict of another kind") };
    let mut certificate = Certificate::new(&declared);
    let written = certificate.equality(title, &claim, &verdict);
    (verdict.difference.is_zero(), written.map(|()| certificate.finish("test")))
}

#[test]
fn equal_formulas_are_proved_equal() {
    for (name, formulas) in [
        ("equal_doubles", ["sin(2*az)", "2*sin(az)*cos(az)"]),
        ("equal_tangent", ["tan(el)^2*cos(el)", "sec(el) - cos(el)"]),
        ("equal_errors", ["cos(tilt + sag)*heat", "heat*(cos(tilt)*cos(sag) - sin(tilt)*sin(sag))"]),
        ("equal_ramps", ["2*ramp(heat, 10, 20) - ramp(heat, 10, 20)", "ramp(heat, 10, 20)"]),
        ("equal_numbers", ["cos(pi/2) + 2*3", "6"]),
        ("equal_quarters", ["sin(lean + az + 3*pi/2)", "-cos(az + lean)"]),
    ] {
        let (holds, text) = equality(HOSTILE, formulas);
        assert!(holds, "{formulas:?}");
        accepted(name, &text.expect("a certificate"), 1);
    }
}

#[test]
fn different_formulas_are_proved_different_by_a_place() {
    for (name, formulas) in [
        ("unequal_sign", ["cos(az - el)", "cos(az)*cos(el) - sin(az)*sin(el)"]),
        ("unequal_circle", ["sin(2*az)*tan(el)", "2*sin(az)*tan(el)"]),
        ("unequal_numbers", ["1", "2"]),
        ("unequal_pi", ["az*cos(az)", "az"]),
    ] {
        let (holds, text) = equality("fun", formulas);
        assert!(!holds, "{formulas:?}");
        accepted(name, &text.expect("a certificate"), 1);
    }
}

#[test]
fn an_equality_altered_by_a_sign_is_refused() {
    let Some(folder) = coq::folder() else { return };
    for (name, formulas, from, to) in [
        ("altered_equal", ["cos(az + el)", "cos(az)*cos(el) - sin(az)*sin(el)"], " - sin", " + sin"),
        ("altered_unequal", ["cos(az - el)", "cos(az)*cos(el) - sin(az)*sin(el)"], " - sin", " + sin"),
    ] {
        let text = equality(name, formulas).1.expect("a certificate");
        let at = text.find("Definition second_formula").expect("the second formula");
        let altered = format!("{}{}", &text[..at], text[at..].replacen(from, to, 1));
        assert_ne!(altered, text);
        assert!(coq::check(folder, name, &text).is_ok(), "{name}");
        assert!(coq::check(folder, name, &altered).is_err(), "{name} is accepted after the alteration");
    }
}

#[test]
fn equalities_of_quotients_and_roots_are_decided_but_not_certified() {
    for formulas in [["sin(az)/(1 + cos(az))", "tan(az/2)"], ["cos(pi/4)", r"\frac{\sqrt{2}}{2}"]] {
        let (holds, text) = equality("half", formulas);
        assert!(holds, "{formulas:?}");
        assert_eq!(text, Err(Refusal::Claim));
    }
}

/// What is too much for Coq wherever the arm stands is certified where it is declared to stand, with its quarter turns.
#[test]
fn chains_that_would_keep_coq_busy_for_too_long_are_certified_as_they_are_placed() {
    let ur10 = include_str!("../../../examples/ur10/ur10.chain");
    let text = of_chain(ur10, 1).expect("a certificate");
    let theorems = text.matches("\nTheorem holds : claim.").count();
    assert!(theorems == 1 && text.contains("declared as zero or as quarter turns"), "{theorems}");
    // The same arm on a base that is not at the origin.
    let Err(Refusal::TooLarge { terms, limit: 1_000 }) = of_chain(&ur10.replace(" = 0;", " = 0.1;"), 1)
    else {
        panic!("not refused for its size")
    };
    assert!(terms > 1_000);
}
