//! The proven bound on exact minus first order: never exceeded, and sharp where that was promised.
#![allow(clippy::unwrap_used)]

mod angles;
mod large;
mod limits;
mod mobile_lidar;
mod random_chains;
