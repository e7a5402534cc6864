//! Printed against derived, term by term: each component is collected by products of errors, and what multiplies them
//! is compared in canonical form.

use std::collections::BTreeMap;

use super::claim::ClosedForm;
use crate::algebra::Poly;
use crate::chain::{Axis, Chain};
use crate::forms::Form;
use crate::symbol::{SymbolId, SymbolKind};

/// A product of errors: symbols and powers, by symbol.
pub(super) type Monomial = Vec<(SymbolId, u32)>;

/// A component by products of errors; no entry is zero.
pub(super) type Parts = BTreeMap<Monomial, Poly>;

/// The three components by products of errors.
pub(super) type Columns = [Parts; 3];

/// x, y and z.
pub(super) const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// A form by products of errors.
pub(super) fn columns(chain: &Chain, form: &Form) -> Columns {
    form.components.each_ref().map(|component| parts(chain, component))
}

/// A component by products of errors.
pub(super) fn parts(chain: &Chain, component: &Poly) -> Parts {
    component.collect_by(|id| chain.symbol(id).kind == SymbolKind::Error).into_iter().collect()
}

/// A component put together again.
pub(super) fn total(parts: &Parts) -> Poly {
    parts.iter().fold(Poly::zero(), |sum, (monomial, factor)| &sum + &(&product(monomial) * factor))
}

/// A product of errors as an amount.
pub(super) fn product(monomial: &Monomial) -> Poly {
    monomial.iter().fold(Poly::one(), |product, &(symbol, power)| {
        (0..power).fold(product, |product, _| &product * &Poly::symbol(symbol))
    })
}

/// The terms of a form that the claim keeps.
pub(super) fn kept(columns: &Columns, claim: &ClosedForm) -> Columns {
    let is_kept =
        |monomial: &Monomial| monomial.iter().all(|(symbol, _)| claim.kept.binary_search(symbol).is_ok());
    columns.each_ref().map(|parts| {
        parts.iter().filter(|(monomial, _)| is_kept(monomial)).map(|(m, p)| (m.clone(), p.clone())).collect()
    })
}

/// What stands in one component for a product of errors in print, and what belongs there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<'a> {
    pub component: Axis,
    pub error: &'a Monomial,
    pub printed: &'a Poly,
    pub derived: &'a Poly,
}

/// Every product of errors whose factors differ, by component, then by error.
pub(super) fn differing<'a>(printed: &'a Columns, derived: &'a Columns, zero: &'a Poly) -> Vec<Pair<'a>> {
    let mut found = Vec::new();
    for component in AXES {
        let (printed, derived) = (&printed[component.index()], &derived[component.index()]);
        let errors: std::collections::BTreeSet<&Monomial> = printed.keys().chain(derived.keys()).collect();
        for error in errors {
            let pair = Pair {
                component,
                error,
                printed: printed.get(error).unwrap_or(zero),
                derived: derived.get(error).unwrap_or(zero),
            };
            if pair.printed != pair.derived {
                found.push(pair);
            }
        }
    }
    found
}
