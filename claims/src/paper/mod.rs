//! The equations of a paper's source as claims about a chain.
//!
//! `source` finds the equations of LaTeX or Markdown, `macros` writes the paper's own commands out, `prose` reads what letters
//! are said to be, `guess` finds what of the chain each equation states, `draft` writes that down as a claims file whose guesses
//! are marked. Nothing is decided by a guess alone: an equation that agrees with no statement about the chain is only called
//! different where most of its terms agree.

mod draft;
mod guess;
mod macros;
mod prose;
mod source;
mod written;

pub use draft::{Draft, MARK, draft};
pub use source::{Equation, Kind};
