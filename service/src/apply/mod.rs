//! What `apply` writes beside the columns of its input: corrected directions and points, corrections, readings to set.

mod as_measured;
mod correct;
mod found;
mod layout;
mod pose;
mod seen;
mod solve;
mod step;
mod uncertain;

pub use as_measured::{AsMeasured, in_vectors};
pub use correct::{Beside, Correction};
pub use found::{Counted, Outside, region};
pub use layout::{Layout, Place, not_finite, not_finite_warnings, numbers, write_separated};
pub use pose::{PoseForm, nominal_pose};
pub use seen::{As, Seen};
pub(crate) use solve::with_axes;
pub use solve::{REACHED, Search, Solved, Solver};
pub(crate) use step::distance;
pub use uncertain::Uncertain;
