//! Measured data: observations, fit, noise, diagnosis, effects, amendment, report data.

pub mod amend;
pub mod calibrate;
pub mod candidate;
pub mod catalogue;
pub mod data;
pub mod design;
pub mod diagnose;
pub mod effects;
pub mod fit;
pub mod formats;
pub mod objects;
mod parallel;
pub mod report;
pub mod search;
pub mod study;
pub mod tolerance;
