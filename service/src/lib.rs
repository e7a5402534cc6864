//! What one does with an instrument, calibrated or to be: calibrate it from texts, apply what was found to readings, plan what its
//! tolerances come to.
//!
//! Texts and tables come in memory, and strings and columns go out: who has files, a clock and a terminal stands above.

pub mod apply;
pub mod beginning;
pub mod budget;
pub mod calibrating;
pub mod claims_file;
pub mod compare;
pub mod errors_file;
pub mod evaluation;
pub mod export;
pub mod formulas;
pub mod instrument;
pub mod over_memory;
pub mod plan;
pub mod poses;
pub mod ranges;
pub mod readings;
mod refusal;
pub mod report_files;
pub mod sensitivity;
pub mod source;
pub mod tolerance;
pub mod trajectory;
pub mod verify;
mod warn;

pub use calibrating::{Calibrated, Made, Measured, Studied};
pub use instrument::Instrument;
pub use refusal::Refusal;
pub use source::Source;
pub use warn::Warn;
