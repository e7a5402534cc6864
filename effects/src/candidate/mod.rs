//! What an effect is: a place in the chain, a degree of freedom there, and functions of joints and inputs, one new error
//! to each. The families themselves are in [`crate::families`].

mod dependence;
mod effect;
mod family;
mod functions;
mod id;
mod kind;
pub(crate) mod seen;
mod setting;

pub use dependence::Dependence;
pub use effect::{Bends, Effect, Freedom, Function, Place, Spot};
pub use effect::{add_error, insert};
pub use family::Family;
pub use functions::harmonic;
pub(crate) use functions::{per_turn, whole};
pub use id::EffectId;
pub use kind::Kind;
pub use setting::{JointAxis, Setting};
