//! Measured data: observations, fit, noise, diagnosis, effects, amendment, report data.

pub mod amend;
pub mod calibrate;
pub mod columns;
pub mod effects;
pub mod fit;
pub mod formats;
pub mod noise;
pub mod observations;
pub mod poses;
pub mod report;
pub mod search;
pub mod study;
pub mod units;
