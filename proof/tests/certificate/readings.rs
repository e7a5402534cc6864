//! Angles, lengths, single components and other frames: proved, refuted, altered, refused.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use claims::checker::{Checker, ClosedForm, Order, PrintedVector};
use claims::latex::PrintedSymbols;
use model_core::forms::FormError;
use model_core::{Axis, SymbolKind};
use proof::{Certificate, Refusal};

use crate::coq;
use crate::statements::{accepted, accepted_reading};
use crate::support::{declared, observable, of_chain};

/// A total station: a leaning base, a tube that turns the other way, a target at a measured range.
fn station(observe: &str) -> String {
    format!(
        "chain Station {{
            input range: range;
            const lean: angle = 0.3;
            body base on ground {{ position_error: Rx(tx), Ry(ty); motion: Rz(az); motion_error: Rz(daz); }}
            body tube on base {{ motion: Ry(-el); motion_error: Rx(ca), Rz(cb), Ty(dy), Tx(dx); }}
            body lens on tube {{ position: Rx(lean); motion_error: Rz(dl); }}
            {observe}
        }}"
    )
}

#[test]
fn azimuths_elevations_and_ranges_are_proved_to_first_order() {
    let text = station(
        "observe sky: azimuth, elevation of direction(1, 0, 0) of tube;
         observe zen: zenith_distance of direction(1, 0, 0) of tube;
         observe cross: cross_elevation of direction(1, 0, 0) of tube;
         observe target: range, azimuth, elevation of point(range, 0, 0) of tube;
         observe back: hour_angle, zenith_distance(-z) of direction(1, 0, 0) of tube;",
    );
    let certificate = of_chain(&text, 1).expect("a certificate");
    // Where it is defined is said.
    for condition in ["cos el <> 0", "0 < cos el", "range <> 0", "0 < range"] {
        assert!(certificate.contains(&format!(": {condition}.")), "{condition}");
    }
    accepted_reading("readings", &certificate, 5);
}

/// Components and other frames need no arc tangent.
#[test]
fn components_and_other_frames_are_proved() {
    let text = station(
        "observe two: z, x of direction(0, 1, 0) of lens;
         observe down: direction(0, 1, 0) of lens in base;
         observe back: point(0, range, 1) of base in lens;
         observe still: point(1, 0, 0) of tube in base;",
    );
    accepted("frames", &of_chain(&text, 1).expect("a certificate"), 4);
    let text = station("observe two: z, x of direction(0, 1, 0) of lens in base;");
    accepted("frames_2", &of_chain(&text, 2).expect("a certificate"), 1);
}

/// The certificate of a claim on what an observable shows, or on one number of it; whether it holds.
fn claim(
    chain: &str,
    name: &str,
    only: Option<Axis>,
    printed: &[&str],
    order: u32,
) -> (bool, Result<String, Refusal>) {
    let declared = declared(chain);
    let chain = declared.chain();
    let id = observable(&declared, name);
    let (symbols, shown) = (PrintedSymbols::of_chain(chain), chain.observable(id));
    let printed = match only {
        Some(place) => PrintedVector::read_one(chain, &symbols, printed[0], shown, place, Order::UpTo(1)),
        None => PrintedVector::read_shown(chain, &symbols, shown, printed, Order::UpTo(1)),
    };
    let form = ClosedForm {
        observable: id,
        order: Order::UpTo(order),
        only,
        faces: None,
        kept: chain.symbols_of(SymbolKind::Error).collect(),
        printed: printed.expect("formulas that can be read"),
    };
    let verdict = Checker::new(chain).closed_form(&form).expect("a closed form");
    let mut certificate = Certificate::new(&declared);
    let written = certificate.closed_form("the claim", &form, &verdict);
    (verdict.differences.is_empty(), written.map(|()| certificate.finish("test")))
}

