//! Straight-line programs from derived forms, their interpreter and one writer per language.
//!
//! The pipeline reads: chain → [`mod@build`] → [`program`] → [`Interpreter`], or a writer in [`backends`].

pub mod backends;
pub mod build;
mod builder;
pub mod interpreter;
mod order;
pub mod program;
pub mod vector;

pub use backends::{File, LANGUAGES, Language, Unit, generate};
pub use build::{build, build_all};
pub use interpreter::{Interpreter, ShapeError};
pub use program::{Counts, Form, Layout, NodeId, Op, Program, Stage};
