//! What tests share: tools that they need, measured data, random numbers, rotations, simulated instruments, hostile strings.
//!
//! It depends on nothing of the workspace, so that no simulator shares code with what it tests.
#![allow(clippy::expect_used, reason = "a test may fail loudly")]

mod data;
mod hostile;
pub mod mount;
mod random;
mod rotations;
mod scanner;
mod skipped;
mod tools;

pub use data::{measured, root};
pub use hostile::{acts_on_a_screen, hostile};
pub use random::{Random, Xorshift};
pub use rotations::{rotation, turned};
pub use scanner::Stand;
pub use skipped::last_line;
pub use tools::{BASH, BROWSER, COQ, CXX, JAX, NODE, NUMPY, OCTAVE, PYTHON, SYMPY, Tool, tool};
