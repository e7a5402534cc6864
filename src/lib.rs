//! Declare an instrument as a chain of bodies with small errors, once, and get everything that follows from it.
//!
//! - [`chain!`] and [`chain_file!`] expand a declaration to a module: its exact and first-order errors, Jacobians,
//!   closed forms. They work in `no_std` crates with the feature `libm` in place of the default ones.
//! - With the feature `analysis` (on by default): `model_core`, the declaration and what follows from it by algebra;
//!   `codegen`, generated evaluators in other languages; `calibration`, measured data.
//!
//! This crate is a facade: it has no logic of its own.
#![no_std]

pub use model_macros::{chain, chain_file};
pub use nalgebra;

#[cfg(feature = "analysis")]
pub use calibration;
#[cfg(feature = "analysis")]
pub use codegen;
#[cfg(feature = "analysis")]
pub use model_core;

/// What the expansion of [`chain!`] uses; not meant for anything else.
#[doc(hidden)]
pub mod __private {
    pub use nalgebra::{ComplexField, Matrix3, SMatrix, Vector3};
}
