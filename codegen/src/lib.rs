//! Straight-line programs from derived forms, their interpreter and one writer per language.
//!
//! The pipeline reads: chain → [`mod@build`] → [`program`] → [`Interpreter`]; or `lower` → a writer in [`backends`].

pub mod backends;
pub mod build;
mod builder;
pub mod interpreter;
mod lower;
mod order;
pub mod program;
pub mod vector;

pub use backends::{
    Calibrated, File, GenerateError, LANGUAGES, Language, Loadable, Precision, Unit, derivable, form_name,
    generate, generate_loadable, snake_case,
};
pub use build::{Covariance, MatrixProduct, Measured, build, build_all, build_uncertainty, matrix_product};
pub use interpreter::{Interpreter, ShapeError};
pub use program::{Counts, Form, Layout, NodeId, Op, Program, Stage};
