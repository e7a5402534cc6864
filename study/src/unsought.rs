//! Inputs that say what they are, while neither the declaration nor an effect may use them.

use std::fmt;

use model_core::{Chain, Meaning, SymbolId, SymbolKind};

/// An input that nothing uses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unsought {
    name: String,
    meaning: &'static str,
}

impl fmt::Display for Unsought {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, meaning } = self;
        write!(
            f,
            "nothing uses the input {name} ({meaning}): to look for effects that follow it, write inputs = [\"{name}\"] under \
             [search]"
        )
    }
}

/// The inputs with a meaning that no observable of the chain hangs on and no effect may follow, which are `inputs`. A length or
/// an angle says only how much it is.
pub(super) fn unsought(chain: &Chain, inputs: &[SymbolId]) -> Vec<Unsought> {
    let observables = chain.observables.iter().filter_map(|own| chain.find_observable(&own.name));
    let mut used: Vec<SymbolId> = observables.flat_map(|id| chain.symbols_of_way(id)).collect();
    // A phase that effects may follow is one of a range.
    used.extend(inputs.iter().flat_map(|&id| [Some(id), chain.symbol(id).of]).flatten());
    chain
        .symbols_of(SymbolKind::Input)
        .filter(|id| !used.contains(id))
        .filter_map(|id| {
            let symbol = chain.symbol(id);
            let meaning = symbol.meaning.filter(|own| !matches!(own, Meaning::Angle | Meaning::Length))?;
            Some(Unsought { name: symbol.name.clone(), meaning: meaning.word() })
        })
        .collect()
}
