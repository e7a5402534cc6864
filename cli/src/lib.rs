//! The `trueaxis` command as a library: arguments in, exit code out. What a command does stands in `commands`.

mod beginning;
mod budget;
mod calibrating;
mod certificates;
mod claims_file;
#[cfg(feature = "point-clouds")]
mod cloud;
mod commands;
mod date;
mod draw;
mod expected;
mod failure;
mod instruments;
pub mod library;
#[cfg(target_os = "linux")]
mod limited;
mod many;
mod output;
mod over_table;
mod paper;
mod posing;
mod report_files;
mod set_up;
mod sizes;
mod solving;
mod source;
mod streaming;
mod table_files;
mod terminal;
mod told;
mod trajectory;
mod waiting;
mod whole;

use std::process::ExitCode;

use clap::Parser as _;
use model_core::escape;

/// Declare an instrument as a chain of bodies with small errors; get everything that follows from it.
///
/// Exit code: 0 done (for `check`: every claim holds); 1 the answer is no; 2 bad input or usage.
#[derive(Debug, clap::Parser)]
#[command(name = "trueaxis", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: commands::Command,
    /// Say nothing of what is being done; warnings and errors are told all the same
    #[arg(long, short, global = true)]
    quiet: bool,
}

/// A spoiled Parquet or LAZ file makes the crate that reads it panic; that becomes an error like any other, and is told as one.
#[cfg(any(feature = "parquet", feature = "point-clouds"))]
fn tell_panics_of_readers_as_errors() {
    let is_of_a_reader = || {
        let mut is = false;
        #[cfg(feature = "parquet")]
        {
            is |= tables::formats::parquet::is_reading();
        }
        #[cfg(feature = "point-clouds")]
        {
            is |= cloud::is_decoding();
        }
        is
    };
    let told = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !is_of_a_reader() {
            told(panic);
        }
    }));
}

/// Says what is wrong with the arguments, or helps, and ends. An argument may hold anything, as the name of a file does.
fn refused(error: &clap::Error) -> ! {
    let seen = || std::env::args_os().map(|word| escape::line(&word.to_string_lossy()).into_owned());
    match Arguments::try_parse_from(seen()) {
        Err(error) => error.exit(),
        // Escaped, they would do; as they are, they do not.
        Ok(_) => {
            terminal::report_failure(&failure::Failure::Input(error.kind().to_string()));
            std::process::exit(2)
        }
    }
}

/// Runs the command that the process was started with.
#[must_use]
pub fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    if let Some(code) = limited::run_apart() {
        return code;
    }
    #[cfg(any(feature = "parquet", feature = "point-clouds"))]
    tell_panics_of_readers_as_errors();
    output::clean_up_when_interrupted();
    let arguments = Arguments::try_parse().unwrap_or_else(|error| refused(&error));
    if arguments.quiet {
        terminal::be_quiet();
    }
    match arguments.command.run() {
        Ok(commands::Answer::Done) => ExitCode::SUCCESS,
        Ok(commands::Answer::No) => ExitCode::from(1),
        Err(failure::Failure::ReaderGone) => ExitCode::SUCCESS,
        Err(failure) => {
            terminal::report_failure(&failure);
            ExitCode::from(2)
        }
    }
}
