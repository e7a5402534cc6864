//! One contest that decides which explanation of a residual is told.
//!
//! A residual of an instrument may come from effects that its declaration lacks, from set-ups, from memory of the
//! noise, from uneven or heavy-tailed noise, or from none of these. All of them compete by one marginal likelihood:
//!
//! ```text
//! W y = J b + Σ_f Z_f u_f + e      b flat, u_f ~ N(0, v_f s² S_f), e ~ N(0, s² C)
//! ```
//!
//! Rows enter once, into the Gram matrix of [y J Z]; everything after that is small dense algebra.

mod algebra;
mod average;
mod bench;
mod contenders;
mod contest;
mod design;
mod driver;
mod error;
pub mod families;
mod function;
mod gram;
mod greedy;
mod likelihood;
mod linearise;
mod margins;
mod noise;
mod outcome;
pub mod outside;
mod places;
mod point;
pub mod policy;
mod predict;
pub mod problem;
mod record;
#[cfg(test)]
mod reference;
mod run;
mod settle;
mod setups;
mod shape;
mod small;
mod subset;
mod unpack;
mod weigh;

pub use contenders::Contenders;
pub use contest::{contest, contest_among};
pub use driver::Driver;
pub use error::Error;
pub use function::{Function, Span, Wave};
pub use linearise::{Amount, Linearisation, Linearise};
pub use margins::Finding;
pub use noise::Memory;
pub use outcome::{Competitor, Estimate, Explanation, NewRows, Outcome, Prediction};
pub use places::{Distinct, PlacedFrame, Places};
pub use policy::Policy;
pub use problem::Problem;
pub use record::{Reason, Stage, Step};
pub use shape::{Kind, Shape};
