//! Lowering: from a program to a small tree of statements and loops (`tree`), once for every language.
//!
//! `pose` is what is done for one pose, in two stages; `block` what is done for a block of rows.

mod block;
mod pose;
pub(crate) mod tree;

pub(crate) use block::{Block, Fixed, block};
pub(crate) use pose::{Pose, pose};
