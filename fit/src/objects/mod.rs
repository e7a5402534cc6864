//! What rows observe without anybody knowing where it is, in a fit: estimated with the errors, and eliminated from all else.
//!
//! An object's few numbers are eliminated by a factor of their own, which leaves of every row what the object cannot
//! explain; the stations' after that, as columns that all objects share. What is left is an ordinary problem of the
//! declared errors, and steps, uncertainties and the search for missing effects see no other.
//!
//! What one row shows its kind of observation says. The elimination stands in `eliminate`, its rotation of whole columns in `reduce`,
//! in `followed` what it leaves to each row, in `spread` how surely the numbers are known, and in `stated` what a study says of
//! places, which `within` whitens columns by.

mod eliminate;
mod followed;
mod gathered;
mod lanes;
mod reduce;
mod spread;
mod stated;
mod within;

pub use eliminate::{Collected, Eliminated, Starts};
pub(crate) use followed::FollowedShare;
pub use reduce::Reduction;
pub use spread::Spread;
pub(crate) use stated::Stated;
