//! The three-axis scanner: its formula, and how far the first-order form is from the exact one.
//!
//! Run with `cargo run --example mobile-lidar`.
#![allow(clippy::print_stdout)]

use mobile_lidar::{Errors, Inputs, Joints, MobileLidar};

trueaxis::chain_file!("examples/mobile-lidar/mobile-lidar.chain");

/// One second of arc, in radians.
const ARCSEC: f64 = core::f64::consts::PI / (180.0 * 3600.0);

fn main() {
    println!("First-order pointing error of {}:", MobileLidar::NAME);
    for (axis, component) in ["x", "y", "z"].iter().zip(MobileLidar::POINTING_FIRST_ORDER) {
        println!("  {axis}: {component}");
    }

    let errors = Errors { dtheta_y1: 10.0 * ARCSEC, db2: 5.0 * ARCSEC, delta_x2: 1e-4, ..Errors::default() };
    let lidar = MobileLidar::new(errors);
    let inputs = Inputs { range: 50.0 };
    println!("\nError of a target at {} m, in micrometres:", inputs.range);
    println!("{:>8} {:>12} {:>12} {:>12} {:>14}", "degrees", "x", "y", "z", "beyond order 1");
    for degrees in [0.0_f64, 45.0, 90.0, 135.0] {
        let angle = degrees.to_radians();
        let joints = Joints { alpha: angle, beta: angle, gamma: angle };
        let exact = lidar.target_error(&joints, &inputs) * 1e6;
        let beyond = exact - lidar.target_first_order(&joints, &inputs) * 1e6;
        println!(
            "{degrees:>8} {:>12.3} {:>12.3} {:>12.3} {:>14.2e}",
            exact.x,
            exact.y,
            exact.z,
            beyond.norm()
        );
    }
}
