//! Calibrating with objects and places that nobody knows: where a fit of them starts (`start`), whether anything holds its scale
//! (`scale`), what is doubtful of its rows (`rows`, `remark`), where all came out (`placed`), and what a set-up can see of the errors before anybody measures better
//! than roughly (`identify`).
//!
//! What is unknown stands in [`observe::unknowns`]; how it is estimated and eliminated in [`fit`].

mod identify;
mod placed;
mod remark;
mod rows;
mod scale;
mod solved;
mod start;
mod upright;

pub use identify::{Remedy, SetUp, Visible, identify};
pub use placed::{Origin, Placed, PlacedObject, PlacedStation, placed};
pub use remark::Remark;
pub use rows::{Row, rows, tells};
pub use scale::{check_scale, check_scale_of_ranges};
pub use solved::is_in_a_line;
pub use start::{StartError, check_named, place};
