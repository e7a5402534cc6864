//! Chains with many named constants that are not zero: the answer comes in time, and has the rank of the numbers.

use std::time::Instant;

use model_core::identify::identify;
use model_core::{Chain, ObservableId, SymbolKind, forms};
use nalgebra::DMatrix;

const UR10: &str = include_str!("../../../examples/ur10/ur10.chain");

/// The UR10 with its base placed and its reflector somewhere on the flange.
fn placed() -> Chain {
    let mut text = UR10.to_owned();
    for (number, name) in
        ["base_x", "base_y", "base_z", "reflector_x", "reflector_y", "reflector_z"].iter().enumerate()
    {
        let (old, new) = (format!("{name}: length = 0;"), format!("{name}: length = 0.{}3;", number + 1));
        assert!(text.contains(&old));
        text = text.replace(&old, &new);
    }
    for (number, name) in ["base_rx", "base_ry", "base_rz"].iter().enumerate() {
        let (old, new) = (format!("{name}: angle = 0;"), format!("{name}: angle = 0.{}7;", number + 1));
        assert!(text.contains(&old));
        text = text.replace(&old, &new);
    }
    Chain::from_text(&text).unwrap()
}

/// Serial arms of `joints` joints about turning axes, ten errors a joint, and ten constants.
fn long(joints: usize) -> Chain {
    let mut text = String::from("chain Long {\n");
    for constant in 0..10 {
        text += &format!("const l{constant}: length = 0.{}1;\n", constant + 1);
    }
    for joint in 0..joints {
        let lower = if joint == 0 { "ground".to_owned() } else { format!("b{}", joint - 1) };
        let axis = ["Rz", "Rx", "Ry"][joint % 3];
        let (one, other) = (joint % 10, (joint + 3) % 10);
        text += &format!(
            "body b{joint} on {lower} {{
                position: Tx(l{one}), Tz(l{other});
                position_error: Tx(dx{joint}), Ty(dy{joint}), Tz(dz{joint}), Rx(rx{joint}), Ry(ry{joint}), Rz(rz{joint});
                motion: {axis}(q{joint});
                motion_error: Rx(a{joint}), Ry(b{joint}), Tx(c{joint}), Ty(d{joint});
            }}\n"
        );
    }
    text += &format!("observe tip: point(l9, 0, l2) of b{}; }}", joints - 1);
    Chain::from_text(&text).unwrap()
}

/// The rank of the columns at many poses, in floating point.
fn rank_of_numbers(chain: &Chain) -> usize {
    let columns = forms::derive(chain, ObservableId(0), 1).unwrap().columns(chain);
    let mut random = testkit::Random::new(1);
    let poses = 2 * columns.len();
    let mut rows = Vec::new();
    for _ in 0..poses {
        let mut values = chain.nominal_values();
        for joint in chain.symbols_of(SymbolKind::Joint) {
            values[joint.index()] = 6.0 * random.even();
        }
        for axis in 0..3 {
            rows.extend(columns.iter().map(|(_, column)| column[axis].eval(&values)));
        }
    }
    DMatrix::from_row_slice(3 * poses, columns.len(), &rows).rank(1e-8)
}

#[test]
fn the_placed_arm_is_told_apart_in_time() {
    let chain = placed();
    let start = Instant::now();
    let found = identify(&chain, &[ObservableId(0)]).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(found.estimable.len(), rank_of_numbers(&chain));
    assert!(seconds < 10.0, "{seconds} s, which loaded machines take too");
}

#[test]
fn arms_with_ten_constants_are_told_apart() {
    for joints in [2, 3, 4] {
        let chain = long(joints);
        let found = identify(&chain, &[ObservableId(0)]).unwrap();
        assert_eq!(found.declared, 10 * joints);
        assert_eq!(found.estimable.len(), rank_of_numbers(&chain), "{joints} joints");
    }
}

#[test]
fn twelve_joints_and_a_hundred_and_twenty_errors_are_told_apart_in_time() {
    let chain = long(12);
    let start = Instant::now();
    let found = identify(&chain, &[ObservableId(0)]).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(found.declared, 120);
    assert!(found.estimable.len() < 120);
    assert!(seconds < 10.0, "{seconds} s, which loaded machines take too");
}

/// An arm whose second axis is turned against the first by a constant.
fn twisted(twist: &str) -> Chain {
    Chain::from_text(&format!(
        "chain Arm {{
            const twist: angle = {twist};
            body link1 on ground {{ motion: Rz(q1); motion_error: Ry(skew), Rz(zero1); }}
            body link2 on link1 {{ position: Rx(twist); motion: Rz(q2); motion_error: Rz(zero2); }}
            body link3 on link2 {{ position: Rx(twist), Ry(twist); motion: Ry(q3); motion_error: Ry(zero3), Rx(lean); }}
            observe tool: direction(1, 0, 0) of link3;
        }}"
    ))
    .unwrap()
}

/// A quarter turn is known exactly however it is written, and what it makes one is one; an angle near it makes two.
#[test]
fn what_quarter_turns_make_one_is_one() {
    let turns = ["pi/2", "-pi/2", "90 deg", "270 deg", "pi", "-1.5*pi", "0"];
    let mut fewer = 0;
    for twist in turns {
        let chain = twisted(twist);
        let found = identify(&chain, &[ObservableId(0)]).unwrap();
        assert_eq!(found.estimable.len(), rank_of_numbers(&chain), "{twist}");
        fewer += usize::from(found.estimable.len() < found.declared);
    }
    assert!(fewer >= 4, "{fewer}");
    for twist in ["89.9 deg", "1.5", "60 deg"] {
        let chain = twisted(twist);
        let found = identify(&chain, &[ObservableId(0)]).unwrap();
        assert_eq!(found.estimable.len(), rank_of_numbers(&chain), "{twist}");
    }
}
