//! What follows from a declaration alone: headings of closed forms, what no data can tell apart, bounds, code.

mod bound;
mod derive;
mod generate;
mod identify;

pub use bound::{bound_as_json, bounds};
pub use derive::{closed_forms, title_of, unique_roots};
pub use generate::{files, files_of_instrument, forms_of, loadable};
pub use identify::{Identified, identified};
