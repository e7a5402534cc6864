//! What is allowed in a declaration and most likely not meant: data that every command can print.

use std::fmt;

use crate::chain::{Chain, Observable};
use crate::names::nearest;
use crate::symbol::{SymbolId, SymbolKind};

/// An error that acts only in products with errors, so that no first-order form has it: `azimuht` in
/// `Rz(scale*azimuht)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Caution {
    /// The error.
    pub error: SymbolId,
    /// Its name.
    pub name: String,
    /// The joint, input or constant of nearly the same name, if there is one.
    pub near: Option<String>,
}

/// Every such error of a chain, in order.
#[must_use]
pub fn cautions(chain: &Chain) -> Vec<Caution> {
    let is_error = |id: SymbolId| chain.symbol(id).kind == SymbolKind::Error;
    let observed = || chain.observables.iter().flat_map(Observable::amounts);
    let amounts = || chain.factors().map(|factor| &factor.amount).chain(observed());
    let mut acts_alone = vec![false; chain.symbols.len()];
    for amount in amounts() {
        for symbol in amount.graded_part(is_error, 1).symbols() {
            acts_alone[symbol.index()] = true;
        }
    }
    let unheard = chain.symbols_of(SymbolKind::Error).filter(|id| !acts_alone[id.index()]);
    unheard
        .map(|error| {
            let name = chain.symbol(error).name.clone();
            let others = chain.symbols.iter().filter(|symbol| {
                matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input | SymbolKind::Constant)
            });
            let near = nearest(&name, others.map(|symbol| symbol.name.as_str())).map(str::to_owned);
            Caution { error, name, near }
        })
        .collect()
}

impl fmt::Display for Caution {
    /// One clause without a full stop.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` counts as an error that acts only in products with errors: first order has nothing of it",
            self.name
        )?;
        match &self.near {
            Some(near) => write!(f, "; did you mean `{near}`?"),
            None => write!(f, "; declare it with `const` or `input` if it is no error"),
        }
    }
}
