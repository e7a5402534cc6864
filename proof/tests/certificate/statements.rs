//! What is certified, and that Coq accepts it on the axioms of its real numbers alone.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use model_core::identify;
use proof::{Certificate, Refusal};

use crate::coq;
use crate::support::{
    ALT_AZIMUTH, AXIOMS, Claim, EXCLUDED_MIDDLE, MOBILE_LIDAR, add, declared, observable, of_chain, of_claim,
    paper,
};

/// Coq accepts a certificate of so many statements, and says that each rests on nothing but its real numbers.
pub fn accepted(name: &str, text: &str, statements: usize) {
    let Some(folder) = coq::folder() else { return };
    match coq::check(folder, name, text) {
        // An equality of numbers may need fewer of them.
        Ok(assumptions) => rests_on(name, &assumptions, statements, &AXIOMS),
        Err(why) => panic!("{name}: {why}"),
    }
}

/// The same for statements about angles and lengths.
pub fn accepted_reading(name: &str, text: &str, statements: usize) {
    let Some(folder) = coq::folder() else { return };
    match coq::check(folder, name, text) {
        Ok(assumptions) => {
            rests_on(name, &assumptions, statements, &[&AXIOMS[..], &[EXCLUDED_MIDDLE]].concat());
        }
        Err(why) => panic!("{name}: {why}"),
    }
}

fn rests_on(name: &str, assumptions: &str, statements: usize, axioms: &[&str]) {
    let others = axioms.iter().fold(assumptions.to_owned(), |rest, axiom| rest.replace(axiom, ""));
    let told: Vec<&str> = others.lines().collect();
    assert_eq!(told, vec!["Axioms:"; statements], "{name}: {assumptions}");
}

#[test]
fn of_the_papers_equations_6_is_refuted_and_7_is_proved() {
    let text = paper();
    assert!(text.contains("Theorem differs : ~ (forall"), "{text}");
    accepted("paper", &text, 2);
}

#[test]
fn what_is_derived_is_proved_to_first_and_to_second_order() {
    accepted("alt_azimuth", &of_chain(ALT_AZIMUTH, 1).expect("a certificate"), 1);
    accepted(
        "turntable_2",
        &of_chain(include_str!("../../../examples/turntable/turntable.chain"), 2).expect("a certificate"),
        1,
    );
}

/// Harmonics, inputs, constants, sums of angles, rotations by design, products of errors, ramps, and names that mean
/// something to Coq or to the certificate itself.
const ANGLES: &str = "chain Angles {
    const lean: angle = pi/6;
    input temperature;
    body base on ground {
        position: Rx(lean + pi/2), Ry(-pi);
        position_error: Rz(t), Rx(x*temperature*0.5);
        motion: Rz(2*alpha - beta + 3*pi/2);
        motion_error: Rx(end*sin(3*alpha)), Ry(from_0*fun + from_0), Rz(squares*ramp(temperature, 10, 20) - squares*ramp(alpha, 39 deg, lean/2));
    }
    observe vector: direction(sin(lean), 0, cos(lean)) of base;
}";

/// A tree of sliding and turning joints; tangents and their like, with what has to differ from zero.
const POLES: &str = "chain Poles {
    const arm: length = 0.25;
    input heading: angle;
    body base on ground {
        motion: Rz(alpha);
        motion_error: Ty(e1*e2 + e1), Ry(k*tan(alpha)/2 + c*sec(heading));
    }
    body slide on base {
        motion: Tx(travel/2 + arm);
        motion_error: Rz(yaw*travel), Tz(sag*csc(alpha)*cot(alpha - pi/2));
    }
    body other on base { motion_error: Ry(last/sin(2*heading)); }
    observe tip: point(0, travel_offset, arm) of slide;
    observe side: direction(0, 0, 1) of other;
    const travel_offset: length = 0.1;
}";

#[test]
fn every_amount_of_the_language_is_certified() {
    accepted("angles", &of_chain(ANGLES, 1).expect("a certificate"), 1);
    let text = of_chain(POLES, 1).expect("a certificate");
    for condition in ["cos heading", "sin alpha", "cos alpha", "sin heading"] {
        assert!(text.contains(&format!(" : {condition} <> 0.")), "{condition}: {text}");
    }
    accepted("poles", &text, 2);
}

/// A difference that vanishes at every quarter turn, and one that is a multiple of π there.
#[test]
fn witnesses_are_found_where_quarter_turns_do_not_serve() {
    let chain = "chain C {
        body a on ground { motion: Rz(alpha); motion_error: Ry(s*alpha + p*sin(2*alpha)); }
        observe o: direction(0, 0, 1) of a;
    }";
    let claim = |components| Claim { observable: "o", order: 1, keep: &["*"], components };
    let (holds, text) = of_claim(
        chain,
        &claim([
            "s*alpha*cos(alpha) + 2*p*sin(alpha)*cos(alpha)^2",
            "s*alpha*sin(alpha) + p*sin(alpha)*sin(2*alpha)",
            "0",
        ]),
    );
    assert!(holds);
    accepted("witness_none", &text, 1);
    let (holds, text) = of_claim(
        chain,
        &claim([
            "2*s*alpha*cos(alpha) + p*sin(2*alpha)*cos(alpha)",
            "s*alpha*sin(alpha) + p*sin(alpha)*sin(2*alpha)",
            "0",
        ]),
    );
    assert!(!holds && text.contains("alpha = PI"), "{text}");
    accepted("witness_pi", &text, 1);
    let (holds, text) = of_claim(
        chain,
        &Claim {
            observable: "o",
            order: 1,
            keep: &["p"],
            components: ["0", "p*sin(alpha)*sin(2*alpha)", "0"],
        },
    );
    assert!(!holds && text.contains("cos alpha = 3 / 5 -> sin alpha = 4 / 5 ->"), "{text}");
    accepted("witness_circle", &text, 1);
}

