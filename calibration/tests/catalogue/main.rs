//! The catalogue of effects: what follows from a chain, names of other fields, the user's own effects, amendment, and the
//! page of the book.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

mod amended;
mod families;
mod names;
mod own;
mod page;
mod pattern;
mod support;
mod thresholds;
