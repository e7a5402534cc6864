//! The families of effects that a declaration may lack, one file each, one line in [`FAMILIES`].
//!
//! A family says which functions make physical sense where. Columns for a search come from the algebra
//! (`search::columns`), never from formulas typed in.

mod assembly;
mod backlash;
mod compliance;
mod coupling;
mod drift;
mod driven;
pub(crate) mod encoder;
mod flop;
pub(crate) mod gravity;
mod high_harmonic;
mod index_step;
pub(crate) mod joint_motion;
mod latency;
pub(crate) mod linear_scale;
mod mirror;
mod own;
mod parallax;
mod play;
mod products;
mod range;
mod refraction;
mod rotator;
mod session;
mod shape;
mod side_quantity;
pub(crate) mod slide;
mod smooth;
mod sub_division;
mod tensor;
mod thermal;
mod wind_up;

use crate::candidate::Family;

pub use assembly::assembly_name;
pub use own::{OwnError, own};
pub use smooth::{SmoothPlace, smooth};
pub use tensor::tensor;

/// The family of functions that a calibration took up.
pub const SHAPE: &str = shape::FAMILY.name;

/// The family of harmonics that a calibration took up.
pub const HIGH_HARMONIC: &str = high_harmonic::FAMILY.name;

/// The family of what is wrong with a measured range.
pub const RANGE: &str = range::FAMILY.name;

/// Every family, in the order in which members of one confounded set lend it their name.
pub const FAMILIES: &[Family] = &[
    own::FAMILY,
    shape::FAMILY,
    high_harmonic::FAMILY,
    assembly::FAMILY,
    encoder::FAMILY,
    linear_scale::FAMILY,
    slide::FAMILY,
    sub_division::FAMILY,
    index_step::FAMILY,
    gravity::FAMILY,
    wind_up::FAMILY,
    compliance::FAMILY,
    joint_motion::FAMILY,
    backlash::FAMILY,
    play::FAMILY,
    latency::FAMILY,
    thermal::FAMILY,
    drift::FAMILY,
    session::FAMILY,
    flop::FAMILY,
    rotator::FAMILY,
    side_quantity::FAMILY,
    refraction::FAMILY,
    mirror::FAMILY,
    range::FAMILY,
    parallax::FAMILY,
    coupling::FAMILY,
    products::FAMILY,
];
