//! Tables of numbers: the formats that they are read from and written in, and the units that columns have.

pub mod formats;
pub mod units;
