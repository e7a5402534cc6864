//! A frozen model: the study lists the terms, and nothing else is fitted.

use model_core::{Chain, SymbolId, SymbolKind};

use effects::catalogue::Term;
use fit::FitOptions;

/// The terms of a model that is given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frozen {
    /// In their order.
    pub terms: Vec<FrozenTerm>,
    /// Declared errors that are no term, and are held at zero.
    pub held: Vec<SymbolId>,
}

/// A term as the study writes it, and what it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrozenTerm {
    /// As the study writes it: `TF`.
    pub written: String,
    /// What it was read as; an effect by its number in the catalogue of the plan.
    pub term: Term,
}

impl Frozen {
    /// The declared errors among the terms.
    pub fn errors(&self) -> impl Iterator<Item = SymbolId> {
        self.terms.iter().filter_map(|own| match own.term {
            Term::Error(error) => Some(error),
            Term::Effect(_) => None,
        })
    }

    /// Lets a fit estimate the declared errors among the terms, and constants that it estimates, alone.
    pub(super) fn hold(&self, chain: &Chain, fit: &mut FitOptions) {
        fit.estimate.retain(|id| chain.symbol(*id).kind == SymbolKind::Constant);
        fit.estimate.extend(self.errors());
        fit.estimate.sort_unstable();
        self.held.iter().for_each(|id| fit.start[id.index()] = 0.0);
    }
}
