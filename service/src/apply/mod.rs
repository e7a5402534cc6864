//! What `apply` writes beside the columns of its input: corrected directions and points, corrections, readings to set.

mod found;
mod seen;
mod solve;

pub use found::{Counted, Outside};
pub use seen::{As, Seen};
pub use solve::Solver;
