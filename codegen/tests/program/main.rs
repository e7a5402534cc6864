//! Programs and their interpreter: against the numeric reference of `model-core`, against the derived closed form,
//! against differences, and how much they cost.
#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod batches;
mod counts;
mod images;
mod jacobians;
mod order;
mod orientation;
mod random_chains;
mod reference;
mod texts;
mod values;
