//! What a calibration means: what the data determine, what they would not show, and what structure is left.

mod basis;
pub(crate) mod detectability;
mod function;
mod precision;
pub(crate) mod remaining;

pub use precision::{Determined, NotSeparable, Precision, precision};
