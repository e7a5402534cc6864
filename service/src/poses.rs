//! The poses of a budget or a comparison as users write them: `alpha=t, beta=t/2, range=10 m`.

use std::ops::Range;

use model_core::algebra::Rational;
use model_core::budget::{JointRange, Path, PathError};
use model_core::expr::{Expr, Node};
use model_core::unit::Measures;
use model_core::{Chain, Mistake, Quantity, SymbolKind, names, syntax};
use tables::units::{Amount, Plausible};

use crate::ranges;
use crate::warn::Warn;

/// Reads a path: joints and inputs as amounts in `t`, or as quantities with a unit; warns of what is doubtful of them.
///
/// # Errors
/// What is wrong, with its place in the text.
pub fn path(chain: &Chain, text: &str, warn: Warn<'_>) -> Result<Path, Mistake<Range<usize>>> {
    let mut path = Path::default();
    let mut start = 0;
    for part in text.split(',') {
        let place = trimmed(part, start);
        start += part.len() + 1;
        let part = &text[place.clone()];
        let Some((name, amount)) = part.split_once('=') else {
            return Err(Mistake::new(place, "an assignment is missing here")
                .with_help("write joint=amount, separated by commas: \"alpha=t, beta=t/2\""));
        };
        let amount_place = trimmed(amount, place.start + name.len() + 1);
        let name_place = trimmed(name, place.start);
        let name = &text[name_place.clone()];
        let expression = amount_in_t(chain, name, text, amount_place, warn)?;
        path.assign(chain, name, &expression).map_err(|error| match &error {
            PathError::NotMovable(_) => not_movable(chain, name, name_place),
            PathError::Twice(_) => Mistake::new(name_place, error.to_string()),
            PathError::Amount(inside) => Mistake::new(inside.place().clone(), error.to_string())
                .with_help("a path is made of `t`, `pi`, numbers, sines and cosines"),
        })?;
    }
    Ok(path)
}

/// A quantity with a unit, or an amount; places are those of the whole text.
fn amount_in_t(
    chain: &Chain,
    name: &str,
    text: &str,
    place: Range<usize>,
    warn: Warn<'_>,
) -> Result<Expr<Range<usize>>, Mistake<Range<usize>>> {
    let amount = &text[place.clone()];
    let quantity = chain.find_symbol(name).map_or(Quantity::Number, |id| chain.symbol(id).quantity);
    if let (Some(symbol), Ok(written)) = (chain.find_symbol(name), Amount::parse(amount)) {
        let plausible = Plausible::readings(chain, symbol);
        let meant = |unit: &str| format!("{name}={amount} {unit}");
        let doubt = plausible.doubt(quantity, &[written], &format!("{name}={amount}"), meant);
        doubt.into_iter().for_each(|doubt| warn(doubt.to_string()));
        let value = written
            .to_si(Measures::of(chain.symbol(symbol)))
            .map_err(|error| Mistake::new(place.clone(), error.to_string()))?;
        let size = Rational::parse_decimal(&format!("{:e}", value.abs()));
        if let Ok(size) = size {
            let value = if value < 0.0 { -&size } else { size };
            return Ok(Expr { node: Node::Number(value), place });
        }
    }
    let shift = |inside: &Range<usize>| inside.start + place.start..inside.end + place.start;
    match syntax::parse_amount(amount) {
        Ok(expression) => Ok(expression.map_place(&shift)),
        Err(mistakes) => {
            let mistake = mistakes.iter().next();
            let inside = mistake.map_or(0..amount.len(), |mistake| mistake.place.bytes.clone());
            let message = mistake.map_or("this is no amount", |mistake| mistake.message.as_str());
            let help = mistake.and_then(|mistake| mistake.help.clone());
            Err(Mistake { place: shift(&inside), message: message.to_owned(), help })
        }
    }
}

fn not_movable(chain: &Chain, name: &str, place: Range<usize>) -> Mistake<Range<usize>> {
    let movable = || {
        [SymbolKind::Joint, SymbolKind::Input]
            .into_iter()
            .flat_map(|kind| chain.symbols_of(kind))
            .map(|id| chain.symbol(id).name.as_str())
    };
    let mistake = Mistake::new(place, format!("chain {} has no joint or input `{name}`", chain.name));
    match names::nearest(name, movable()) {
        Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
        None => mistake.with_help(format!("it has {}", names::listed(movable()))),
    }
}

/// The place of a text without the blanks around it.
fn trimmed(text: &str, start: usize) -> Range<usize> {
    let start = start + text.len() - text.trim_start().len();
    start..start + text.trim().len()
}

/// Ranges as the budget takes them.
#[must_use]
pub fn joint_ranges(ranges: &[ranges::Range]) -> Vec<JointRange> {
    ranges.iter().map(|range| JointRange { symbol: range.symbol, low: range.low, high: range.high }).collect()
}
