//! Rows in the order in which they were taken, of which nothing says when: a drift with time is not looked for.

use std::fmt;

use model_core::{Chain, Meaning, SymbolId};

/// Rows in sequence without a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timeless;

impl fmt::Display for Timeless {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the rows are in sequence, but nothing says when they were taken: a drift with time is not looked for; if a column \
             holds the time, write order = \"COLUMN\" under [noise]"
        )
    }
}

/// Whether neither a column of the order nor one of the inputs that effects may use says when rows in sequence were taken.
pub(super) fn timeless(chain: &Chain, inputs: &[SymbolId], order: Option<&str>) -> Option<Timeless> {
    let times = |meaning: Option<Meaning>| matches!(meaning, Some(Meaning::Time | Meaning::Session));
    let timed = inputs.iter().any(|&input| times(chain.symbol(input).meaning));
    (order.is_none() && !timed).then_some(Timeless)
}
