//! What `apply` writes beside the columns of its input: corrected directions and points, corrections, readings to set.

mod as_measured;
mod found;
mod seen;
mod solve;
mod uncertain;

pub use as_measured::{AsMeasured, in_vectors};
pub use found::{Counted, Outside, region};
pub use seen::{As, Seen};
pub use solve::Solver;
pub(crate) use solve::distance;
pub use uncertain::Uncertain;
