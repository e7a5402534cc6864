//! A six-joint arm: which errors move the tool most over its workspace, from the first-order Jacobian.
//!
//! Run with `cargo run --example six-joint-arm`.
#![allow(clippy::print_stdout)]

use six_joint_arm::{Joints, SixJointArm};

trueaxis::chain_file!("examples/six-joint-arm/six-joint-arm.chain");

fn main() {
    let arm = SixJointArm::default();
    let mut largest = [0.0_f64; SixJointArm::ERROR_NAMES.len()];
    for step in 0..1000 {
        // Six turns at rates without a common period visit the workspace evenly.
        let turn = |rate: f64| f64::from(step) * rate;
        let joints = Joints {
            q1: turn(0.618),
            q2: turn(0.414),
            q3: turn(0.732),
            q4: turn(0.236),
            q5: turn(0.646),
            q6: turn(0.303),
        };
        let jacobian = arm.tip_jacobian(&joints);
        for (largest, column) in largest.iter_mut().zip(jacobian.column_iter()) {
            *largest = largest.max(column.norm());
        }
    }
    let mut ranked: Vec<(f64, &str)> = largest.into_iter().zip(SixJointArm::ERROR_NAMES).collect();
    ranked.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    println!("Largest movement of the tip for one unit of each error (m/rad, or m/m):");
    for (movement, name) in ranked.iter().take(10) {
        println!("{name:>10} {movement:>7.3}");
    }
}
