//! A condition under which a statement is defined: what is divided by is not zero, and lengths have their sign.

use model_core::algebra::{Poly, Wave};
use model_core::symbol::SymbolId;

/// One condition.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Condition {
    /// A sine or cosine is not zero.
    Wave(SymbolId, Wave),
    /// An amount is not zero.
    NonZero(Poly),
    /// An amount is greater than zero.
    Positive(Poly),
}
