//! `trueaxis verify`: whether a calibration is still valid.

use std::path::PathBuf;

use service::verify::{self, Asked, FALSE_ALARM};

use super::{Answer, TextOrJson};
use crate::failure::Failure;
use crate::{source, table_files, terminal};

/// Check with a few new rows whether a calibration is still valid.
///
/// Ten rows suffice to ask. The table has the headings of the study that was calibrated. The answer is STILL VALID, RECALIBRATE with
/// what alone would explain the rows, or CANNOT SAY with the rows to add.
///
/// Exit code 1 for RECALIBRATE and for CANNOT SAY.
///
/// Example: trueaxis verify result/instrument.toml --data ten.csv --goal "5 arcsec"
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The instrument file that `calibrate` wrote
    instrument: PathBuf,
    /// New measured rows: a .csv or .parquet file
    #[arg(long, value_name = "FEW")]
    data: PathBuf,
    /// The change of what is observed that matters, RMS over the measured region, as "5 arcsec"; default: the noise of one observation
    #[arg(long, value_name = "SIZE")]
    goal: Option<String>,
    /// The chance of RECALIBRATE for an instrument that did not change
    #[arg(long, value_name = "CHANCE", default_value_t = FALSE_ALARM)]
    false_alarm: f64,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let instrument = source::instrument(&arguments.instrument)?;
    let asked = Asked { goal: arguments.goal.as_deref(), false_alarm: arguments.false_alarm };
    let file = arguments.data.display().to_string();
    // What is not the data is the trajectory that joins them, as the study names it.
    let path = |name: &str| {
        if name == file { arguments.data.clone() } else { table_files::beside(&arguments.data, name) }
    };
    let mut open =
        |name: &str, options: &tables::formats::Options| table_files::open_table(&path(name), options);
    table_files::known_format(&arguments.data)?;
    let verified = verify::verify(&instrument, &file, &mut open, &asked, &terminal::warn)?;
    match arguments.format {
        TextOrJson::Text => terminal::print_text(verify::as_text(&verified))?,
        TextOrJson::Json => terminal::print_json(&verify::as_json(&verified))?,
    }
    Ok(if verified.is_valid() { Answer::Done } else { Answer::No })
}
