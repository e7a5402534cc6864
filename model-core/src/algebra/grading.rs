//! The grading: degrees in chosen symbols (the errors), and the parts of each degree.

use super::atom::Atom;
use super::poly::Poly;
use crate::symbol::SymbolId;

impl Poly {
    /// The highest total power of the chosen symbols in any term; sines and cosines do not count.
    #[must_use]
    pub fn degree_in(&self, chosen: impl Fn(SymbolId) -> bool) -> u32 {
        self.iter().map(|(_, atoms)| degree(atoms, &chosen)).max().unwrap_or(0)
    }

    /// The terms whose total power of the chosen symbols is `order`.
    #[must_use]
    pub fn graded_part(&self, chosen: impl Fn(SymbolId) -> bool, order: u32) -> Self {
        self.filtered(|atoms| degree(atoms, &chosen) == order)
    }

    /// The factor of a monomial: of the terms in which the chosen symbols occur to exactly these powers, what
    /// stands beside them. `monomial` is sorted by symbol.
    #[must_use]
    pub fn coefficient_of(&self, monomial: &[(SymbolId, u32)], chosen: impl Fn(SymbolId) -> bool) -> Self {
        let mut result = Self::zero();
        let mut rest = Vec::new();
        for (coefficient, atoms) in self.iter() {
            let mut wanted = monomial.iter();
            rest.clear();
            let mut matches = true;
            for atom in atoms {
                if atom.is_power() && chosen(atom.symbol()) {
                    matches &= wanted.next() == Some(&(atom.symbol(), atom.number()));
                } else {
                    rest.push(*atom);
                }
            }
            if matches && wanted.next().is_none() {
                result.push(coefficient.clone(), &rest);
            }
        }
        result.normalised()
    }

    /// The monomials of the chosen symbols that occur, each with its factor, in the order of terms.
    #[must_use]
    pub fn collect_by(&self, chosen: impl Fn(SymbolId) -> bool) -> Vec<(Vec<(SymbolId, u32)>, Self)> {
        let mut monomials: Vec<Vec<(SymbolId, u32)>> = Vec::new();
        let mut parts: Vec<Self> = Vec::new();
        let mut rest = Vec::new();
        for (coefficient, atoms) in self.iter() {
            rest.clear();
            let mut monomial = Vec::new();
            for atom in atoms {
                if atom.is_power() && chosen(atom.symbol()) {
                    monomial.push((atom.symbol(), atom.number()));
                } else {
                    rest.push(*atom);
                }
            }
            let index = monomials.iter().position(|other| *other == monomial).unwrap_or_else(|| {
                monomials.push(monomial);
                parts.push(Self::zero());
                parts.len() - 1
            });
            parts[index].push(coefficient.clone(), &rest);
        }
        monomials.into_iter().zip(parts.into_iter().map(Self::normalised)).collect()
    }

    /// The terms whose atoms satisfy a condition.
    fn filtered(&self, keep: impl Fn(&[Atom]) -> bool) -> Self {
        let mut result = Self::zero();
        for (coefficient, atoms) in self.iter().filter(|(_, atoms)| keep(atoms)) {
            result.push(coefficient.clone(), atoms);
        }
        result
    }
}

fn degree(atoms: &[Atom], chosen: &impl Fn(SymbolId) -> bool) -> u32 {
    atoms
        .iter()
        .filter(|atom| atom.is_power() && chosen(atom.symbol()))
        .fold(0, |sum, atom| sum.saturating_add(atom.number()))
}
