//! Declare an instrument as a chain of bodies with small errors, once, and get everything that follows from it.
//!
//! A turntable is declared with one error, the zero of its scale. Its data hold another one that nobody declared: the scale
//! sits 20″ off centre. The calibration finds it and writes it into the declaration.
//!
//! ```
//! # #[cfg(feature = "analysis")] {
//! use trueaxis::{Calibration, Chain, Study};
//!
//! let text = "
//!     chain Turntable {
//!         body table on ground { motion: Rz(angle); motion_error: Rz(zero); }
//!         observe mark: direction(1, 0, 0) of table;
//!     }
//! ";
//! // What follows from the declaration alone: to first order, the error of the mark is its zero across the line of sight.
//! let chain = Chain::from_text(text).unwrap();
//! let mark = chain.find_observable("mark").unwrap();
//! let error = trueaxis::derive(&chain, mark, 1).unwrap();
//! assert!(trueaxis::print::form(&error, &chain, trueaxis::print::Style::Text).contains("-zero*sin(angle)"));
//!
//! // Measured data: 72 settings, and noise of about 1″.
//! let arcsec = std::f64::consts::PI / 648_000.0;
//! let mut data = "angle [deg],x,y,z\n".to_owned();
//! for step in 0..72_u32 {
//!     let angle = f64::from(5 * step).to_radians();
//!     let noise = f64::from(step.wrapping_mul(2_654_435_761) >> 16) / 65_536.0 - 0.5;
//!     let true_angle = angle + arcsec * (30.0 + 20.0 * angle.cos() + 3.0 * noise);
//!     data += &format!("{},{},{},0\n", 5 * step, true_angle.cos(), true_angle.sin());
//! }
//!
//! let study = Study::from_text(r#"
//!     chain = "turntable.chain"
//!     data = "measured.csv"
//!     [observed]
//!     kind = "direction"
//!     x = "x"
//!     y = "y"
//!     z = "z"
//! "#).unwrap();
//! let mut open = |_: &str| Ok(data.clone().into_bytes().into());
//! let calibration = Calibration::of(text, &study, &mut open, "2026-11-22").unwrap();
//!
//! assert!(calibration.diagnosis.effects[0].names[0].contains("eccentricity"));
//! assert!(calibration.amended.unwrap().contains("cos(angle)"));
//! # }
//! ```
//!
//! - [`chain!`] and [`chain_file!`] expand a declaration to a module: its exact and first-order errors, Jacobians,
//!   closed forms. They work in `no_std` crates with the feature `libm` in place of the default ones.
//! - With the feature `analysis` (on by default): [`Chain`], the declaration, and what follows from it by algebra
//!   ([`model_core`]); printed formulas checked ([`claims`]) and proved ([`proof`]); generated evaluators in other languages ([`codegen`]); [`Study`] and [`Calibration`], measured data
//!   ([`calibration`]).
//!
//! This crate is a facade: it has no logic of its own.
#![no_std]

pub use model_macros::{chain, chain_file};
pub use nalgebra;

#[cfg(feature = "analysis")]
pub use calibration;
#[cfg(feature = "analysis")]
pub use claims;
#[cfg(feature = "analysis")]
pub use codegen;
#[cfg(feature = "analysis")]
pub use model_core;
#[cfg(feature = "analysis")]
pub use proof;

#[cfg(feature = "analysis")]
pub use calibration::calibrate::Calibration;
#[cfg(feature = "analysis")]
pub use claims::checker::Checker;
#[cfg(feature = "analysis")]
pub use model_core::{Chain, forms::derive, identify::identify, print, remainder::bound};
#[cfg(feature = "analysis")]
pub use study::Study;

/// What the expansion of [`chain!`] uses; not meant for anything else.
#[doc(hidden)]
pub mod __private {
    pub use nalgebra::{ComplexField, Matrix3, RealField, SMatrix, Vector3};
}