/// By hand: a tube along x, turned by az about z and up by el, that leans by tx about x and ty about y.
const AZIMUTH: &str = "daz - tan(el)*(tx*cos(az) + ty*sin(az)) + cb/cos(el)";
const ELEVATION: &str = "tx*sin(az) - ty*cos(az)";

#[test]
fn printed_angles_are_proved_and_refuted() {
    let mut text = station("observe sky: azimuth, elevation of direction(1, 0, 0) of tube;");
    // The lens is not on the way.
    text = text.replace("Rx(ca), Rz(cb), Ty(dy), Tx(dx)", "Rx(ca), Rz(cb)");
    let (holds, certificate) = claim(&text, "sky", None, &[AZIMUTH, ELEVATION], 1);
    assert!(holds);
    accepted_reading("sky_holds", &certificate.expect("a certificate"), 1);
    let wrong = AZIMUTH.replace("cb/cos(el)", "cb");
    let (holds, certificate) = claim(&text, "sky", None, &[&wrong, ELEVATION], 1);
    assert!(!holds);
    accepted_reading("sky_differs", &certificate.expect("a certificate"), 1);
    // One number alone, and one that is wrong where the other is right.
    let (holds, certificate) = claim(&text, "sky", Some(Axis::Y), &[ELEVATION], 1);
    assert!(holds);
    accepted_reading("elevation_holds", &certificate.expect("a certificate"), 1);
    let (holds, certificate) = claim(&text, "sky", None, &[AZIMUTH, "tx*sin(az) + ty*cos(az)"], 1);
    assert!(!holds);
    accepted_reading("elevation_differs", &certificate.expect("a certificate"), 1);
}

/// What is divided by is a measured range, and the place has one that is not zero.
#[test]
fn quotients_by_a_range_are_proved_and_refuted() {
    let text = "chain Tracker {
        input range: range;
        body base on ground { motion: Rz(az); }
        body tube on base { motion: Ry(-el); motion_error: Ty(dy); }
        observe target: range, azimuth of point(range, 0, 0) of tube;
    }";
    let (holds, certificate) = claim(text, "target", None, &["0", "dy/(range*cos(el))"], 1);
    assert!(holds);
    accepted_reading("range_holds", &certificate.expect("a certificate"), 1);
    let (holds, certificate) = claim(text, "target", None, &["0", "dy/range"], 1);
    assert!(!holds);
    accepted_reading("range_differs", &certificate.expect("a certificate"), 1);
}

/// One component of a vector is claimed alone.
#[test]
fn one_component_of_a_vector_is_proved_and_refuted() {
    let text = station("observe v: direction(1, 0, 0) of base;");
    let (holds, certificate) = claim(&text, "v", Some(Axis::Z), &["tx*sin(az) - ty*cos(az)"], 1);
    assert!(holds);
    accepted("component_holds", &certificate.expect("a certificate"), 1);
    let (holds, certificate) = claim(&text, "v", Some(Axis::Z), &["tx*sin(az) - ty*sin(az)"], 1);
    assert!(!holds);
    accepted("component_differs", &certificate.expect("a certificate"), 1);
}

#[test]
fn an_altered_reading_is_refused() {
    let Some(folder) = coq::folder() else { return };
    let text = station("observe sky: azimuth, elevation of direction(1, 0, 0) of tube;");
    let text = of_chain(&text, 1).expect("a certificate");
    let definitions = ["derived_azimuth : R :=\n  ", "derived_elevation : R :=\n  "];
    for (index, definition) in definitions.iter().enumerate() {
        let altered = text.replacen(definition, &format!("{definition}- "), 1);
        assert_ne!(altered, text);
        assert!(coq::check(folder, &format!("altered_reading_{index}"), &altered).is_err());
    }
    for (from, to) in
        [("azimuth_error (Plus X) (Plus Y)", "azimuth_error (Plus X) (Minus Y)"), ("Ry (- el)", "Ry (el)")]
    {
        let altered = text.replace(from, to);
        assert_ne!(altered, text, "{from}");
        assert!(coq::check(folder, "altered_reading", &altered).is_err(), "{from}");
    }
}

