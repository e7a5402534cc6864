//! Rust statements of a program for code that brings its own types: what `chain!` expands to.

use model_core::{Chain, SymbolId};

use crate::backends::{Names, list, statements};
use crate::program::Program;

/// A program as Rust source. The three parts are meant for one function, in this order; only the names that the
/// caller gave, `sin_<symbol>`, `cos_<symbol>`, `t<number>` and `p<number>` occur in them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expansion {
    /// Statements that read errors and constants alone: once, before a loop over poses.
    pub prepared: String,
    /// Statements that read joints and inputs too: once for a pose.
    pub evaluated: String,
    /// An expression for each output, in the order of [`Program::layout`].
    pub outputs: Vec<String>,
}

/// Expands a program. `symbol` says which expression holds the value of a symbol: `joints.alpha`, `alpha[row]`; `sin_cos`
/// is the path of a function from an angle to the pair of its sine and cosine.
#[must_use]
pub fn expand(
    chain: &Chain,
    program: &Program,
    symbol: impl Fn(SymbolId) -> String,
    sin_cos: &str,
) -> Expansion {
    let names = Names { chain, symbol: &symbol, carried: &|index| format!("p{index}") };
    let listing = list(program, &names);
    let mut prepared = statements(&listing.prepared, sin_cos, 0);
    for (index, value) in listing.carried.iter().enumerate() {
        prepared.push_str(&format!("let p{index} = {value};\n"));
    }
    Expansion { prepared, evaluated: statements(&listing.evaluated, sin_cos, 0), outputs: listing.outputs }
}
