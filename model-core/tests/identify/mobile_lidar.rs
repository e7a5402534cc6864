//! The published scanner.

use model_core::identify::{Candidate, identify, mistaken_for, mistaken_text, text};
use model_core::{BodyId, Chain, Role};

fn chain() -> Chain {
    Chain::from_text(include_str!("../../../examples/mobile-lidar/mobile-lidar.chain")).unwrap()
}

fn told_apart(observables: &[&str]) -> String {
    let chain = chain();
    let ids: Vec<_> = observables.iter().map(|name| chain.find_observable(name).unwrap()).collect();
    text(&identify(&chain, &ids).unwrap(), &chain)
}

#[test]
fn from_pointing_alone() {
    insta::assert_snapshot!(told_apart(&["pointing"]));
}

#[test]
fn from_the_target_alone_as_much_as_from_pointing_and_position() {
    insta::assert_snapshot!(told_apart(&["target"]));
    let body = |text: String| text.split_once('\n').unwrap().1.to_owned();
    assert_eq!(body(told_apart(&["pointing", "position"])), body(told_apart(&["target"])));
}

#[test]
fn candidates_are_mistaken_for_what_they_look_like() {
    let chain = chain();
    let pointing = chain.find_observable("pointing").unwrap();
    let middle = chain.bodies.iter().position(|body| body.name == "middle").unwrap();
    let verdict = |effect: &str| {
        let middle = BodyId(u16::try_from(middle).unwrap());
        let candidate = Candidate::parse(&chain, middle, Role::MotionError, effect).unwrap();
        mistaken_text(&mistaken_for(&candidate, &[pointing]).unwrap())
    };
    assert_eq!(verdict("Ry(q)"), "q: would be mistaken for db2 (or dtheta_y3)\n");
    assert_eq!(verdict("Ry(-2*q)"), "q: would be mistaken for -2*db2 (or dtheta_y3)\n");
    assert_eq!(verdict("Rx(q)"), "q: would be mistaken for da1 (or dtheta_x3)\n");
    assert_eq!(verdict("Rz(q)"), "q: has no influence (first order)\n");
    assert_eq!(verdict("Rx(q*cos(beta))"), "q: can be told apart from every declared error\n");
}

#[test]
fn a_candidate_that_cannot_be_read_is_told_where() {
    let chain = chain();
    let read = |text: &str| Candidate::parse(&chain, BodyId(0), Role::MotionError, text).unwrap_err();
    let place = |text: &str| read(text).iter().next().unwrap().place.bytes.clone();
    assert_eq!(place("Qx(a)"), 0..5);
    assert_eq!(place("Rx(q*cos(beta*alpha))"), 9..19);
    assert_eq!(place("Rx(q*)"), 4..5);
}
