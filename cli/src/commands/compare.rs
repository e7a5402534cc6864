//! `trueaxis compare`: what changed between calibrations.

use std::path::{Path, PathBuf};

use service::compare::{self, File};

use super::{Answer, TextOrJson};
use crate::failure::Failure;
use crate::{date, source, terminal};

/// Compare calibrations of one instrument: what changed, by how much, with ±.
///
/// Says which errors and effects changed by more than their uncertainties, what only some files have, and what the change does to
/// what is observed over the region that all files measured. Of more than two files it gives the drift of each value per month.
///
/// Exit code 1 where something changed significantly.
///
/// Example: trueaxis compare january/instrument.toml february/instrument.toml
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Instrument files, the oldest first
    #[arg(required = true, num_args = 2.., value_name = "INSTRUMENT.toml")]
    files: Vec<PathBuf>,
    /// The days of the data, one for each file, as 2026-01-31,2026-02-28; default: the days of the calibrations
    #[arg(long, value_name = "DATE,…", value_delimiter = ',', value_parser = date::day)]
    dates: Vec<String>,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    if !arguments.dates.is_empty() && arguments.dates.len() != arguments.files.len() {
        return Err(Failure::Input(format!(
            "{} dates for {} files: give one for each file, in their order",
            arguments.dates.len(),
            arguments.files.len()
        )));
    }
    let instruments: Vec<_> =
        arguments.files.iter().map(|path| source::instrument(path)).collect::<Result<_, Failure>>()?;
    let named = arguments.files.iter().map(|path: &PathBuf| Path::display(path).to_string());
    let files = named.zip(&instruments).enumerate().map(|(at, (name, instrument))| {
        let date = arguments.dates.get(at).or(instrument.made.as_ref()).cloned();
        File { name, instrument, date }
    });
    let comparison = compare::compare(&files.collect::<Vec<_>>())?;
    match arguments.format {
        TextOrJson::Text => terminal::print_text(compare::as_text(&comparison))?,
        TextOrJson::Json => terminal::print_json(&compare::as_json(&comparison))?,
    }
    Ok(if comparison.is_changed() { Answer::No } else { Answer::Done })
}
