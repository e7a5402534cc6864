//! Forms of the error against independent programs and against each other.
//!
//! The reference numbers and the scripts that made them lie in `tests/reference`.
#![allow(clippy::unwrap_used)]

mod columns;
mod numbers;
mod printed;
mod steps;

use model_core::Chain;

const MOBILE_LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
const RAMPS: &str = include_str!("../reference/ramps.chain");
const GIMBAL: &str = include_str!("../reference/gimbal.chain");

/// The chain that a reference file calls by this name.
fn chain(name: &str) -> Chain {
    let text = match name {
        "mobile-lidar" => MOBILE_LIDAR,
        "gimbal" => GIMBAL,
        "ramps" => RAMPS,
        other => panic!("no chain {other}"),
    };
    Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(name, text)))
}
