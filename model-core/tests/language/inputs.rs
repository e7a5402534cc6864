//! What inputs are declared to be, and errors that are most likely none.
#![allow(clippy::unwrap_used)]

use model_core::caution::cautions;
use model_core::syntax::Declaration;
use model_core::{Chain, Meaning, Quantity};

const MOUNT: &str = "chain Mount {
    input ambient: temperature;
    input stamp: time;
    input pier: side;
    input way: direction;
    input speed: rate;
    input distance: range;
    input tilt: angle;
    input swing: direction of azimuth;
    input wave: phase of distance;
    input plain;
    body tube on ground {
        motion: Rz(azimuth);
        motion_error: Rx(drift*ambient), Ry(flop*pier*cos(tilt)), Rz(scale*azimuht + lag*speed);
    }
    observe spot: point(0, 0, distance) of tube;
}";

#[test]
fn an_input_is_what_its_statement_says_and_not_what_its_name_sounds_like() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let of = |name: &str| {
        let symbol = chain.symbol(chain.find_symbol(name).unwrap());
        (symbol.meaning, symbol.quantity, symbol.unit())
    };
    assert_eq!(of("ambient"), (Some(Meaning::Temperature), Quantity::Number, "K"));
    assert_eq!(of("stamp"), (Some(Meaning::Time), Quantity::Number, "s"));
    assert_eq!(of("pier"), (Some(Meaning::Side), Quantity::Number, "1"));
    assert_eq!(of("way"), (Some(Meaning::Direction), Quantity::Number, "1"));
    assert_eq!(of("speed"), (Some(Meaning::Rate), Quantity::Number, "rad/s"));
    assert_eq!(of("distance"), (Some(Meaning::Range), Quantity::Length, "m"));
    assert_eq!(of("tilt"), (Some(Meaning::Angle), Quantity::Angle, "rad"));
    assert_eq!(of("plain"), (None, Quantity::Number, "1"));
    assert_eq!(of("drift"), (None, Quantity::Angle, "rad"));
}

#[test]
fn a_direction_is_of_a_joint_and_a_phase_of_a_length() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let of = |name: &str| {
        chain.symbol(chain.find_symbol(name).unwrap()).of.map(|id| chain.symbol(id).name.clone())
    };
    assert_eq!(of("swing").as_deref(), Some("azimuth"));
    assert_eq!(of("wave").as_deref(), Some("distance"));
    assert_eq!(of("way"), None);
    let mistaken = |from: &str, to: &str| Chain::from_text(&MOUNT.replace(from, to)).unwrap_err().to_string();
    for (from, to, said) in [
        (
            "direction of azimuth",
            "direction of distance",
            "`direction` is of a joint, which `distance` is not",
        ),
        ("direction of azimuth", "direction of azimut", "`direction` is of a joint, which `azimut` is not"),
        ("phase of distance", "phase of azimuth", "`phase` is of a joint or input that is a length"),
        ("side;", "side of azimuth;", "the meaning `side` is of nothing"),
        ("direction of azimuth", "direktion of azimuth", "unknown meaning `direktion`"),
        ("direction of azimuth", "direction of", "a joint or a length"),
    ] {
        let found = mistaken(from, to);
        assert!(found.contains(said), "{to}: {found}");
    }
}

#[test]
fn the_printer_keeps_what_an_input_is() {
    let printed = Declaration::from_text(MOUNT).unwrap().to_string();
    assert!(printed.contains("input ambient: temperature;") && printed.contains("input plain;"));
    assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(MOUNT).unwrap());
}

#[test]
fn a_constant_is_no_temperature() {
    let text = "chain C { const t: temperature = 3; body b on ground { motion: Rz(a); } }";
    let found = Chain::from_text(text).unwrap_err().to_string();
    assert!(found.contains("unknown quantity `temperature`"), "{found}");
}

#[test]
fn a_name_that_became_an_error_by_a_slip_is_cautioned_of() {
    let found = cautions(&Chain::from_text(MOUNT).unwrap());
    let said: Vec<(&str, Option<&str>)> =
        found.iter().map(|caution| (caution.name.as_str(), caution.near.as_deref())).collect();
    // Neither of the two says which of them is the error.
    assert_eq!(said, [("scale", None), ("azimuht", Some("azimuth"))]);
}

#[test]
fn a_declaration_has_a_limit_with_a_message() {
    let many: String = (0..70_000).map(|n| format!("observe o{n}: direction(1, 0, 0) of b;")).collect();
    let text = format!("chain C {{ body b on ground {{ motion: Rz(a); }} {many} }}");
    let found = Chain::from_text(&text).unwrap_err().to_string();
    assert!(found.contains("more than 1000 observables in one chain"), "{found}");
    let tower = "((((((9^32)^32)^32)^32)^32)^32)";
    let text = format!("chain C {{ body b on ground {{ motion: Rz(a); motion_error: Rx(e*{tower}); }} }}");
    let found = Chain::from_text(&text).unwrap_err().to_string();
    assert!(found.contains("too large"), "{found}");
}
