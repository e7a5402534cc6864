//! What acts on a line of sight: the angle from up, and a direction that is bent towards up.
#![allow(clippy::unwrap_used)]

use model_core::syntax::Declaration;
use model_core::{Chain, SymbolKind, exact, forms, print};
use nalgebra::Vector3;

const EQUATORIAL: &str = "chain Equatorial {
    const latitude: angle = 0.7;
    input zenith: angle = between(sky, up);
    gravity: (-cos(latitude), 0, -sin(latitude));
    body polar on ground { motion: Rz(-hour); motion_error: Rz(index); }
    body tube on polar { motion: Ry(-declination); }
    observe sky: direction(1, 0, 0) of tube, bent up by refraction*tan(zenith) + second*tan(zenith)^3;
}";
const ALT_AZIMUTH: &str = "chain AltAzimuth {
    input zenith: angle = between(sky, up);
    body alidade on ground { motion: Rz(-azimuth); }
    body tube on alidade { motion: Rx(elevation); }
    observe sky: direction(0, 1, 0) of tube, bent up by refraction*tan(zenith);
}";

fn at(chain: &Chain, given: &[(&str, f64)]) -> Vec<f64> {
    let mut values = chain.nominal_values();
    for (name, value) in given {
        values[chain.find_symbol(name).unwrap().index()] = *value;
    }
    values
}

#[test]
fn a_direction_is_bent_towards_up_by_the_amount() {
    let chain = Chain::from_text(EQUATORIAL).unwrap();
    let sky = chain.find_observable("sky").unwrap();
    let up = Vector3::new(0.7_f64.cos(), 0.0, 0.7_f64.sin());
    for (hour, declination) in [(0.9, 0.2), (-1.1, 1.2), (0.3, -0.4)] {
        let pose = [("hour", hour), ("declination", declination)];
        let without = exact::value(&chain, sky, &at(&chain, &pose));
        let amount = 1e-3 * without.angle(&up).tan();
        let bent = exact::value(&chain, sky, &at(&chain, &[pose[0], pose[1], ("refraction", 1e-3)]));
        // A turn about the horizontal across the direction.
        let axis = nalgebra::Unit::new_normalize(without.cross(&up));
        let turned = nalgebra::Rotation3::from_axis_angle(&axis, amount) * without;
        assert!((bent - turned).norm() < amount.powi(3), "{}", (bent - turned).norm());
        assert!(bent.angle(&up) < without.angle(&up));
    }
}

#[test]
fn the_first_order_is_what_the_exact_form_does_with_a_small_error() {
    let chain = Chain::from_text(EQUATORIAL).unwrap();
    let sky = chain.find_observable("sky").unwrap();
    let form = forms::derive(&chain, sky, 1).unwrap();
    let small = 1e-9;
    for name in ["refraction", "second", "index"] {
        let mut values = at(&chain, &[("hour", 0.9), ("declination", 0.2), (name, small)]);
        let exact = exact::error(&chain, sky, &values);
        chain.set_derived(&mut values);
        for (axis, component) in form.components.iter().enumerate() {
            let first = component.above.eval(&values);
            assert!((first - exact[axis]).abs() < 1e-7 * small, "{name}: {first} {}", exact[axis]);
        }
    }
}

#[test]
fn where_a_joint_counts_from_the_horizon_the_angle_is_that_joint() {
    let chain = Chain::from_text(ALT_AZIMUTH).unwrap();
    let sky = chain.find_observable("sky").unwrap();
    let bend = chain.observable(sky).bend.as_ref().unwrap();
    let shown: Vec<String> = bend.factors.iter().map(|factor| print::text(&factor.amount, &chain)).collect();
    assert_eq!(shown, ["refraction*cot(elevation)"]);
    let plain = ALT_AZIMUTH.replace(", bent up by refraction*tan(zenith)", "").replace(
        "motion: Rx(elevation);",
        "motion: Rx(elevation); motion_error: Rx(refraction*cot(elevation));",
    );
    let plain = Chain::from_text(&plain).unwrap();
    let form = |chain: &Chain| {
        let form = forms::derive(chain, sky, 1).unwrap();
        print::form(&form, chain, print::Style::Text)
    };
    assert_eq!(form(&chain), form(&plain));
}

