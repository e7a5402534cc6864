//! `trueaxis completions`: what a shell needs to complete commands and options.

use clap::CommandFactory as _;
use clap_complete::Shell;

use super::Answer;
use crate::failure::Failure;
use crate::terminal;

/// Write completions for a shell.
///
/// Prints a script that the shell reads at its start.
///
/// Example: trueaxis completions bash > ~/.local/share/bash-completion/completions/trueaxis
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut crate::Arguments::command(), "trueaxis", &mut script);
    terminal::print(String::from_utf8_lossy(&script))?;
    Ok(Answer::Done)
}