/// What has no such proof is refused in words.
#[test]
fn what_is_no_smooth_angle_to_first_order_is_refused() {
    let refused = |observe: &str, order| of_chain(&station(observe), order).expect_err("no certificate");
    assert_eq!(
        refused("observe sky: azimuth, elevation of direction(1, 0, 0) of tube;", 2),
        Refusal::ReadingToOrder { reading: "azimuth".to_owned(), order: 2 }
    );
    assert!(matches!(
        refused("observe off: off_axis of direction(1, 0, 0) of tube;", 1),
        Refusal::Form(FormError::NotSmooth { .. })
    ));
    assert_eq!(
        refused("observe turned: orientation of tube;", 1),
        Refusal::Orientation { reading: "rotation x".to_owned() }
    );
}

/// Names that a statement about readings gives a meaning to itself, and a constant in the geometry.
#[test]
fn names_of_the_statement_are_names() {
    let text = "chain Reading {
        const Minus: angle = 0.3;
        const sqrt: length = 2;
        input atan: range;
        body seen on ground { position: Rx(Minus); position_error: Rx(Plus), Ty(component); motion: Rz(seen); }
        body back on seen { position: Tx(sqrt); motion: Ry(-opposite); motion_error: Rz(printed_azimuth), Ry(derived_azimuth), Rx(C0); }
        observe is_seen: azimuth, elevation of direction(1, 0, 0) of back in seen;
        observe seen_0: z of point(sqrt, 0, atan) of seen;
    }";
    let certificate = of_chain(text, 1).expect("a certificate");
    accepted_reading("reading_names", &certificate, 2);
}

/// At the pole an azimuth is no angle, and where everything is at rest it is one without errors.
#[test]
fn poles_are_refused_and_rest_is_proved() {
    let pole = station("observe up: azimuth of direction(0, 0, 1) of base;");
    assert!(matches!(of_chain(&pole, 1), Err(Refusal::Form(FormError::NotSmooth { .. }))));
    let rest = "chain Rest { body a on ground { motion: Rz(q); motion_error: Rz(e); } body b on ground { }
        observe still: azimuth, elevation of direction(3, 4, 0) of b; }";
    accepted_reading("rest", &of_chain(rest, 1).expect("a certificate"), 1);
}

/// A tracker whose head stands beside its axis: its azimuth divides by a sum.
const OFFSET: &str = "chain Tracker {
    const off: length = 0.1;
    input range: range;
    body base on ground { motion: Rz(pan); motion_error: Rx(i); }
    body head on base { position: Tx(off); position_error: Ty(e); motion: Ry(-tilt); motion_error: Rz(c); }
    observe seen: azimuth of point(range, 0, 0) of head;
}";

/// Quotients by sums are proved where the sum is not zero, and refuted at a place where it is not.
#[test]
fn quotients_by_sums_are_proved_under_their_condition() {
    let derived = of_chain(OFFSET, 1).expect("a certificate");
    assert!(derived.contains("<> 0."), "{derived}");
    accepted_reading("by_sums", &derived, 1);
    // The same as a paper would print it, and with a slip.
    let printed = ["(e + range*c)/(off + range*cos(tilt)) - i*range*sin(tilt)/(off + range*cos(tilt))"];
    let (holds, text) = claim(OFFSET, "seen", None, &printed, 1);
    assert!(holds);
    accepted_reading("by_sums_printed", &text.expect("a certificate"), 1);
    let (holds, text) = claim(OFFSET, "seen", None, &[&printed[0].replace("off +", "off -")], 1);
    assert!(!holds);
    accepted_reading("by_sums_slip", &text.expect("a certificate"), 1);
    let altered = derived.replacen("Ry (- tilt)", "Ry (tilt)", 1);
    if let Some(folder) = coq::folder() {
        assert_ne!(altered, derived);
        assert!(coq::check(folder, "by_sums_altered", &altered).is_err());
    }
}
