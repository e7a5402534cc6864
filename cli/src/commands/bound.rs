//! `trueaxis bound`: a proven bound on what the first-order form leaves out.

use std::path::PathBuf;

use model_core::remainder;
use serde_json::json;
use service::formulas::{bound_as_json, bounds};
use service::ranges::RangeArgument;

use super::{Answer, TextOrJson};
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::sizes::SizesArgument;
use crate::source::Declared;
use crate::{terminal, whole};

/// Bound what the first-order form leaves out.
///
/// Gives a number that the difference between the exact error and its first-order form never exceeds while every
/// error stays within its largest size, at all angles of the joints or in the ranges given. The bound is proven and
/// rounded up. Beside it stands the largest difference that a search found: the truth lies between the two.
///
/// Example: trueaxis bound examples/mobile-lidar/mobile-lidar.chain --sizes examples/mobile-lidar/box.toml
/// --observable pointing
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration, or an instrument file
    chain: PathBuf,
    #[command(flatten)]
    sizes: SizesArgument,
    /// Only this observable (may be given several times); default: every one
    #[arg(long)]
    observable: Vec<String>,
    /// Range of a joint or input: "elevation=10 deg..80 deg" (may be given several times)
    #[arg(long, value_name = "joint=lo..hi")]
    range: Vec<RangeArgument>,
    /// Seed of the search for a large difference
    #[arg(long, default_value_t = 1, value_parser = whole::seed, allow_negative_numbers = true)]
    seed: u64,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let declared = Declared::read(&arguments.chain)?;
    let sizes = declared.sizes(&arguments.sizes)?;
    let ranges = declared.ranges(&arguments.range)?;
    let chain = declared.chain;
    let waiting = expected::announce(&chain, Work::Bound);
    let answers = bounds(&chain, &sizes, &ranges, &arguments.observable, arguments.seed, &terminal::warn)?;
    drop(waiting);
    match arguments.format {
        TextOrJson::Text => {
            let texts: Vec<String> =
                answers.iter().map(|(bound, found)| remainder::text(bound, Some(found), &chain)).collect();
            terminal::print_text(texts.join("\n"))?;
        }
        TextOrJson::Json => {
            let bounds: Vec<_> =
                answers.iter().map(|(bound, found)| bound_as_json(&chain, bound, found)).collect();
            terminal::print_json(&json!({ "bounds": bounds }))?;
        }
    }
    Ok(Answer::Done)
}
