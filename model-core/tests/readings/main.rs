//! What observables show beside vectors: against 120-digit arithmetic of an independent program, and what is refused.
#![allow(clippy::unwrap_used)]

mod language;
mod numbers;
mod orientation;

use model_core::Chain;

const READINGS: &str = include_str!("../../../codegen/tests/chains/readings.chain");

fn chain() -> Chain {
    Chain::from_text(READINGS).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}
