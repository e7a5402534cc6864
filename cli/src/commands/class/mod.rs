//! `trueaxis class`: data sets with a secret for students, and points for what they hand in.

mod grade;
mod new;

use super::Answer;
use crate::failure::Failure;

/// Make data sets with a secret for a class, and grade the answers.
///
/// `class new` writes a folder for each student and a key for the teacher. `class grade` reads what the students hand in.
///
/// Example: trueaxis class new --students names.csv --seed "a long phrase" --level 1 --out class
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, clap::Subcommand)]
enum What {
    New(new::Arguments),
    Grade(grade::Arguments),
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    match &arguments.what {
        What::New(arguments) => new::run(arguments),
        What::Grade(arguments) => grade::run(arguments),
    }
}