#[test]
fn the_angle_is_no_reading_and_follows_from_the_joints() {
    let chain = Chain::from_text(EQUATORIAL).unwrap();
    let zenith = chain.find_symbol("zenith").unwrap();
    assert_eq!(chain.symbol(zenith).kind, SymbolKind::SightAngle);
    let of_way = chain.symbols_of_way(chain.find_observable("sky").unwrap());
    assert!(!of_way.contains(&zenith));
    assert!(of_way.contains(&chain.find_symbol("latitude").unwrap()));
    let mut values = at(&chain, &[("declination", 0.7)]);
    chain.set_derived(&mut values);
    assert!(values[zenith.index()].abs() < 1e-15, "the zenith at the declination of the latitude");
}

#[test]
fn what_was_written_is_printed_and_read_again() {
    for text in [EQUATORIAL, ALT_AZIMUTH] {
        let printed = Declaration::from_text(text).unwrap().to_string();
        assert!(printed.contains("input zenith: angle = between(sky, up);"), "{printed}");
        assert!(printed.contains(" of tube, bent up by refraction*tan(zenith)"), "{printed}");
        assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(text).unwrap());
    }
}

#[test]
fn each_mistake_has_its_place_and_its_advice() {
    let said = |from: &str, to: &str| {
        let text = ALT_AZIMUTH.replace(from, to);
        assert_ne!(text, ALT_AZIMUTH);
        Chain::from_text(&text).unwrap_err().to_string()
    };
    for (from, to, expected) in [
        ("between(sky, up)", "between(sky, down)", "an angle is counted from `up`, not from `down`"),
        ("between(sky, up)", "between(sky)", "expected `,`"),
        ("between(sky, up)", "among(sky, up)", "expected `between`"),
        ("between(sky, up)", "between(star, up)", "no observable is called `star`"),
        ("zenith: angle", "zenith: length", "what is between two directions is an angle"),
        ("direction(0, 1, 0)", "point(0, 1, 0)", "`sky` is observed as a point"),
        ("direction(0, 1, 0)", "direction(0, 1, 1)", "the direction `sky` is not along an axis of its body"),
        (
            "bent up by refraction*tan(zenith)",
            "bent up by tan(zenith)",
            "does not vanish when every error is zero",
        ),
        ("bent up by", "bent down by", "expected `up`"),
        (
            "    input zenith: angle = between(sky, up);\n",
            "    input zenith: angle;\n",
            "the angle between `sky` and up has no name",
        ),
        (
            "motion: Rx(elevation)",
            "motion: Rx(elevation + zenith)",
            "the angle of a line of sight `zenith` stands in a motion",
        ),
        (
            "body alidade",
            "gravity: (0, 1, -1); body alidade",
            "the direction of gravity has no length that is known to be one",
        ),
    ] {
        let said = said(from, to);
        assert!(said.contains(expected), "{from} -> {to}: {said}");
    }
}

#[test]
fn a_bound_needs_ranges_that_keep_from_the_horizon() {
    use model_core::remainder::{Domain, bound};
    let chain = Chain::from_text(EQUATORIAL).unwrap();
    let sky = chain.find_observable("sky").unwrap();
    let id = |name: &str| chain.find_symbol(name).unwrap();
    let mut domain = Domain::new(&chain);
    domain.set_size(&chain, id("refraction"), 1e-3).unwrap();
    let refused = bound(&chain, sky, &domain).unwrap_err().to_string();
    assert!(refused.contains("`zenith` follows from the joints"), "{refused}");
    domain.set_range(&chain, id("hour"), -0.5, 0.5).unwrap();
    domain.set_range(&chain, id("declination"), 0.3, 0.8).unwrap();
    let bound = bound(&chain, sky, &domain).unwrap();
    // The first order of a turn by 1e-3 leaves half its square.
    assert!((5e-8..5e-6).contains(&bound.value), "{}", bound.value);
}
