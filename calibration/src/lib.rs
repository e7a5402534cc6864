//! Measured data: misread columns, search for what the declaration lacks, diagnosis, amendment.

pub mod amend;
pub mod calibrate;
pub(crate) mod contest;
pub mod design;
pub mod diagnose;
pub(crate) mod limits;
pub mod misread;
pub mod search;
pub mod thresholds;
