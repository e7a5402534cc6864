//! The registry of commands: one file each, one line each in the table below.

mod apply;
pub mod bound;
pub mod budget;
pub mod calibrate;
pub mod check;
mod class;
mod compare;
mod completions;
pub mod derive;
mod eval;
mod export;
pub mod generate;
pub mod identify;
mod init;
mod manual;
mod plan;
pub mod simulate;
mod verify;

use crate::failure::Failure;

/// What a command that ran through has to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Done; for a question: yes.
    Done,
    /// The question was answered, and the answer is no.
    No,
}

/// How a command prints its answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum TextOrJson {
    /// For reading
    Text,
    /// For programs
    Json,
}

macro_rules! commands {
    ($($(#[$attribute:meta])* $name:ident => $module:ident,)*) => {
        /// Every command with its arguments.
        #[derive(Debug, clap::Subcommand)]
        pub enum Command {
            $($(#[$attribute])* $name($module::Arguments),)*
        }

        impl Command {
            /// Runs the command.
            ///
            /// # Errors
            /// What the user must mend, as it is to be shown to him.
            pub fn run(self) -> Result<Answer, Failure> {
                match self {
                    $(Self::$name(arguments) => $module::run(&arguments),)*
                }
            }
        }
    };
}

commands! {
    Init => init,
    Derive => derive,
    Identify => identify,
    Bound => bound,
    Check => check,
    Budget => budget,
    Generate => generate,
    Simulate => simulate,
    Eval => eval,
    Calibrate => calibrate,
    Apply => apply,
    Plan => plan,
    Compare => compare,
    Verify => verify,
    Export => export,
    Class => class,
    Completions => completions,
    Manual => manual,
}
