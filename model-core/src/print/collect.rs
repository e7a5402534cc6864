//! Collecting: terms by their monomial of errors and other symbols, and monomials that share one function of the
//! angles.

use super::Monomial;
use crate::algebra::{Poly, Rational, Term};

/// `Σ coefficient·monomial`, times a function of the angles whose leading coefficient is positive.
pub(super) struct Group {
    pub(super) monomials: Vec<(Rational, Monomial)>,
    pub(super) angular: Poly,
}

impl Group {
    /// A monomial as a term of its own, its sign turned if asked.
    pub(super) fn term((coefficient, monomial): &(Rational, Monomial), turned: bool) -> Term {
        Term {
            coefficient: if turned { -coefficient } else { coefficient.clone() },
            powers: monomial.clone(),
            waves: Vec::new(),
            poles: Vec::new(),
        }
    }
}

/// The groups of a polynomial, in the order in which their first monomials come in the canonical form.
pub(super) fn groups(poly: &Poly) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (monomial, angular) in poly.collect_by(|_| true) {
        let negative = angular.terms().next().is_some_and(|term| term.coefficient.is_negative());
        let (sign, angular) =
            if negative { (Rational::from(-1), -&angular) } else { (Rational::ONE, angular) };
        match groups.iter_mut().find(|group| group.angular == angular) {
            Some(group) => group.monomials.push((sign, monomial)),
            None => groups.push(Group { monomials: vec![(sign, monomial)], angular }),
        }
    }
    groups
}
