//! The instruments that a class can get: one file each, one line each in the table.

mod gimbal;
mod telescope;
mod theodolite;

use crate::instrument::Instrument;

/// Every instrument.
pub const INSTRUMENTS: [Instrument; 3] = [telescope::TELESCOPE, theodolite::THEODOLITE, gimbal::GIMBAL];
