//! Claims of what observables show beside vectors.
#![allow(clippy::unwrap_used)]

mod orientation;
mod slips;

use model_core::Chain;

const READINGS: &str = include_str!("../../../codegen/tests/chains/readings.chain");

fn chain() -> Chain {
    Chain::from_text(READINGS).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}
