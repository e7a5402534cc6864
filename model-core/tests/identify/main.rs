//! What no data can tell apart.
#![allow(clippy::unwrap_used)]

mod at_values;
mod constants;
mod mobile_lidar;
mod reference;
