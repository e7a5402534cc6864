//! `trueaxis bound`: a proven bound on what the first-order form leaves out.

use std::path::PathBuf;

use model_core::remainder::{self, Bound, Domain, DomainError, Found, PairShare, Parts};
use model_core::{Chain, SymbolKind};
use serde_json::json;
use service::source::observables;

use super::{Answer, TextOrJson};
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::ranges::{Range, RangeArgument};
use crate::sizes::SizesArgument;
use crate::source::Declared;
use crate::terminal;

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
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Starts of the search for a large difference: more find a little more, and cost as much more.
const STARTS: u32 = 24;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let declared = Declared::read(&arguments.chain)?;
    let sizes = declared.sizes(&arguments.sizes)?;
    let ranges = declared.ranges(&arguments.range)?;
    let chain = declared.chain;
    let waiting = expected::announce(&chain, Work::Bound);
    let answers = bounds(&chain, &sizes, &ranges, &arguments.observable, arguments.seed)?;
    drop(waiting);
    match arguments.format {
        TextOrJson::Text => {
            let texts: Vec<String> =
                answers.iter().map(|(bound, found)| remainder::text(bound, Some(found), &chain)).collect();
            terminal::print_text(texts.join("\n"))?;
        }
        TextOrJson::Json => {
            let bounds: Vec<_> = answers.iter().map(|(bound, found)| as_json(&chain, bound, found)).collect();
            terminal::print_json(&json!({ "bounds": bounds }))?;
        }
    }
    Ok(Answer::Done)
}

/// The bounds of the named observables, or of all, each with the largest difference that a search found.
///
/// # Errors
/// A name that the chain does not declare, or no bound within these sizes and ranges.
pub fn bounds(
    chain: &Chain,
    sizes: &[f64],
    ranges: &[Range],
    names: &[String],
    seed: u64,
) -> Result<Vec<(Bound, Found)>, Failure> {
    let mut domain = Domain::new(chain);
    for error in chain.symbols_of(SymbolKind::Error) {
        domain.set_size(chain, error, sizes[error.index()]).map_err(failure)?;
    }
    for range in ranges {
        domain.set_range(chain, range.symbol, range.low, range.high).map_err(failure)?;
    }
    let mut answers = Vec::new();
    for observable in observables(chain, names)? {
        let answer = remainder::bound(chain, observable, &domain)
            .and_then(|bound| Ok((bound, remainder::search(chain, observable, &domain, STARTS, seed)?)));
        match answer {
            Ok(answer) => answers.push(answer),
            // Nobody asked for this observable in particular; the others still have an answer.
            Err(
                error @ (DomainError::RangeNeeded { .. }
                | DomainError::NoProof { .. }
                | DomainError::Lost { .. }
                | DomainError::Turned { .. }
                | DomainError::Units { .. }),
            ) if names.is_empty() => {
                let name = &chain.observable(observable).name;
                terminal::warn(format_args!("{name} is left out: {}", failure(error)));
            }
            Err(error) => return Err(failure(error)),
        }
    }
    Ok(answers)
}

/// A range that is missing is given on the command line.
fn failure(error: DomainError) -> Failure {
    Failure::Input(match error {
        DomainError::RangeNeeded { name } => {
            format!("there is no bound unless `{name}` has a range: say --range \"{name}=lo..hi\"")
        }
        other => other.to_string(),
    })
}

/// A bound for programs.
pub fn as_json(chain: &Chain, bound: &Bound, found: &Found) -> serde_json::Value {
    let observable = chain.observable(bound.observable);
    // What is proven is never exceeded but by rounding, which is not found.
    let found = (found.value <= bound.value && bound.value > 0.0).then_some(found.value);
    let mut value = json!({
        "observable": observable.name,
        "unit": remainder::unit(bound, chain),
        "bound": bound.value,
        "largest_found": found,
        "ratio": found.map(|found| bound.value / found),
    });
    let name = |id| &chain.symbol(id).name;
    match &bound.parts {
        Parts::Vector { second_order, tail, is_sum, shares } => {
            let share =
                |pair: &PairShare| json!({"errors": [name(pair.one), name(pair.other)], "share": pair.share});
            value["second_order"] = (*second_order).into();
            value["tail"] = (*tail).into();
            value["is_sum_of_degrees"] = (*is_sum).into();
            value["shares"] = shares.iter().map(share).collect();
        }
        Parts::Readings(readings) => {
            let named = observable
                .labels()
                .zip(readings)
                .map(|(name, bound)| json!({"reading": name, "bound": bound}));
            value["readings"] = named.collect();
        }
    }
    value
}
