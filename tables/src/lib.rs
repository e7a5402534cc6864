//! Tables of numbers: the formats that they are read from and written in, and the units that columns have. And what descriptions of robots
//! say, and what the sky of a date is, and where a vehicle was at a time.

pub mod dh;
pub mod formats;
pub mod sky;
pub mod trajectory;
pub mod units;
pub mod ur;
pub mod urdf;
