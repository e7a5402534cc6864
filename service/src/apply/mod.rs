//! What `apply` writes beside the columns of its input: corrected directions and points, corrections, readings to set.

mod as_measured;
mod correct;
mod found;
mod layout;
mod seen;
mod solve;
mod uncertain;

pub use as_measured::{AsMeasured, in_vectors};
pub use correct::{Beside, Correction};
pub use found::{Counted, Outside};
pub use layout::{Layout, Place, not_finite, not_finite_warnings, numbers, write_separated};
pub use seen::{As, Seen};
pub use solve::Solver;
pub(crate) use solve::distance;
pub use uncertain::Uncertain;
