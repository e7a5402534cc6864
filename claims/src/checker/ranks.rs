//! Claims about what can be told apart: ranks, errors that are confounded, errors that can be separated. All of them are
//! decided, by the rational null space of the first-order columns.

use super::{CheckError, Checker};
use model_core::algebra::{AlgebraError, Poly};
use model_core::chain::{Chain, ObservableId};
use model_core::identify::identify;
use model_core::symbol::{SymbolId, SymbolKind};

/// A claim about the first-order columns of errors.
#[derive(Debug, Clone)]
pub struct Rank {
    /// Seen together.
    pub observables: Vec<ObservableId>,
    /// Of which errors.
    pub errors: Vec<SymbolId>,
    /// What is said of them.
    pub said: RankSaid,
}

/// What is said of errors.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RankSaid {
    /// So many combinations of them are determined.
    Is(usize),
    /// Each of them could be a combination of the others.
    Confounded,
    /// Each of them is determined, whatever the others are; the others are those that the second list names.
    Separable(Vec<SymbolId>),
}

/// What the null space says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RankVerdict {
    /// How many combinations of the errors are determined.
    pub rank: usize,
    /// How many errors there are.
    pub errors: usize,
    /// The errors of which the claim is not true.
    pub exceptions: Vec<SymbolId>,
    /// Whether the claim holds.
    pub holds: bool,
}

impl Checker<'_> {
    /// The verdict on what can be told apart.
    ///
    /// # Errors
    /// The chain has no closed form.
    pub fn rank(&self, claim: &Rank) -> Result<RankVerdict, CheckError> {
        let rank_of = |errors: &[SymbolId]| rank(self.chain, &claim.observables, errors);
        let without = |errors: &[SymbolId], one: SymbolId| -> Vec<SymbolId> {
            errors.iter().copied().filter(|error| *error != one).collect()
        };
        let errors = &claim.errors;
        let found = rank_of(errors)?;
        let mut exceptions = Vec::new();
        let holds = match &claim.said {
            RankSaid::Is(claimed) => found == *claimed,
            RankSaid::Confounded => {
                for &error in errors {
                    if rank_of(&without(errors, error))? != found {
                        exceptions.push(error);
                    }
                }
                exceptions.is_empty()
            }
            RankSaid::Separable(others) => {
                let whole = rank_of(others)?;
                for &error in errors {
                    if rank_of(&without(others, error))? == whole {
                        exceptions.push(error);
                    }
                }
                exceptions.is_empty()
            }
        };
        Ok(RankVerdict { rank: found, errors: errors.len(), exceptions, holds })
    }
}

/// How many combinations of some errors are determined, all others being zero.
fn rank(chain: &Chain, observables: &[ObservableId], errors: &[SymbolId]) -> Result<usize, CheckError> {
    Ok(identify(&only_of(chain, errors)?, observables)?.estimable.len())
}

/// The chain with all errors zero but these.
///
/// # Errors
/// What the algebra refuses.
pub fn only_of(chain: &Chain, errors: &[SymbolId]) -> Result<Chain, AlgebraError> {
    let mut restricted = chain.clone();
    for factor in restricted.factors_mut() {
        for symbol in factor.amount.symbols() {
            if chain.symbol(symbol).kind == SymbolKind::Error && !errors.contains(&symbol) {
                factor.amount = factor.amount.substitute(symbol, &Poly::zero())?;
            }
        }
    }
    Ok(restricted)
}
