//! How much one declaration may hold; beyond it, no rule is tried.

use proc_macro2::Span;

use crate::mistake::Mistake;
use crate::syntax::Declaration;

/// Bodies of one chain.
const MOST_BODIES: usize = 3000;
/// Observables of one chain.
const MOST_OBSERVABLES: usize = 1000;
/// Factors of one chain.
const MOST_FACTORS: usize = 20_000;

/// The first of the bodies, observables or factors that are too many.
pub fn beyond(declaration: &Declaration) -> Option<Mistake<Span>> {
    let too_many = |place: Span, what: &str, most: usize| {
        Mistake::new(place, format!("more than {most} {what} in one chain"))
            .with_help("write several chains, each with the part that an instrument has")
    };
    let body =
        declaration.bodies().nth(MOST_BODIES).map(|body| too_many(body.name.span(), "bodies", MOST_BODIES));
    let observable = || {
        let observable = declaration.observables().nth(MOST_OBSERVABLES)?;
        Some(too_many(observable.name.span(), "observables", MOST_OBSERVABLES))
    };
    let factor = || {
        let mut factors = declaration.bodies().flat_map(|body| &body.groups).flat_map(|group| &group.factors);
        Some(too_many(factors.nth(MOST_FACTORS)?.axis.span(), "factors", MOST_FACTORS))
    };
    body.or_else(observable).or_else(factor)
}
