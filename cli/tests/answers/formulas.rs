//! Closed forms, null spaces and bounds of the mobile lidar.

use insta::assert_snapshot;
use serde_json::Value;

use crate::support::Folder;
use crate::{LIDAR, answered};

#[test]
fn closed_forms_of_the_mobile_lidar() {
    for observable in ["pointing", "position", "target"] {
        for format in ["text", "latex", "markdown"] {
            let answer = answered(&["derive", LIDAR, "--observable", observable, "--format", format]);
            assert_snapshot!(format!("{observable}-{format}"), answer);
        }
    }
}

#[test]
fn higher_orders_hold_the_lower_ones() {
    let lines = |order| {
        let answer =
            answered(&["derive", LIDAR, "--observable", "position", "--order", order, "--format", "json"]);
        let answer: Value = serde_json::from_str(&answer).expect("JSON");
        answer["observables"][0]["components"]["z"]["text"].as_str().expect("a formula").to_owned()
    };
    let [first, second, third] = ["1", "2", "3"].map(lines);
    assert!(first.len() < second.len() && second.len() < third.len());
    assert!(second.contains("dz1") && third.contains("dz1"), "the first order is in the higher ones");
}

#[test]
fn what_pointing_cannot_tell_apart() {
    assert_snapshot!(answered(&["identify", LIDAR, "--observable", "pointing"]));
}

#[test]
fn what_an_eccentric_encoder_would_be_mistaken_for() {
    let candidate = "middle Rx(cosine*cos(beta) + sine*sin(beta) + index)";
    let answer = answered(&["identify", LIDAR, "--observable", "pointing", "--candidate", candidate]);
    let (_, candidate) = answer.split_once("the candidate:").expect("an answer on the candidate");
    assert_snapshot!(candidate);
}

#[test]
fn the_bound_is_above_what_a_search_finds_and_below_twice_that() {
    let sizes = "examples/mobile-lidar/box.toml";
    for observable in ["pointing", "position"] {
        let arguments = ["bound", LIDAR, "--sizes", sizes, "--observable", observable, "--format", "json"];
        let answer: Value = serde_json::from_str(&answered(&arguments)).expect("JSON");
        let ratio = answer["bounds"][0]["ratio"].as_f64().expect("a number");
        assert!((1.0..2.0).contains(&ratio), "{observable}: {ratio}");
    }
}

#[test]
fn a_range_makes_a_bound_for_the_target() {
    let sizes = "examples/mobile-lidar/box.toml";
    let range = ["--range", "range=1 m..50 m", "--observable", "target"];
    let answer = answered(&[["bound", LIDAR, "--sizes", sizes].as_slice(), &range].concat());
    assert!(answer.starts_with("target: |exact - first order| is never more than "), "{answer}");
}

/// A shift along its own axis has no second order; of sizes whose products are below rounding a search sees rounding alone.
#[test]
fn what_a_search_finds_is_never_told_above_the_bound() {
    let folder = Folder::new("bound-of-nothing");
    folder.write(
        "slide.chain",
        "chain Slide {\n\
         body slide on ground { motion: Tx(x); motion_error: Tx(zero); }\n\
         body tip on slide { position_error: Rz(tilt); }\n\
         observe carriage: point(0, 0, 0) of slide; observe tip: point(1, 0, 0) of tip; }\n",
    );
    let bound = |sizes: &str, observable: &str, format: &str| {
        folder.write("box.toml", sizes);
        let ask =
            ["bound", "slide.chain", "--sizes", "box.toml", "--observable", observable, "--format", format];
        let run = folder.trueaxis(&[&ask[..], &["--range", "x=-1 m..3.3 m"]].concat());
        assert_eq!(run.code, 0, "{run}");
        run.stdout
    };
    let sizes = "zero = \"0.1 mm\"\ntilt = \"10 arcsec\"\n";
    let text = bound(sizes, "carriage", "text");
    assert!(text.contains("the first order is exact here") && !text.contains("found"), "{text}");
    let answer: Value = serde_json::from_str(&bound(sizes, "carriage", "json")).expect("JSON");
    assert_eq!(answer["bounds"][0]["bound"], 0.0);
    assert!(answer["bounds"][0]["largest_found"].is_null() && answer["bounds"][0]["ratio"].is_null());
    // Products of errors far below what numbers hold beside one.
    let small = "zero = \"0.1 mm\"\ntilt = \"1e-9 rad\"\n";
    let answer: Value = serde_json::from_str(&bound(small, "tip", "json")).expect("JSON");
    let [proven, found] = ["bound", "largest_found"].map(|key| answer["bounds"][0][key].as_f64());
    assert!(proven > Some(0.0) && found <= proven, "{answer}");
    assert!(bound(sizes, "tip", "text").contains("largest found by search"));
}
