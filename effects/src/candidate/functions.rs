//! Functions and words that several families share.

use model_core::SymbolId;
use model_core::algebra::{AngleSum, Poly, Rational};

use super::Function;

/// cos nq and sin nq, with error names `stem_cos…`, `stem_sin…`.
#[must_use]
pub fn harmonic(joint: SymbolId, name: &str, order: u32, stem: &str) -> Vec<Function> {
    let Ok(angle) = AngleSum::symbol(joint).times(order) else { return Vec::new() };
    let number = if order == 1 { String::new() } else { order.to_string() };
    vec![
        Function::new(Poly::cos(&angle), format!("{stem}_cos{number}_{name}")),
        Function::new(Poly::sin(&angle), format!("{stem}_sin{number}_{name}")),
    ]
}

/// `once a turn`, `3 per turn`.
pub(crate) fn per_turn(order: u32) -> String {
    if order == 1 { "once a turn".to_owned() } else { format!("{order} per turn") }
}

/// A whole number as an amount.
pub(crate) fn whole(value: i64) -> Poly {
    Poly::constant(Rational::from(value))
}
