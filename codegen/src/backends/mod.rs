//! Writers of programs, one for each language: a file each, and a line in [`generate`].
//!
//! [`listing`] decides what gets a name; a writer says how its language writes names, statements and types.

mod listing;
mod rust;
mod rust_rows;
mod unit;

pub use unit::Unit;

pub(crate) use listing::list;
pub(crate) use rust::{Names, statements};

/// The languages that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Language {
    /// Rust that needs nothing but `core`.
    Rust,
}

/// A generated file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// The ending of its name, without dot.
    pub extension: &'static str,
    /// What is in it.
    pub text: String,
}

/// Writes a unit in a language: the file itself first, then what belongs beside it.
#[must_use]
pub fn generate(unit: &Unit<'_>, language: Language) -> Vec<File> {
    match language {
        Language::Rust => vec![File { extension: "rs", text: rust::write(unit) }],
    }
}
