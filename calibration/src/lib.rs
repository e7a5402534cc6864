//! Measured data: misread columns, search for what the declaration lacks, diagnosis, amendment, report data.

pub mod amend;
pub mod calibrate;
pub mod design;
pub mod diagnose;
pub mod misread;
pub mod report;
pub mod search;
pub mod tolerance;
