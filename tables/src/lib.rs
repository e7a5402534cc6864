//! Tables of numbers: the formats that they are read from and written in, and the units that columns have. And what a robot's description
//! says.

pub mod formats;
pub mod units;
pub mod urdf;
