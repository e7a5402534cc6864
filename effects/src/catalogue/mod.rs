//! The catalogue for one chain: the members of every family, what a study chooses of them, and what other fields call
//! them.

mod chosen;
mod members;
mod names;
mod terms;

pub use chosen::chosen;
pub use members::catalogue;
pub use names::{Kind as MountKind, Name, PointingTerm, PointingTerms, Published, known_names, published};
pub use terms::{NoTerm, Term, terms};
