//! The program that `batch_speed` compiles and runs: mobile lidar, direction and point, all 30 errors, fresh random joints,
//! structure of arrays, from memory. It prints nanoseconds a row, the least of many rounds in which all candidates take
//! turns, and ratios.

#![allow(clippy::print_stdout, reason = "a program that prints a table")]

#[cfg(target_arch = "x86_64")]
#[macro_use]
mod thirty;

#[cfg(target_arch = "x86_64")]
mod c_code;
#[cfg(target_arch = "x86_64")]
mod candidates;
#[cfg(target_arch = "x86_64")]
mod check;
#[cfg(target_arch = "x86_64")]
mod floors;
#[cfg(target_arch = "x86_64")]
mod rounds;
#[cfg(target_arch = "x86_64")]
mod threads;

/// The generated evaluators on the portable path.
#[allow(dead_code, unused_imports)]
pub mod portable {
    include!(concat!(env!("OUT_DIR"), "/lidar_portable.rs"));
}

/// The generated evaluators on the path x86-64-v3.
#[allow(dead_code, unused_imports)]
pub mod v3 {
    include!(concat!(env!("OUT_DIR"), "/lidar_v3.rs"));
}

/// The generated evaluators on the path x86-64-v4.
#[allow(dead_code, unused_imports)]
pub mod v4 {
    include!(concat!(env!("OUT_DIR"), "/lidar_v4.rs"));
}

use v4 as lidar;

#[cfg(target_arch = "x86_64")]
fn main() {
    rounds::run();
}

#[cfg(not(target_arch = "x86_64"))]
fn main() {
    println!("The floors are written in x86-64 instructions.");
}
