//! Firmware of a scanner keeps a table of pointing corrections, one for each position of the inner frame, and updates it
//! when the service technician loads new errors: without an allocator, without `std`, in a time and on a stack that
//! are known beforehand.
//!
//! The evaluators are generated from the declaration by `build.rs`.
#![no_std]

/// Evaluators of the scanner, generated from `mobile-lidar.chain`.
pub mod scanner {
    include!(concat!(env!("OUT_DIR"), "/scanner.rs"));
}

use scanner::{Errors, FirstOrderError, Joints};

/// What to take away from the direction that the encoders tell, at each of `POSITIONS` positions of the inner frame.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionTable<const POSITIONS: usize> {
    corrections: [[f64; 3]; POSITIONS],
}

impl<const POSITIONS: usize> CorrectionTable<POSITIONS> {
    /// Corrects nothing, until the first update.
    #[must_use]
    pub const fn new() -> Self {
        Self { corrections: [[0.0; 3]; POSITIONS] }
    }

    /// Computes the table anew for an instrument with these errors, its outer frame at `alpha_rad` and its middle frame at
    /// `beta_rad`. The same instructions run whatever the values are.
    pub fn update(&mut self, errors: &Errors, alpha_rad: f64, beta_rad: f64) {
        let prepared = FirstOrderError::prepare(errors);
        for (position, correction) in self.corrections.iter_mut().enumerate() {
            let joints = Joints { alpha: alpha_rad, beta: beta_rad, gamma: Self::gamma_rad(position) };
            *correction = prepared.eval_without_branch(&joints).pointing.map(|error| -error);
        }
    }

    /// The correction at a position; positions go round.
    #[must_use]
    pub fn at(&self, position: usize) -> [f64; 3] {
        self.corrections.get(position % POSITIONS.max(1)).copied().unwrap_or_default()
    }

    /// Where the inner frame is at a position.
    #[must_use]
    pub fn gamma_rad(position: usize) -> f64 {
        core::f64::consts::TAU * position as f64 / POSITIONS as f64
    }
}

impl<const POSITIONS: usize> Default for CorrectionTable<POSITIONS> {
    fn default() -> Self {
        Self::new()
    }
}