/// The place of a witness has to be one where everything is defined.
#[test]
fn witnesses_are_where_tangents_are_defined() {
    let chain = "chain C {
        body a on ground { motion: Rz(alpha); motion_error: Ry(p*tan(alpha)*sec(alpha) + q*csc(2*alpha)); }
        observe o: direction(0, 0, 1) of a;
    }";
    let components = ["p*tan(alpha) + q*csc(alpha)", "p*tan(alpha)^2 + q*sec(alpha)/2", "0"];
    let (holds, text) = of_claim(chain, &Claim { observable: "o", order: 1, keep: &["*"], components });
    assert!(!holds && text.contains("sin alpha <> 0 -> claim"), "{text}");
    accepted("witness_defined", &text, 1);
}

#[test]
fn second_order_is_checked_as_printed() {
    let claim = Claim {
        observable: "pointing",
        order: 2,
        keep: &["db2"],
        components: [
            "db2*cos(alpha) - db2^2/2*sin(alpha)*sin(beta)",
            "db2*sin(alpha) + db2^2/2*cos(alpha)*sin(beta)",
            "-db2^2/2*cos(beta)",
        ],
    };
    let (holds, text) = of_claim(MOBILE_LIDAR, &claim);
    assert!(holds);
    accepted("second_order", &text, 1);
    let wrong = Claim { components: [claim.components[0], claim.components[1], "-db2^2*cos(beta)"], ..claim };
    let (holds, text) = of_claim(MOBILE_LIDAR, &wrong);
    assert!(!holds);
    accepted("second_order_wrong", &text, 1);
}

#[test]
fn what_identify_says_of_single_errors_is_proved() {
    let text = "chain C {
        const arm: length = 0.5;
        const nothing: angle = 0;
        body a on ground { position: Rx(nothing); motion: Rz(alpha); motion_error: Ry(tilt), Tx(shift), Rz(roll); }
        observe o: direction(0, 0, 1) of a;
        observe p: point(0, 0, arm) of a;
    }";
    let declared = declared(text);
    let mut certificate = Certificate::new(&declared);
    for name in ["o", "p"] {
        let id = observable(&declared, name);
        let found = identify::identify(declared.chain(), &[id]).expect("a closed form");
        for &error in &found.invisible {
            certificate.without_influence(id, error).expect("a certificate");
        }
        for group in &found.alike {
            for other in &group[1..] {
                certificate.alike(id, group[0].error, other.error, &other.ratio).expect("a certificate");
            }
        }
    }
    // Without influence: shift and roll on the direction, roll on the point; alike on the point: tilt and shift, with
    // what each of them does.
    let text = certificate.finish("test");
    assert_eq!(text.matches("Print Assumptions").count(), 6, "{text}");
    accepted("identify", &text, 6);
}

/// Where a constant turns one axis onto the next, two errors are one that would be two about axes that are skew.
#[test]
fn what_a_quarter_turn_makes_alike_is_proved() {
    let declared = declared(
        "chain C {
            const twist: angle = -90 deg;
            body a on ground { motion: Rz(q1); motion_error: Ry(skew); }
            body b on a { position: Rx(twist); motion: Rz(q2); motion_error: Rz(zero); }
            observe o: direction(1, 0, 0) of b;
        }",
    );
    let mut certificate = Certificate::new(&declared);
    let id = observable(&declared, "o");
    let found = identify::identify(declared.chain(), &[id]).expect("a closed form");
    let [one, other] = &found.alike[0][..] else { panic!("{found:?}") };
    certificate.alike(id, one.error, other.error, &other.ratio).expect("a certificate");
    accepted("quarter", &certificate.finish("test"), 3);
}

/// A wrong term beside a ramp is refuted; a wrong ramp is not: no numbers are put into it.
#[test]
fn ramps_are_certified_as_functions_of_their_own() {
    let chain = "chain C {
        input temperature;
        body a on ground { motion: Rz(alpha); motion_error: Rx(e*ramp(temperature, 10, 20) + d); }
        observe o: direction(0, 1, 0) of a;
    }";
    let claim = |z| Claim { observable: "o", order: 1, keep: &["*"], components: ["0", "0", z] };
    let (holds, text) = of_claim(chain, &claim("d + e*ramp(temperature, 10, 20)"));
    assert!(holds);
    accepted("ramp", &text, 1);
    let (holds, text) = of_claim(chain, &claim("e*ramp(temperature, 10, 20) - d"));
    assert!(!holds);
    accepted("ramp_beside", &text, 1);
    let declared = declared(chain);
    let mut certificate = Certificate::new(&declared);
    let refused = add(&mut certificate, &declared, "a wrong ramp", &claim("d - e*ramp(temperature, 10, 20)"));
    assert_eq!(refused, Err(Refusal::Ramp));
    assert!(certificate.is_empty());
}

#[test]
fn what_cannot_be_certified_is_refused_with_the_reason() {
    let chain = |amount: &str| {
        format!(
            "chain C {{ body a on ground {{ motion: Rz(alpha); motion_error: Rx({amount}); }} observe o: direction(0, 1, 0) of a; }}"
        )
    };
    assert!(of_chain(&chain("e*cos(24*alpha)"), 1).is_ok());
    let refused = of_chain(&chain("e*cos(25*alpha)"), 1);
    assert_eq!(refused, Err(Refusal::Harmonic { multiple: 25 }));
    assert_eq!(
        refused.map_err(|refusal| refusal.to_string()),
        Err("a formula contains the sine or cosine of 25 times an angle. Certificates go up to 24 times"
            .to_owned())
    );
}
