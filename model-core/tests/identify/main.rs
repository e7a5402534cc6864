//! What no data can tell apart.
#![allow(clippy::unwrap_used)]

mod mobile_lidar;
mod reference;
