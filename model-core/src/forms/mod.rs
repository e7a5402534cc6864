//! The forms of the error of an observable: truncated at an order in the errors, or untruncated.
//!
//! Nothing is typed in: every form follows from the product of the chain's factors, by the grading in the errors.

mod exact_symbolic;
mod graded;

use crate::algebra::{AlgebraError, Poly};
use crate::chain::{Axis, Chain, ObservableId};
use crate::symbol::{SymbolId, SymbolKind};

pub use exact_symbolic::exact_symbolic;

/// The error of an observable up to an order in the errors, in the ground frame: a difference of vectors without unit
/// for a direction, in metres for a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// Of which observable.
    pub observable: ObservableId,
    /// Products of more than this many errors are dropped.
    pub order: u32,
    /// x, y and z.
    pub components: [Poly; 3],
}

/// A factor of the chain that has no closed form.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("R{axis} of body `{body}`: {error}")]
pub struct FormError {
    /// The body whose factor it is.
    pub body: String,
    /// The axis of the rotation: `x`, `y` or `z`.
    pub axis: char,
    /// What the algebra says.
    pub error: AlgebraError,
}

impl FormError {
    fn new(body: &str, axis: Axis, error: AlgebraError) -> Self {
        let axis = match axis {
            Axis::X => 'x',
            Axis::Y => 'y',
            Axis::Z => 'z',
        };
        Self { body: body.to_owned(), axis, error }
    }
}

/// The error of an observable up to `order` in the errors, derived from the exact product by truncating while
/// multiplying.
///
/// # Errors
/// [`FormError`] if a rotation by a nominal amount is no [`AngleSum`](crate::algebra::AngleSum) (a chain from
/// [`check`](crate::check) has none such), or if the form would have more than a million terms.
pub fn derive(chain: &Chain, observable: ObservableId, order: u32) -> Result<Form, FormError> {
    let components = graded::error_up_to(chain, observable, order)?;
    Ok(Form { observable, order, components })
}

impl Form {
    /// The first-order columns: for every error of the chain, in order, what multiplies it in x, y and z. Errors that
    /// do not occur have zeros.
    #[must_use]
    pub fn columns(&self, chain: &Chain) -> Vec<(SymbolId, [Poly; 3])> {
        let is_error = error_table(chain);
        let mut columns: Vec<(SymbolId, [Poly; 3])> =
            chain.symbols_of(SymbolKind::Error).map(|error| (error, Default::default())).collect();
        for (axis, component) in self.components.iter().enumerate() {
            let parts = component.collect_by(|symbol| is_error[symbol.index()]);
            for (monomial, coefficient) in parts {
                if let [(error, 1)] = monomial.as_slice()
                    && let Ok(index) = columns.binary_search_by_key(error, |(symbol, _)| *symbol)
                {
                    columns[index].1[axis] = coefficient;
                }
            }
        }
        columns
    }
}

/// Which symbols are errors, by [`SymbolId`].
pub(crate) fn error_table(chain: &Chain) -> Vec<bool> {
    chain.symbols.iter().map(|symbol| symbol.kind == SymbolKind::Error).collect()
}
