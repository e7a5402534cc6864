//! Ramps as amounts: what they are worth, what is said of wrong ones, and how they are told apart.
#![allow(clippy::unwrap_used)]

use model_core::print::Style;
use model_core::{Chain, forms, identify, print, syntax};

fn with(amount: &str) -> Result<Chain, model_core::Mistakes> {
    Chain::from_text(&format!(
        "chain Mount {{
            const edge: angle = 0.5;
            input ambient;
            body tube on ground {{
                motion: Rz(azimuth);
                motion_error: Rx(flop), Ry({amount});
            }}
            observe axis: direction(1, 0, 0) of tube;
        }}"
    ))
}

fn said(amount: &str) -> String {
    with(amount).unwrap_err().to_string()
}

#[test]
fn a_ramp_is_flat_linear_and_flat_again() {
    let value = |text: &str, x: f64| syntax::parse_amount(text).unwrap().eval(&|_| Some(x)).unwrap();
    let rising = "ramp(x, 1, 3)";
    assert_eq!([0.0, 1.0, 1.5, 2.0, 3.0, 9.0].map(|x| value(rising, x)), [0.0, 0.0, 0.25, 0.5, 1.0, 1.0]);
    let falling = "ramp(x, 3, 1)";
    assert_eq!([0.0, 1.0, 1.5, 2.0, 3.0, 9.0].map(|x| value(falling, x)), [1.0, 1.0, 0.75, 0.5, 0.0, 0.0]);
    // A step has its new value at the threshold itself.
    let step = "ramp(x, 2, 2)";
    assert_eq!([1.999, 2.0, 2.001].map(|x| value(step, x)), [0.0, 1.0, 1.0]);
    assert!(value(rising, f64::NAN).is_nan() && value(step, f64::NAN).is_nan());
}

#[test]
fn units_are_exact() {
    let same = |one: &str, other: &str| {
        let canonical = |text| {
            let chain = with("flop").unwrap();
            chain.amount(&syntax::parse_amount(text).unwrap()).unwrap()
        };
        assert_eq!(canonical(one), canonical(other), "{one} and {other}");
    };
    same("53 deg", "53*pi/180");
    same("2.5 arcsec", "5*pi/1296000");
    same("0.1 mm + 2 um", "102/1000000");
    same("-30 gon*2", "-3*pi/10");
}

#[test]
fn equal_ramps_are_one_variable_and_different_ones_are_two() {
    let chain =
        with("a*ramp(azimuth, 30 deg, 1) + b*ramp(azimuth, pi/6, 2/2) + c*ramp(azimuth, 1, pi/6)").unwrap();
    assert_eq!(chain.ramps.len(), 2);
    let axis = chain.find_observable("axis").unwrap();
    let form = forms::derive(&chain, axis, 1).unwrap();
    assert_eq!(
        print::form(&form, &chain, Style::Text),
        "axis_x = 0\naxis_y = 0\n\
         axis_z = -a*ramp(azimuth, 1/6*pi, 1) - b*ramp(azimuth, 1/6*pi, 1) - c*ramp(azimuth, 1, 1/6*pi)\n"
    );
    let found = identify::identify(&chain, &[axis]).unwrap();
    let names = |errors: Vec<model_core::SymbolId>| -> Vec<String> {
        errors.into_iter().map(|id| chain.symbol(id).name.clone()).collect()
    };
    assert_eq!(names(found.invisible.clone()), ["flop"]);
    assert_eq!(found.alike.len(), 1);
    assert_eq!(names(found.alike[0].iter().map(|member| member.error).collect()), ["a", "b"]);
}

#[test]
fn what_is_no_ramp_is_refused_with_a_place_and_advice() {
    let cases = [
        ("a*ramp(-azimuth, 0, 1)", "a ramp is taken of one joint or input"),
        ("a*ramp(edge, 0, 1)", "a ramp is taken of one joint or input"),
        ("a*ramp(azimuth, 0, ambient)", "the input `ambient` stands in a threshold"),
        ("a*ramp(azimuth, 0, sin(edge))", "made of more than numbers and constants"),
        ("a*ramp(azimuth, edge, 1/2)", "the same value, written differently"),
        ("a*ramp(azimuth, 0)", "expected `,`"),
        ("a*rampe(azimuth)", "did you mean `ramp`?"),
        ("ramp(azimuth, 0, 1)", "does not vanish"),
        ("a*sin(ramp(azimuth, 0, 1))", "whole multiples of angles"),
        ("ramp*a", "reserved word"),
    ];
    for (amount, expected) in cases {
        let found = said(amount);
        assert!(found.contains(expected), "{amount}: {found}");
    }
}

#[test]
fn a_joint_does_not_move_by_a_ramp() {
    for motion in ["Rz(azimuth + ramp(azimuth, 0, 1))", "Tz(travel + ramp(travel, 0, 1))"] {
        let text = format!(
            "chain Odd {{ body tube on ground {{ motion: {motion}; }} observe axis: direction(1, 0, 0) of tube; }}"
        );
        let found = Chain::from_text(&text).unwrap_err().to_string();
        assert!(found.contains("a motion "), "{found}");
    }
}
