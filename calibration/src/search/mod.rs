//! The search: from a residual to the effects that the declaration lacks.
//!
//! Everything here is linear algebra on one whitened problem ([`Problem`]): the declared columns, a block of
//! columns for each candidate effect, the residual, and which rows belong together. What a candidate *is* (a
//! place in the chain, a degree of freedom, a function) lives in [`effects::families`]; the loop around the search
//! (fit, whiten, search, amend, fit again) in [`crate::calibrate`].
//!
//! The pipeline reads from one place: deal groups to folds (`folds`), merge rows where they are many (`filling` of
//! `cells`, `chunk` by chunk), project (`problem`), merge what coincides (`confounded`), test
//! (`tail`, `flips`), select (`select`, within what `guards` allow), name the competing models (`competing`), confirm on held-out folds
//! (`nested`) and elsewhere (`elsewhere`), let a memory of the noise (`memory`), fine waves (`orders`) and a library of shapes (`library`) compete, and look for structure that no candidate explains (`remains`, `scan`, `contest`).

mod apart;
pub(crate) mod aside;
pub mod cells;
mod chunk;
pub mod columns;
pub mod competing;
pub mod confounded;
pub mod contest;
pub(crate) mod context;
pub(crate) mod elsewhere;
mod error;
mod filling;
pub(crate) mod fitted;
pub mod flips;
pub mod folds;
mod guards;
pub(crate) mod library;
pub mod likelihood;
pub(crate) mod memory;
mod modest;
pub mod nested;
pub(crate) mod orders;
pub mod problem;
pub(crate) mod products;
pub mod reach;
mod readings;
pub mod remains;
pub(crate) mod round;
pub(crate) mod row_set;
pub mod scan;
pub(crate) mod search_problem;
pub mod select;
pub mod signs;
pub mod spanning;
mod stage;
mod standardised;
pub mod state;
pub(crate) mod stretches;
pub mod sweep;
pub mod tail;

pub use cells::Cells;
pub use competing::{AS_GOOD, CompetingModel, competing_models};
pub use confounded::{ConfoundedSet, SetColumns, SetId, confounded_sets};
pub use context::Request;
pub use error::SearchError;
pub use folds::Folds;
pub use nested::{HeldOut, nested};
pub use problem::{Problem, ProblemError};
pub use reach::Reach;
pub use select::{Accepted, Options, Selection, select};
pub use stage::Stage;

#[cfg(test)]
mod tests;
