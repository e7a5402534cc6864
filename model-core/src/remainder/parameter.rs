//! What a set of poses is spanned by, and a pose of it in words.

use crate::chain::Chain;
use crate::symbol::{Quantity, SymbolId};

/// What a set of poses is spanned by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parameter {
    /// A joint or input itself.
    Symbol(SymbolId),
    /// The parameter `t` of a path.
    Path,
}

/// A place in words: `elevation = 90 deg, range = 1 m`.
pub(super) fn place(chain: &Chain, parameters: &[Parameter], at: &[f64]) -> String {
    let shown = |(parameter, &value): (&Parameter, &f64)| match parameter {
        Parameter::Path => format!("t = {}", short(value)),
        Parameter::Symbol(id) => {
            let symbol = chain.symbol(*id);
            let (value, unit) = match symbol.quantity {
                Quantity::Angle => (value.to_degrees(), "deg"),
                other => (value, other.unit()),
            };
            format!("{} = {} {unit}", symbol.name, short(value)).trim_end().to_owned()
        }
    };
    let words: Vec<String> = parameters.iter().zip(at).map(shown).collect();
    if words.is_empty() { "every pose".to_owned() } else { words.join(", ") }
}

/// Four digits behind the point at most.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}
