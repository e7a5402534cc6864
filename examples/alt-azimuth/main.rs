//! An alt-azimuth mount: the pointing terms that follow from its declaration, and a correction table.
//!
//! Run with `cargo run --example alt-azimuth`.
#![allow(clippy::print_stdout)]

use alt_azimuth::{AltAzimuth, Errors, Joints};

trueaxis::chain_file!("examples/alt-azimuth/alt-azimuth.chain");

/// One second of arc, in radians.
const ARCSEC: f64 = core::f64::consts::PI / (180.0 * 3600.0);

fn main() {
    let mount = AltAzimuth::new(Errors {
        tilt_east: 12.0 * ARCSEC,
        nonperpendicularity: -20.0 * ARCSEC,
        collimation: 35.0 * ARCSEC,
        ..Errors::default()
    });
    println!("Pointing error of {} in seconds of arc, east, north and up:", AltAzimuth::NAME);
    println!("{:>8} {:>10} {:>9} {:>9} {:>9}", "azimuth", "elevation", "east", "north", "up");
    for azimuth in [0.0_f64, 90.0, 180.0, 270.0] {
        for elevation in [20.0_f64, 50.0, 80.0] {
            let joints = Joints { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() };
            let error = mount.sight_error(&joints) / ARCSEC;
            println!("{azimuth:>8} {elevation:>10} {:>9.3} {:>9.3} {:>9.3}", error.x, error.y, error.z);
        }
    }
}
