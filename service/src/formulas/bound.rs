//! Proven bounds on what the first-order form leaves out, with how far a search came.

use model_core::remainder::{self, Bound, Domain, DomainError, Found, PairShare, Parts};
use model_core::{Chain, SymbolKind};
use serde_json::json;

use crate::ranges::Range;
use crate::refusal::Refusal;
use crate::source::observables;
use crate::warn::Warn;

/// Starts of the search for a large difference: more find a little more, and cost as much more.
const STARTS: u32 = 24;

/// The bounds of the named observables, or of all, each with the largest difference that a search found. Warns of
/// observables without one.
///
/// # Errors
/// A name that the chain does not declare, or no bound within these sizes and ranges.
pub fn bounds(
    chain: &Chain,
    sizes: &[f64],
    ranges: &[Range],
    names: &[String],
    seed: u64,
    warn: Warn<'_>,
) -> Result<Vec<(Bound, Found)>, Refusal> {
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
                warn(format!("{name} is left out: {}", failure(error)));
            }
            Err(error) => return Err(failure(error)),
        }
    }
    Ok(answers)
}

/// A range that is missing is given on the command line.
fn failure(error: DomainError) -> Refusal {
    Refusal::Input(match error {
        DomainError::RangeNeeded { name } => {
            format!("there is no bound unless `{name}` has a range: say --range \"{name}=lo..hi\"")
        }
        other => other.to_string(),
    })
}

/// A bound for programs.
#[must_use]
pub fn bound_as_json(chain: &Chain, bound: &Bound, found: &Found) -> serde_json::Value {
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
