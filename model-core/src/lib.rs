//! The declaration of an instrument as a chain of bodies, and everything that follows from it by algebra.
//!
//! The pipeline reads: text → [`syntax`] → [`validate`] → [`chain`] → [`forms`] (over [`algebra`]) → bounds and null spaces. Nothing here reads a file, prints, or knows a clock.

pub mod algebra;
pub mod amount;
pub mod budget;
pub mod caution;
pub mod chain;
pub mod escape;
pub mod exact;
pub mod expr;
pub mod forms;
pub mod identify;
pub mod mistake;
pub mod names;
pub mod print;
pub mod ramp;
pub mod remainder;
pub mod symbol;
pub mod syntax;
pub mod unit;
pub mod validate;

pub use chain::image;
pub use chain::reading as readings;
pub use chain::sight;
pub use chain::{
    Axis, Body, BodyId, Chain, Factor, Observable, ObservableId, ObservableKind, Passed, Role, TransformKind,
};
pub use mistake::{Mistake, Mistakes};
pub use symbol::{Meaning, Quantity, Subject, Symbol, SymbolId, SymbolKind};
