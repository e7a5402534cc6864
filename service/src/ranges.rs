//! Ranges of joints and inputs as users write them: `elevation=10 deg..80 deg`.

use model_core::unit::{Measures, Unit};
use model_core::{Chain, SymbolId, SymbolKind, names};
use tables::units::{Amount, Plausible};

use crate::refusal::Refusal;
use crate::warn::Warn;
use model_core::names::listed;

/// A range as typed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RangeArgument {
    name: String,
    low: String,
    high: String,
}

impl std::str::FromStr for RangeArgument {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let usage = "write joint=lo..hi, for example \"elevation=10 deg..80 deg\"";
        let (name, bounds) = text.split_once('=').ok_or(usage)?;
        let (low, high) = bounds.split_once("..").ok_or(usage)?;
        let [name, low, high] = [name, low, high].map(|part| part.trim().to_owned());
        if [&name, &low, &high].iter().any(|part| part.is_empty()) {
            return Err(usage);
        }
        Ok(Self { name, low, high })
    }
}

impl RangeArgument {
    /// The joint or input, as it was typed.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The unit of the upper bound, where one was typed.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        Amount::parse(&self.high).ok()?.unit
    }
}

impl std::fmt::Display for RangeArgument {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} from {} to {}", self.name, self.low, self.high)
    }
}

/// The range of one joint or input, in SI; `low <= high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The joint or input.
    pub symbol: SymbolId,
    /// The smallest value, SI.
    pub low: f64,
    /// The largest value, SI.
    pub high: f64,
}

/// The ranges that were typed, for the joints and inputs of a chain; warns of what is doubtful of them.
///
/// # Errors
/// A name that is no joint or input, a bound that is no quantity of its unit, bounds the wrong way round, a
/// name given twice.
pub fn of_chain(chain: &Chain, arguments: &[RangeArgument], warn: Warn<'_>) -> Result<Vec<Range>, Refusal> {
    let mut ranges: Vec<Range> = Vec::new();
    for argument in arguments {
        let range = read(chain, argument, warn)
            .map_err(|why| Refusal::Input(format!("--range {}: {why}", argument.name)))?;
        if ranges.iter().any(|earlier| earlier.symbol == range.symbol) {
            return Err(Refusal::Input(format!("`--range {}=…` is given twice", argument.name)));
        }
        ranges.push(range);
    }
    Ok(ranges)
}

/// One range of a chain's joint or input.
///
/// # Errors
/// As [`of_chain`], in words.
pub fn read(chain: &Chain, argument: &RangeArgument, warn: Warn<'_>) -> Result<Range, String> {
    let RangeArgument { name, low, high } = argument;
    let symbol = movable(chain).find(|&id| chain.symbol(id).name == *name).ok_or_else(|| {
        let declared = || movable(chain).map(|id| chain.symbol(id).name.as_str());
        let instead = names::nearest(name, declared()).map_or_else(
            || format!("it has {}", listed(declared())),
            |near| format!("did you mean `{near}`?"),
        );
        format!("chain {} has no joint or input `{name}`; {instead}", chain.name)
    })?;
    let (quantity, measures) = (chain.symbol(symbol).quantity, Measures::of(chain.symbol(symbol)));
    let wrong = |text: &str, why: &dyn std::fmt::Display| format!("`{text}`: {why}");
    let upper = Amount::parse(high).map_err(|why| wrong(high, &why))?;
    let mut lower = Amount::parse(low).map_err(|why| wrong(low, &why))?;
    // `-30..30 deg`: the unit of the upper bound holds for both.
    lower.unit = lower.unit.or(upper.unit);
    let plausible = Plausible::readings(chain, symbol);
    let written = format!("--range {name}={low}..{high}");
    let meant = |unit: &str| format!("\"{name}={low}..{high} {unit}\"");
    plausible
        .doubt(quantity, &[lower, upper], &written, meant)
        .into_iter()
        .for_each(|doubt| warn(doubt.to_string()));
    let high = upper.to_si(measures).map_err(|why| wrong(high, &why))?;
    let low = lower.to_si(measures).map_err(|why| wrong(low, &why))?;
    if low > high {
        return Err("the lower bound is above the upper one; swap them".to_owned());
    }
    Ok(Range { symbol, low, high })
}

/// Joints and inputs: what has a value at each pose.
fn movable(chain: &Chain) -> impl Iterator<Item = SymbolId> + '_ {
    chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input))
}
