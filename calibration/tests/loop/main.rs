//! The whole loop on measured data: simulated ones of the examples, and real ones where they are at hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

mod again;
mod data;
mod examples;
mod few;
mod instruments;
mod left_out;
mod mistaken;
mod remembering;
mod rounds;
mod sight;
mod simulated;
mod slides;
mod taken_up;
