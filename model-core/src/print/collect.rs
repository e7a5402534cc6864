//! Collecting: terms by their monomial of errors and other symbols, and monomials that share one function of the
//! angles.

use super::Monomial;
use crate::algebra::{Poly, Rational};

/// `Σ coefficient·monomial`, times a function of the angles whose coefficients are whole, without common divisor, the
/// first of them positive.
pub(super) struct Group {
    pub(super) monomials: Vec<(Rational, Monomial)>,
    pub(super) angular: Poly,
}

/// The groups of a polynomial, in the order in which their first monomials come in the canonical form.
pub(super) fn groups(poly: &Poly) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (monomial, angular) in poly.collect_by(|_| true) {
        let (factor, angular) = primitive(&angular);
        match groups.iter_mut().find(|group| group.angular == angular) {
            Some(group) => group.monomials.push((factor, monomial)),
            None => groups.push(Group { monomials: vec![(factor, monomial)], angular }),
        }
    }
    groups
}

/// A number, and what is left when it is taken out.
fn primitive(angular: &Poly) -> (Rational, Poly) {
    let coefficients = angular.terms().map(|term| term.coefficient);
    let measure = coefficients.reduce(|a, b| a.common_measure(&b)).unwrap_or_default().abs();
    let negative = angular.terms().next().is_some_and(|term| term.coefficient.is_negative());
    let factor = if negative { -&measure } else { measure };
    match factor.recip() {
        Some(inverse) => (factor, angular.scale(&inverse)),
        None => (Rational::ONE, angular.clone()),
    }
}
