//! Printed against derived, term by term: each component is collected by products of errors, and what multiplies them
//! is compared in canonical form.

use std::collections::BTreeMap;

use super::CheckError;
use super::claim::{ClosedForm, Combination, Faces};
use model_core::algebra::{AlgebraError, Fraction, Poly, Rational};
use model_core::chain::{Axis, Chain};
use model_core::print;
use model_core::symbol::{SymbolId, SymbolKind};

/// A product of errors: symbols and powers, by symbol.
pub(super) type Monomial = Vec<(SymbolId, u32)>;

/// A component by products of errors; no entry is zero.
pub(super) type Parts = BTreeMap<Monomial, Poly>;

/// The three components by products of errors.
pub(super) type Columns = [Parts; 3];

/// x, y and z.
pub(super) const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// A form by products of errors: at most three numbers, each with what stands below it and what has to be positive.
#[derive(Debug, Clone)]
pub(super) struct Implied {
    pub columns: Columns,
    pub below: [Poly; 3],
    pub positive: [Vec<Poly>; 3],
}

impl Implied {
    /// Of the numbers that an observable shows; the places behind them are empty on both sides of a comparison.
    pub fn new(chain: &Chain, components: &[Fraction], positive: &[Vec<Poly>]) -> Self {
        let mut implied = Self {
            columns: Columns::default(),
            below: [Poly::one(), Poly::one(), Poly::one()],
            positive: Default::default(),
        };
        for (place, component) in components.iter().enumerate().take(3) {
            implied.columns[place] = parts(chain, &component.above);
            implied.below[place] = component.below.clone();
            implied.positive[place] = positive.get(place).cloned().unwrap_or_default();
        }
        implied
    }

    /// Leaves one component.
    pub fn clear_but(&mut self, only: Axis) {
        for axis in AXES.into_iter().filter(|axis| *axis != only) {
            self.columns[axis.index()].clear();
            self.below[axis.index()] = Poly::one();
            self.positive[axis.index()].clear();
        }
    }
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

/// A form with the errors that the claim neglects put to zero.
pub(super) fn kept(chain: &Chain, columns: &Columns, claim: &ClosedForm) -> Result<Columns, AlgebraError> {
    let is_kept = |symbol: &SymbolId| claim.kept.binary_search(symbol).is_ok();
    let mut result = Columns::default();
    for (kept, parts) in result.iter_mut().zip(columns) {
        for (monomial, factor) in parts {
            if !monomial.iter().all(|(symbol, _)| is_kept(symbol)) {
                continue;
            }
            // Errors within sines and cosines, in an exact form.
            let mut factor = factor.clone();
            for symbol in factor.symbols() {
                if chain.symbol(symbol).kind == SymbolKind::Error && !is_kept(&symbol) {
                    factor = factor.substitute(symbol, &Poly::zero())?;
                }
            }
            if !factor.is_zero() {
                kept.insert(monomial.clone(), factor);
            }
        }
    }
    Ok(result)
}

/// A joint that the second face moves and that a ramp or the angle of a line of sight in the form depends on, if there is one.
pub(super) fn derived_of(chain: &Chain, columns: &Columns, faces: &Faces) -> Option<SymbolId> {
    let used: Vec<SymbolId> =
        columns.iter().flat_map(|parts| parts.values()).flat_map(Poly::symbols).collect();
    let ramps = chain.ramps.iter().filter(|ramp| used.contains(&ramp.symbol));
    let angles = chain.sight_angles.iter().filter(|angle| used.contains(&angle.symbol));
    let mut joints =
        ramps.flat_map(|ramp| ramp.depends_on()).chain(angles.flat_map(|angle| angle.depends_on()));
    joints.find(|id| faces.second.iter().any(|(joint, _)| joint == id))
}

/// The errors of two faces, combined. A form is odd in each of the roots that it has a sign for, so where such a root turns
/// negative in the second face the form there is the negative one.
pub(super) fn over_faces(chain: &Chain, implied: &Implied, faces: &Faces) -> Result<Implied, CheckError> {
    let turned = |poly: &Poly| -> Result<Poly, AlgebraError> {
        faces.second.iter().try_fold(poly.clone(), |poly, (joint, amount)| poly.substitute(*joint, amount))
    };
    let mut result = implied.clone();
    for (place, combined) in result.columns.iter_mut().enumerate() {
        if faces.combined == Combination::Correction {
            combined.values_mut().for_each(|factor| *factor = -&*factor);
            continue;
        }
        if implied.below[place] != Poly::one() {
            return Err(CheckError::FacesOfQuotient(print::text(&implied.below[place], chain)));
        }
        let first = total(&implied.columns[place]);
        let mut second = turned(&first)?;
        for root in &implied.positive[place] {
            let there = turned(root)?;
            if there == -root {
                second = -&second;
            } else if there != *root {
                return Err(CheckError::SignInFace(print::text(root, chain)));
            }
        }
        let half = Rational::half();
        *combined = parts(
            chain,
            &match faces.combined {
                Combination::Mean => (&first + &second).scale(&half),
                Combination::Difference => &first - &second,
                Combination::Correction => -&first,
                Combination::HalfDifference => (&first - &second).scale(&half),
            },
        );
    }
    Ok(result)
}

/// Every component in other terms.
pub(super) fn translated(
    chain: &Chain,
    implied: &Implied,
    claim: &ClosedForm,
) -> Result<Implied, AlgebraError> {
    let mut result = implied.clone();
    for place in 0..result.columns.len() {
        let whole = claim.printed.translate(chain, &total(&implied.columns[place]))?;
        result.columns[place] = parts(chain, &whole);
        result.below[place] = claim.printed.translate(chain, &implied.below[place])?;
    }
    Ok(result)
}

/// Every component times what it stands over in print.
pub(super) fn multiplied(columns: &Columns, below: [&Poly; 3]) -> Columns {
    let mut result = columns.clone();
    for (parts, below) in result.iter_mut().zip(below) {
        if *below != Poly::one() {
            parts.values_mut().for_each(|factor| *factor = &*factor * below);
        }
    }
    result
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
