//! `trueaxis manual`: the help of every command as manual pages.

use std::io;
use std::path::PathBuf;

use clap::CommandFactory as _;
use clap_mangen::Man;

use super::Answer;
use crate::failure::Failure;
use crate::output::Folder;

/// Write the manual pages.
///
/// Writes trueaxis.1 and a page for each command, as `man` reads them.
///
/// Example: trueaxis manual --out ~/.local/share/man/man1
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for the pages
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let whole = crate::Arguments::command().disable_help_subcommand(true);
    let mut pages = Folder::new(&arguments.out)?;
    let mut page = |name: &str, command: clap::Command| {
        let file = format!("{name}.1");
        let path = arguments.out.join(&file);
        let fail = |error: io::Error| Failure::write(&path, &error);
        pages.write(&file, |mut out| Man::new(command).render(&mut out).map_err(fail))
    };
    page("trueaxis", whole.clone())?;
    let mut left: Vec<(String, &clap::Command)> =
        whole.get_subcommands().map(|command| ("trueaxis".to_owned(), command)).collect();
    while let Some((above, command)) = left.pop() {
        let typed = format!("{above} {}", command.get_name());
        left.extend(command.get_subcommands().map(|own| (typed.clone(), own)));
        let name = typed.replace(' ', "-");
        page(&name, command.clone().display_name(name.clone()).bin_name(typed))?;
    }
    pages.finish()?;
    Ok(Answer::Done)
}
