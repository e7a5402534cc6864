//! The proven bound on exact minus first order: never exceeded, and sharp where that was promised.
#![allow(clippy::unwrap_used)]

mod mobile_lidar;
