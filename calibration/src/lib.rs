//! Measured data: observations, fit, noise, diagnosis, effects, amendment, report data.

pub mod fit;
pub mod formats;
pub mod noise;
pub mod observations;
pub mod search;
pub mod study;
pub mod units;
